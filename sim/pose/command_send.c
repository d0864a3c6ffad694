// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose send`: sends a pose list onto a bus.
#include <argp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/pose/pose_link.h"
#include "sim/pose/pose_list.h"
#include "sim/pose/pose_send.h"
#include "sim/program.h"

enum { LONG_LIST_US = 2000000, NO_SYNC = 256 };

typedef struct {
    const char *bus, *csv;
    bool fd, no_sync;
} options_t;

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
    case NO_SYNC:
        options->no_sync = true;
        return 0;
    case ARGP_KEY_ARG:
        if (options->csv != NULL)
            argp_error(state, "one pose list expected, found also '%s'", argument);
        options->csv = argument;
        return 0;
    case ARGP_KEY_END:
        if (options->bus == NULL)
            argp_error(state, "--bus is missing");
        if (options->csv == NULL)
            argp_error(state, "the pose list is missing");
        if (options->fd && strchr(options->bus, ':') != NULL)
            argp_error(state, "--fd: a simulator's port carries classic frames only");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static bool is_long(const pose_list_t *list)
{
    return list->entry[list->count - 1].time_us - list->entry[0].time_us > LONG_LIST_US;
}

static int send_list(const options_t *options, const pose_list_t *list)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    pose_link_t link;
    if (!pose_send_check(list, options->fd, error)) {
        fprintf(stderr, "wallwarp-pose send: %s: %s\n", options->csv, error);
        return PROGRAM_FAILED;
    }
    if (!pose_link_open(&link, options->bus, options->fd, error)) {
        fprintf(stderr, "wallwarp-pose send: %s\n", error);
        return PROGRAM_FAILED;
    }
    /* only now: before the link is open, a signal may end the program at once */
    const volatile sig_atomic_t *stop = command_catch_stop();
    const bool show_progress = isatty(STDERR_FILENO) && is_long(list);
    const pose_send_t send = {list, options->fd, show_progress, stop, !options->no_sync};
    size_t sent = 0;
    const bool ok = pose_send_list(&link, &send, &sent, error);
    pose_link_close(&link);
    if (!ok) {
        fprintf(stderr, "wallwarp-pose send: %s\n", error);
        return PROGRAM_FAILED;
    }
    if (sent < list->count) {
        fprintf(stderr, "wallwarp-pose send: interrupted after %zu of %zu poses\n", sent, list->count);
        return PROGRAM_FAILED;
    }
    printf("%zu poses sent to %s\n", sent, options->bus);
    return program_finish("wallwarp-pose send");
}

int command_send(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"fd", 'f', NULL, 0,
         "One CAN FD frame of 32 bytes per pose, instead of three classic frames; not with HOST:PORT", 0},
        {"no-sync", NO_SYNC, NULL, 0, "Leave it to another to give the time of the bus (Sync and FollowUp)", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "CSV",
        .doc = "Send a pose list once, in real time.\v"
               "CSV is a pose list with the header time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz. The messages are those of "
               "firmware/wallwarp.dbc, viewer 0. The exit status is 0 when all is sent, 1 when it failed or was "
               "interrupted, 2 for bad usage.",
    };
    options_t options = {.bus = NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &options);

    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH];
    if (!pose_list_load(&list, options.csv, error)) {
        fprintf(stderr, "wallwarp-pose send: %s\n", error);
        return PROGRAM_FAILED;
    }
    const int status = send_list(&options, &list);
    pose_list_free(&list);
    return status;
}
