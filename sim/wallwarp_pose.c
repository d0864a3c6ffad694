// SPDX-License-Identifier: Apache-2.0
// The program wallwarp-pose: sends poses onto a CAN bus.
#include <argp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "sim/pose/pose_link.h"
#include "sim/pose/pose_list.h"
#include "sim/pose/pose_send.h"
#include "sim/program.h"

enum { LONG_LIST_US = 2000000 };

typedef struct {
    const char *bus, *csv;
    bool fd;
} send_options_t;

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static void check_bus(struct argp_state *state, const send_options_t *options)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    if (options->fd && strchr(options->bus, ':') != NULL)
        argp_error(state, "--fd: a simulator's port carries classic frames only");
    if (!pose_link_check(options->bus, error))
        argp_error(state, "--bus: %s", error);
}

static error_t parse_send(int key, char *argument, struct argp_state *state)
{
    send_options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = argument;
        return 0;
    case 'f':
        options->fd = true;
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
        check_bus(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static bool is_long(const pose_list_t *list)
{
    return list->entry[list->count - 1].time_us - list->entry[0].time_us > LONG_LIST_US;
}

static int send_list(const send_options_t *options, const pose_list_t *list)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    pose_link_t link;
    if (!pose_send_check(list, options->fd, error)) {
        fprintf(stderr, "wallwarp-pose: %s: %s\n", options->csv, error);
        return PROGRAM_FAILED;
    }
    if (!pose_link_open(&link, options->bus, options->fd, error)) {
        fprintf(stderr, "wallwarp-pose: %s\n", error);
        return PROGRAM_FAILED;
    }
    /* only now: before the link is open, a signal may end the program at once */
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
    const bool show_progress = isatty(STDERR_FILENO) && is_long(list);
    const pose_send_t send = {list, options->fd, show_progress, &stop_requested};
    size_t sent = 0;
    const bool ok = pose_send_list(&link, &send, &sent, error);
    pose_link_close(&link);
    if (!ok) {
        fprintf(stderr, "wallwarp-pose: %s\n", error);
        return PROGRAM_FAILED;
    }
    if (sent < list->count) {
        fprintf(stderr, "wallwarp-pose: interrupted after %zu of %zu poses\n", sent, list->count);
        return PROGRAM_FAILED;
    }
    printf("%zu poses sent to %s\n", sent, options->bus);
    return program_finish("wallwarp-pose");
}

static int run_send(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0,
         "A SocketCAN interface such as can0, or HOST:PORT of a simulator (wallwarp-sim run --bus PORT)", 0},
        {"fd", 'f', NULL, 0,
         "One CAN FD frame of 32 bytes per pose, instead of three classic frames; not with HOST:PORT", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse_send,
        .args_doc = "CSV",
        .doc = "Send a pose list once, in real time.\v"
               "CSV is a pose list with the header time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz. The messages are those of "
               "firmware/wallwarp.dbc, viewer 0. The exit status is 0 when all is sent, 1 when it failed or was "
               "interrupted, 2 for bad usage.",
    };
    send_options_t options = {.bus = NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &options);

    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH];
    if (!pose_list_load(&list, options.csv, error)) {
        fprintf(stderr, "wallwarp-pose: %s\n", error);
        return PROGRAM_FAILED;
    }
    const int status = send_list(&options, &list);
    pose_list_free(&list);
    return status;
}

typedef struct {
    int argc; /**< of the command, with its name */
    char **argv;
} command_t;

static error_t parse_command(int key, char *argument, struct argp_state *state)
{
    command_t *command = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        if (strcmp(argument, "send") != 0)
            argp_error(state, "no such command: '%s'", argument);
        *command = (command_t){.argc = state->argc - state->next + 1, .argv = &state->argv[state->next - 1]};
        state->next = state->argc; /* the rest is the command's own */
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a command is missing");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        .parser = parse_command,
        .args_doc = "COMMAND ...",
        .doc = "Send poses onto a CAN bus.\v"
               "Commands:\n"
               "  send --bus BUS CSV     send a pose list in real time\n\n"
               "`wallwarp-pose COMMAND --help` says more about a command.",
    };
    char send_name[] = "wallwarp-pose send"; /* how argp names it in its messages */
    argp_err_exit_status = PROGRAM_BAD_USAGE;
    command_t command = {.argc = 0};
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &command);
    command.argv[0] = send_name;
    return run_send(command.argc, command.argv);
}
