// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose monitor` and `check`: show, or judge, what is on a bus.
#include <argp.h>
#include <stdio.h>
#include <unistd.h>

#include "firmware/room.h"
#include "sim/devices/sim_clock.h"
#include "sim/pose/bus_check.h"
#include "sim/pose/bus_check_room.h"
#include "sim/pose/bus_listen.h"
#include "sim/pose/bus_table.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/program.h"

enum { US_PER_S = 1000000, CHECK_US = 5 * US_PER_S, KEY_BITRATE = 256, KEY_DATA_BITRATE, KEY_ROOM };

typedef struct {
    const char *bus, *room;
    int64_t length_us;
    int32_t bitrate, data_bitrate; /* 0: not given */
} options_t;

/* What is watched, and when it was last shown. */
typedef struct {
    bus_watch_t watch;
    const char *bus;
    bool terminal;
    int64_t shown_us;
} view_t;

static const struct argp_option option_table[] = {
    {"bus", 'b', "BUS", 0, command_bus_help, 0},
    {"seconds", 's', "S", 0, "How long to listen (monitor: until SIGINT; check: 5)", 0},
    {"bitrate", KEY_BITRATE, "N", 0, "Bit rate of the bus, for its load (500000)", 0},
    {"data-bitrate", KEY_DATA_BITRATE, "N", 0, "Data bit rate of CAN FD frames (2000000)", 0},
    {0},
};

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
    case KEY_BITRATE:
        options->bitrate = (int32_t)command_number(state, "--bitrate", argument, 10000, 1000000);
        return 0;
    case KEY_DATA_BITRATE:
        options->data_bitrate = (int32_t)command_number(state, "--data-bitrate", argument, 10000, 8000000);
        return 0;
    case ARGP_KEY_END:
        if (options->bus == NULL)
            argp_error(state, "--bus is missing");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option check_table[] = {
    {"room", KEY_ROOM, "ROOM", 0,
     "The room file: are its boards there, and poses for them, and is its pose_delay_ms enough for what is measured? "
     "And its bit rates",
     0},
    {0},
};

/* What check takes besides. */
static error_t parse_check(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    if (key == ARGP_KEY_INIT)
        state->child_inputs[0] = options;
    if (key != KEY_ROOM)
        return ARGP_ERR_UNKNOWN;
    options->room = argument;
    return 0;
}

static options_t read_options(const struct argp *argp, int argc, char **argv)
{
    options_t options = {.bus = NULL};
    argp_parse(argp, argc, argv, 0, NULL, &options);
    return options;
}

static bool take_frame(void *context, const hal_can_frame_t *frame)
{
    view_t *view = context;
    bus_watch_take(&view->watch, frame);
    return true;
}

static void count_error(void *context)
{
    view_t *view = context;
    view->watch.errors++;
}

/* In place ten times a second on a terminal, else a table a second. */
static void show(void *context)
{
    static const char clear_screen[] = "\033[H\033[J";
    view_t *view = context;
    const int64_t now_us = sim_clock_monotonic_us();
    if (!view->terminal && now_us - view->shown_us < US_PER_S)
        return;
    view->shown_us = now_us;
    fputs(view->terminal ? clear_screen : "", stdout);
    bus_table_print(stdout, view->bus, &view->watch);
    (void)fflush(stdout);
}

/* @return Was there a bus to hear? */
static bool look(view_t *view, const options_t *options, const char *program, bool live)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    bus_watch_init(&view->watch, options->bitrate > 0 ? options->bitrate : 500000,
                   options->data_bitrate > 0 ? options->data_bitrate : 2000000);
    view->bus = options->bus;
    view->shown_us = sim_clock_monotonic_us();
    const bus_listen_t listen = {
        .length_us = options->length_us,
        .stop = command_catch_stop(),
        .frame = take_frame,
        .tick = live ? show : NULL,
        .bus_error = count_error,
        .context = view,
    };
    const bus_listen_end_t end = bus_listen(options->bus, &listen, error);
    if (end != BUS_LISTEN_DONE)
        fprintf(stderr, "%s: %s\n", program, error);
    return end != BUS_LISTEN_FAILED;
}

int command_monitor(int argc, char **argv)
{
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .doc =
            "Show what is on a bus: poses, their rate, jitter and losses, bus time, the boards, the load.\v"
            "On a terminal the table is renewed in place, else a new one is printed every second. delay_ms is from a "
            "pose's capture until it comes, in bus time, and worst_ms the longest. lost, crc, "
            "repeat, bad and not_seen are a board's own counts of a viewer's poses: lost on the way, damaged, "
            "repeated or stale, impossible or incomplete, and those in which the tracker does not see the viewer. "
            "in_step is the share of refreshes at which a board was certain to show what all do; those that two "
            "boards in step, or more, told of are compared, and differed must stay 0. runs and waiting are "
            "fingerprints of versions, equal where these are; `wallwarp-pose update --status` names them.",
    };
    static view_t view;
    const options_t options = read_options(&argp, argc, argv);
    view.terminal = isatty(STDOUT_FILENO) == 1;
    if (!look(&view, &options, argv[0], true))
        return PROGRAM_FAILED;
    view.shown_us = 0; /* the end is always shown */
    show(&view);
    return program_finish(argv[0]);
}

/* @return false when there is none; said. */
static bool read_room(options_t *options, room_t *room, const char *program)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (!room_load(room, options->room, program_warn, NULL, error)) {
        fprintf(stderr, "%s: %s\n", program, error);
        return false;
    }
    options->bitrate = options->bitrate > 0 ? options->bitrate : room->bitrate;
    options->data_bitrate = options->data_bitrate > 0 ? options->data_bitrate : room->data_bitrate;
    return true;
}

int command_check(int argc, char **argv)
{
    static const struct argp common = {.options = option_table, .parser = parse};
    static const struct argp_child children[] = {{.argp = &common}, {0}};
    static const struct argp argp = {
        .options = check_table,
        .parser = parse_check,
        .children = children,
        .doc = "Say whether a bus is healthy, and if not, what to look at.\v"
               "Prints a line for each thing looked at, \"ok\" or \"BAD\". The exit status is 0 when all is well, 1 "
               "when something is bad, 2 for bad usage.",
    };
    static view_t view;
    static room_t room;
    options_t options = read_options(&argp, argc, argv);
    if (options.room != NULL && !read_room(&options, &room, argv[0]))
        return PROGRAM_FAILED;
    if (options.length_us == 0)
        options.length_us = CHECK_US;
    if (options.length_us < BUS_CHECK_LEAST_US)
        options.length_us = BUS_CHECK_LEAST_US;
    if (!look(&view, &options, argv[0], false))
        return PROGRAM_FAILED;
    int bad = options.room == NULL ? 0 : bus_check_room(stdout, &view.watch, &room);
    bad += bus_check_print(stdout, &view.watch, options.room == NULL ? BUS_CHECK_NO_DELAY : room.pose_delay_us);
    const int status = program_finish(argv[0]);
    return bad > 0 ? PROGRAM_FAILED : status;
}
