// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose replay` and `fault`: send a log, or another bus's frames, onto a bus, with faults when asked.
#include <argp.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sim/pose/bus_flood.h"
#include "sim/pose/bus_pump.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/program.h"

enum {
    KEY_SPEED = 256,
    KEY_FD,
    KEY_ALL,
    KEY_FROM,
    KEY_DROP,
    KEY_DUPLICATE,
    KEY_CORRUPT,
    KEY_DELAY,
    KEY_DELAY_MS,
    KEY_SEED,
    KEY_FLOOD,
    KEY_ID,
    KEY_BUS_OFF
};

typedef struct {
    bus_pump_t pump;
    bus_flood_t flood;
    bool flooding, bus_off;
} options_t;

static error_t parse_source(int key, char *argument, struct argp_state *state)
{
    bus_pump_t *pump = &((options_t *)state->input)->pump;
    switch (key) {
    case 'b':
        pump->bus = command_bus(state, argument);
        return 0;
    case KEY_SPEED:
        pump->speed = command_number(state, "--speed", argument, 0.001, 1000);
        return 0;
    case KEY_FD:
        pump->fd = true;
        return 0;
    case KEY_ALL:
        pump->reports = true;
        return 0;
    case ARGP_KEY_ARG:
        if (pump->log != NULL)
            argp_error(state, "one log expected, found also '%s'", argument);
        pump->log = argument;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_replay(int key, char *argument, struct argp_state *state)
{
    const options_t *options = state->input;
    if (key != ARGP_KEY_END)
        return parse_source(key, argument, state);
    if (options->pump.bus == NULL)
        argp_error(state, "--bus is missing");
    if (options->pump.log == NULL)
        argp_error(state, "the log is missing");
    return 0;
}

static void check_fault(struct argp_state *state, const options_t *options)
{
    const int sources =
        (options->pump.log != NULL) + (options->pump.from != NULL) + options->flooding + options->bus_off;
    if (options->pump.bus == NULL)
        argp_error(state, "--bus is missing");
    if (sources != 1)
        argp_error(state, "expected one of LOG, --from, --flood and --bus-off, found %d", sources);
    if (options->pump.from != NULL && strcmp(options->pump.from, options->pump.bus) == 0)
        argp_error(state, "--from and --bus: '%s' would hear itself; expected two different ones", options->pump.bus);
}

/* Per cent as parts in a million. */
static int32_t read_chance(struct argp_state *state, const char *option, const char *text)
{
    return (int32_t)lround(command_number(state, option, text, 0, 100) * 1e4);
}

static error_t parse_fault(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    bus_faults_t *faults = &options->pump.faults;
    switch (key) {
    case KEY_FROM:
        options->pump.from = command_bus(state, argument);
        return 0;
    case KEY_DROP:
        faults->drop_ppm = read_chance(state, "--drop", argument);
        return 0;
    case KEY_DUPLICATE:
        faults->duplicate_ppm = read_chance(state, "--duplicate", argument);
        return 0;
    case KEY_CORRUPT:
        faults->corrupt_ppm = read_chance(state, "--corrupt", argument);
        return 0;
    case KEY_DELAY:
        faults->delay_ppm = read_chance(state, "--delay", argument);
        return 0;
    case KEY_DELAY_MS:
        faults->delay_ms = (int32_t)command_number(state, "--delay-ms", argument, 1, BUS_PUMP_MOST_DELAY_MS);
        return 0;
    case KEY_SEED:
        options->pump.seed = (uint64_t)command_number(state, "--seed", argument, 0, 1e15);
        return 0;
    case KEY_FLOOD:
        options->flood.length_us = command_seconds_us(state, "--flood", argument);
        options->flooding = true;
        return 0;
    case KEY_ID:
        options->flood.id = (uint32_t)command_number(state, "--id", argument, 0, 0x7FF);
        return 0;
    case KEY_BUS_OFF:
        options->bus_off = true;
        return 0;
    case ARGP_KEY_END:
        check_fault(state, options);
        return 0;
    default:
        return parse_source(key, argument, state);
    }
}

static int pump(const options_t *options, const char *program)
{
    bus_pump_counts_t counts;
    char error[BUS_PUMP_MESSAGE_LENGTH];
    const bool ok = bus_pump(&options->pump, &counts, error);
    printf("%" PRId64 " frames sent", counts.sent);
    if (counts.dropped + counts.duplicated + counts.corrupted + counts.delayed > 0)
        printf(" of %" PRId64 ": %" PRId64 " dropped, %" PRId64 " duplicated, %" PRId64 " corrupted, %" PRId64
               " delayed",
               counts.taken, counts.dropped, counts.duplicated, counts.corrupted, counts.delayed);
    printf("\n");
    if (!ok)
        fprintf(stderr, "%s: %s\n", program, error);
    const int status = program_finish(program);
    if (*options->pump.stop)
        fprintf(stderr, "%s: interrupted\n", program);
    return ok && !*options->pump.stop ? status : PROGRAM_FAILED;
}

int command_replay(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"speed", KEY_SPEED, "X", 0, "X times as fast as it was recorded (1)", 0},
        {"fd", KEY_FD, NULL, 0, "Send CAN FD frames too; not to HOST:PORT", 0},
        {"all", KEY_ALL, NULL, 0, "Send bus time and what boards say too, which boards on the bus send themselves", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse_replay,
        .args_doc = "LOG",
        .doc = "Send a recorded bus again, in real time.\v"
               "LOG is a file of candump -l or `wallwarp-pose record`, or the bus.log of a simulation.",
    };
    options_t options = {.pump = {.speed = 1}};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    options.pump.stop = command_catch_stop();
    return pump(&options, argv[0]);
}

static int send_fault(const options_t *options, const char *program)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    int64_t sent = 0;
    const bool ok = options->flooding ? bus_flood(options->pump.bus, &options->flood, &sent, error)
                                      : bus_flood_bus_off(options->pump.bus, error);
    if (ok && options->flooding)
        printf("%" PRId64 " frames sent\n", sent);
    if (!ok)
        fprintf(stderr, "%s: %s\n", program, error);
    const int status = program_finish(program);
    return ok ? status : PROGRAM_FAILED;
}

int command_fault(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"from", KEY_FROM, "BUS", 0, "Be a bad gateway: send on what is heard on this other bus, instead of LOG", 0},
        {"drop", KEY_DROP, "PERCENT", 0, "Leave so many frames out", 1},
        {"duplicate", KEY_DUPLICATE, "PERCENT", 0, "Send so many twice", 1},
        {"corrupt", KEY_CORRUPT, "PERCENT", 0, "Turn one to three bits in so many", 1},
        {"delay", KEY_DELAY, "PERCENT", 0, "Send so many late, after others", 1},
        {"delay-ms", KEY_DELAY_MS, "MS", 0, "How late that is (20)", 1},
        {"seed", KEY_SEED, "N", 0, "Of the chances; the same gives the same faults (1)", 1},
        {"flood", KEY_FLOOD, "SECONDS", 0, "Send frames that win every arbitration, as fast as the bus takes them", 2},
        {"id", KEY_ID, "N", 0, "Identifier of the flood (0)", 2},
        {"bus-off", KEY_BUS_OFF, NULL, 0, "On a virtual interface (vcan): tell all listeners that they are bus-off", 2},
        {"speed", KEY_SPEED, "X", 0, "LOG: X times as fast as it was recorded (1)", 3},
        {"fd", KEY_FD, NULL, 0, "Send CAN FD frames too; not to HOST:PORT", 3},
        {"all", KEY_ALL, NULL, 0, "Send bus time and what boards say too, which boards on the bus send themselves", 3},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse_fault,
        .args_doc = "[LOG]",
        .doc = "Make the bus bad on purpose, to see what the boards do.\v"
               "Takes frames from LOG (candump -l) or from another bus, and sends them on with faults; or floods; or "
               "says bus-off. PERCENT is 0 to 100, decimals allowed.",
    };
    options_t options = {.pump = {.speed = 1, .seed = 1, .faults = {.delay_ms = 20}}};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    options.pump.stop = options.flood.stop = command_catch_stop();
    return options.flooding || options.bus_off ? send_fault(&options, argv[0]) : pump(&options, argv[0]);
}
