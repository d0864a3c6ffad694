// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose record`: writes what is on a bus into a log.
#include <argp.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "sim/bus/candump_text.h"
#include "sim/pose/bus_listen.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/program.h"

typedef struct {
    const char *bus, *path;
    int64_t length_us;
} options_t;

typedef struct {
    FILE *file;
    int64_t frames;
} record_t;

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = command_bus(state, argument);
        return 0;
    case 's':
        options->length_us = command_seconds_us(state, "--seconds", argument);
        return 0;
    case ARGP_KEY_ARG:
        if (options->path != NULL)
            argp_error(state, "one log expected, found also '%s'", argument);
        options->path = argument;
        return 0;
    case ARGP_KEY_END:
        if (options->bus == NULL)
            argp_error(state, "--bus is missing");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static bool write_frame(void *context, const hal_can_frame_t *frame)
{
    record_t *record = context;
    char line[CANDUMP_TEXT_LENGTH];
    candump_text_from_frame(line, frame, "can0");
    record->frames++;
    return fprintf(record->file, "%s\n", line) > 0;
}

/* A program that is killed, or a full disk, loses at most the last 100 ms. */
static void push_out(void *context)
{
    const record_t *record = context;
    (void)fflush(record->file);
}

int command_record(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"seconds", 's', "S", 0, "Stop after S seconds, instead of on SIGINT or at the end of the bus", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "[LOG]",
        .doc = "Record every frame on a bus.\v"
               "LOG, or else stdout, gets one line per frame in the format of candump -l, which canplayer and "
               "`wallwarp-pose replay` read. A log that exists is not overwritten.",
    };
    options_t options = {.bus = NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &options);

    record_t record = {.file = options.path == NULL ? stdout : fopen(options.path, "wxe")};
    if (record.file == NULL) {
        fprintf(stderr, "%s: %s: %s%s\n", argv[0], options.path, strerror(errno),
                errno == EEXIST ? "; no log is overwritten, expected another name" : "");
        return PROGRAM_FAILED;
    }
    const bus_listen_t listen = {
        .length_us = options.length_us,
        .stop = command_catch_stop(),
        .frame = write_frame,
        .tick = push_out,
        .context = &record,
    };
    char error[POSE_LINK_MESSAGE_LENGTH];
    const bus_listen_end_t end = bus_listen(options.bus, &listen, error);
    const bool written = fflush(record.file) == 0 && ferror(record.file) == 0;
    if (!written)
        fprintf(stderr, "%s: %s: cannot write on: is the disk full?\n", argv[0],
                options.path == NULL ? "stdout" : options.path);
    if (options.path != NULL)
        (void)fclose(record.file);
    if (end == BUS_LISTEN_FAILED) {
        fprintf(stderr, "%s: %s\n", argv[0], error);
        if (options.path != NULL && record.frames == 0)
            (void)remove(options.path);
        return PROGRAM_FAILED;
    }
    fprintf(stderr, "%" PRId64 " frames %s%s%s\n", record.frames, written ? "recorded" : "heard",
            end == BUS_LISTEN_ENDED ? "; " : "", end == BUS_LISTEN_ENDED ? error : "");
    return written ? PROGRAM_DONE : PROGRAM_FAILED;
}
