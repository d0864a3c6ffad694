// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose send`: sends a pose list or a made-up motion onto a bus.
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "firmware/auth_key.h"
#include "firmware/can_protocol.h"
#include "sim/options.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/pose/motion.h"
#include "sim/pose/pose_send.h"
#include "sim/pose/pose_text.h"
#include "sim/program.h"

enum { LONG_LIST_US = 2000000, MOST_TRACKER = 15, KEY_SEED = 256, KEY_NO_SYNC, KEY_KEY };

static const char program[] = "wallwarp-pose send";

typedef struct {
    const char *bus, *source, *key;
    const char *motion_option; /* one that is for motions only, or NULL */
    bool is_motion, fd, no_sync;
    uint8_t viewer, tracker;
    motion_t motion;
} options_t;

static void parse_start(struct argp_state *state, const char *text, pose_t *start)
{
    char error[POSE_TEXT_MESSAGE_LENGTH];
    if (!pose_from_text(text, start, error))
        argp_error(state, "--at: %s", error);
}

static error_t parse_motion(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'r':
        options->motion.rate_hz = command_number(state, "--rate", argument, 0.1, 2000.0);
        options->motion_option = "--rate";
        return 0;
    case 's':
        options->motion.duration_s = command_number(state, "--seconds", argument, 0.0, 3600.0);
        options->motion_option = "--seconds";
        return 0;
    case 'a':
        parse_start(state, argument, &options->motion.start);
        options->motion_option = "--at";
        return 0;
    case KEY_SEED:
        options->motion.seed = (uint64_t)options_whole(state, "--seed", argument, 0, INT_MAX);
        options->motion_option = "--seed";
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static void check(struct argp_state *state, options_t *options)
{
    command_check_fd(state, options->bus, options->fd);
    command_check_key(state, options->key, options->no_sync);
    if (options->source == NULL)
        argp_error(state, "the pose list or the motion is missing");
    for (int m = 0; m < MOTIONS; m++) {
        if (strcmp(options->source, motion_names[m]) != 0)
            continue;
        options->is_motion = true;
        options->motion.kind = (motion_kind_t)m;
    }
    if (!options->is_motion && options->motion_option != NULL)
        argp_error(state, "%s: a pose list has its own, expected it with a motion", options->motion_option);
    if (options->tracker != 0 && !options->fd)
        argp_error(state, "--tracker: three classic frames do not carry it, expected --fd");
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = command_bus(state, argument);
        return 0;
    case 'f':
        options->fd = true;
        return 0;
    case KEY_KEY:
        options->key = argument;
        return 0;
    case KEY_NO_SYNC:
        options->no_sync = true;
        return 0;
    case 'v':
        options->viewer = (uint8_t)options_whole(state, "--viewer", argument, 0, CAN_VIEWERS - 1);
        return 0;
    case 't':
        options->tracker = (uint8_t)options_whole(state, "--tracker", argument, 0, MOST_TRACKER);
        return 0;
    case ARGP_KEY_ARG:
        if (options->source != NULL)
            argp_error(state, "one pose list expected, found also '%s'", argument);
        options->source = argument;
        return 0;
    case ARGP_KEY_END:
        check(state, options);
        return 0;
    default:
        return parse_motion(key, argument, state);
    }
}

static bool is_long(const pose_list_t *list)
{
    return list->entry[list->count - 1].time_us - list->entry[0].time_us > LONG_LIST_US;
}

static int fail(const char *about, const char *error)
{
    fprintf(stderr, "%s: %s%s\n", program, about, error);
    return PROGRAM_FAILED;
}

static int send_list(const options_t *options, const pose_list_t *list)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    pose_send_t send = {.list = list, .fd = options->fd, .viewer = options->viewer, .tracker = options->tracker};
    pose_link_t link;
    if (!pose_send_check(&send, error)) {
        fprintf(stderr, "%s: %s: %s\n", program, options->source, error);
        return PROGRAM_FAILED;
    }
    if (!pose_link_open(&link, options->bus, options->fd, error))
        return fail("", error);
    /* only now: before the link is open, a signal may end the program at once */
    send.stop = command_catch_stop();
    send.show_progress = isatty(STDERR_FILENO) && is_long(list);
    send.sync = !options->no_sync;
    size_t sent = 0;
    const bool opened = command_open_key(program, options->key, options->bus, &send.auth);
    const bool ok = opened && pose_send_list(&link, &send, &sent, error);
    pose_auth_close(send.auth);
    pose_link_close(&link);
    if (!opened)
        return PROGRAM_FAILED;
    if (!ok)
        return fail("", error);
    if (sent < list->count) {
        fprintf(stderr, "%s: interrupted after %zu of %zu poses\n", program, sent, list->count);
        return PROGRAM_FAILED;
    }
    printf("%zu poses sent to %s\n", sent, options->bus);
    return program_finish(program);
}

int command_send(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"fd", 'f', NULL, 0,
         "One CAN FD frame of 32 bytes per pose, instead of three classic frames; not with HOST:PORT", 0},
        {"no-sync", KEY_NO_SYNC, NULL, 0, "Leave it to another to give the time of the bus (Sync and FollowUp)", 0},
        {"key", KEY_KEY, "FILE", 0, auth_key_help, 0},
        {"viewer", 'v', "N", 0, "Whose pose it is, 0 to 3 (0)", 0},
        {"tracker", 't', "N", 0, "Which tracker measured it, 0 to 15 (0); with --fd", 0},
        {NULL, 0, NULL, 0, "For a motion:", 1},
        {"rate", 'r', "HZ", 0, "Poses a second, 0.1 to 2000 (240)", 1},
        {"seconds", 's', "S", 0, "How long, up to 3600 s (10)", 1},
        {"at", 'a', "POSE", 0, "Where it starts, \"x_mm y_mm z_mm qw qx qy qz\" (\"0 0 -2000 1 0 0 0\")", 1},
        {"seed", KEY_SEED, "N", 0, "Of the noise (1)", 1},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "CSV\nstill|walk|orbit|noise",
        .doc =
            "Send a pose list, or a made-up motion, once, in real time.\v"
            "CSV is a pose list with the header time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz. The motions begin at --at: still; "
            "walk, 1 m to each side at up to 1.4 m/s, bobbing and looking around; orbit, around the point 1 m ahead; "
            "noise, still but for 0.5 mm and 0.05 degrees of noise. The messages are those of firmware/wallwarp.dbc. "
            "The exit status is 0 when all is sent, 1 when it failed or was interrupted, 2 for bad usage.",
    };
    options_t options = {.motion = {.start = {.eye_nm = {0, 0, -2000000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}},
                                    .rate_hz = 240.0,
                                    .duration_s = 10.0,
                                    .seed = 1}};
    argp_parse(&argp, argc, argv, 0, NULL, &options);

    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH] = "out of memory";
    if (!(options.is_motion ? motion_make(&list, &options.motion) : pose_list_load(&list, options.source, error)))
        return fail(!options.is_motion && access(options.source, F_OK) != 0
                        ? "expected a pose list, or still, walk, orbit or noise; "
                        : "",
                    error);
    const int status = send_list(&options, &list);
    pose_list_free(&list);
    return status;
}
