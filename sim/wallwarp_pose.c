// SPDX-License-Identifier: Apache-2.0
// The program wallwarp-pose: poses onto a CAN bus, and what is on one.
#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "sim/pose/commands.h"
#include "sim/program.h"

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {
    {"send", command_send},     {"bridge", command_bridge},   {"record", command_record},
    {"replay", command_replay}, {"monitor", command_monitor}, {"check", command_check},
    {"fault", command_fault},   {"command", command_command}, {"update", command_update},
};

static const char expected[] = "send, bridge, record, replay, monitor, check, fault, command or update";

enum { COMMANDS = sizeof commands / sizeof commands[0] };

typedef struct {
    int number; /**< in the table */
    int argc;   /**< of the command, with its name */
    char **argv;
} choice_t;

static error_t parse_command(int key, char *argument, struct argp_state *state)
{
    choice_t *choice = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        while (choice->number < COMMANDS && strcmp(argument, commands[choice->number].name) != 0)
            choice->number++;
        if (choice->number == COMMANDS)
            argp_error(state, "no such command: '%s', expected %s", argument, expected);
        choice->argc = state->argc - state->next + 1;
        choice->argv = &state->argv[state->next - 1];
        state->next = state->argc; /* the rest is the command's own */
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a command is missing: %s", expected);
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
        .doc = "Send poses onto a CAN bus, and look at one.\v"
               "Commands:\n"
               "  send       send a pose list or a made-up motion in real time\n"
               "  bridge     send what a tracker measures\n"
               "  record     write what is on a bus into a log\n"
               "  replay     send a log again\n"
               "  monitor    show poses, rates, losses, boards and load, live\n"
               "  check      say whether a bus is healthy\n"
               "  fault      make a bus bad on purpose\n"
               "  command    tell boards something, or ask them\n"
               "  update     all boards of a room to another version, as one\n\n"
               "`wallwarp-pose COMMAND --help` says more about a command.",
    };
    char name[32]; /* how argp names the command in its messages */
    argp_err_exit_status = PROGRAM_BAD_USAGE;
    choice_t choice = {.number = 0};
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &choice);
    snprintf(name, sizeof name, "wallwarp-pose %s", commands[choice.number].name);
    choice.argv[0] = name;
    return commands[choice.number].run(choice.argc, choice.argv);
}
