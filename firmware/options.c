// SPDX-License-Identifier: Apache-2.0
// What people tell the firmware: its command line, and what of the board's own file that leaves open.
#include "firmware/options.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>

#include "firmware/auth_key.h"

enum { KEY_CONFIG = 256, KEY_CAN, KEY_CAMERA, KEY_DISPLAY, KEY_KERNELS, KEY_WORKERS, KEY_KEY, KEY_CHECK, KEY_OFF };

static const struct argp_option option_table[] = {
    {"node", 'n', "N", 0, "Node number of this board in the room file; needed, here or in --config", 0},
    {"config", KEY_CONFIG, "FILE", 0,
     "The board's own file, wallwarp.yaml: it has what is not given here; what is wrong with it is told by the wall",
     0},
    {"can", KEY_CAN, "NAME", 0, "Bus, in place of the board's own", 0},
    {"camera", KEY_CAMERA, "NAME", 0, "Video source, in place of the board's own", 0},
    {"display", KEY_DISPLAY, "NAME", 0, "Display, in place of the board's own", 0},
    {"key", KEY_KEY, "FILE", 0, auth_key_help, 0},
    {"kernels", KEY_KERNELS, "LEVEL", 0, "Pixel loops: scalar or neon, of the same bytes (default: the fastest)", 0},
    {"workers", KEY_WORKERS, "N", 0, "Threads that make a picture together, 1 to 4, in place of the board's own", 0},
    {"check", KEY_CHECK, NULL, 0, "Say what of the board is there and what is missing, change nothing, and end", 1},
    {"off", KEY_OFF, NULL, 0, "Drive the board's outputs low, the lamp's too, and end", 1},
    {0},
};

/* A number from 1 to the largest; anything else ends the program. */
static int32_t read_number(struct argp_state *state, const char *option, const char *text, int32_t largest)
{
    char *end;
    const long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || number < 1 || number > largest)
        argp_error(state, "--%s: found \"%s\", expected 1 to %d", option, text, largest);
    return (int32_t)number;
}

static void check_usage(struct argp_state *state, const options_t *options)
{
    const bool whole = options->room != NULL && options->node != 0;
    const bool none = options->room == NULL && options->node == 0;
    if (options->config == NULL && !whole && !(none && options->task != OPTIONS_RUN))
        argp_error(state, "expected ROOM and --node N, or --config FILE");
}

static const warp_kernels_t *read_kernels(struct argp_state *state, const char *text)
{
    const warp_kernels_t *kernels = warp_kernels_from_name(text);
    if (kernels == NULL)
        argp_error(state, "--kernels: found \"%s\", expected scalar or neon", text);
    return kernels;
}

static error_t read_option(int key, char *text, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'n':
        options->node = read_number(state, "node", text, ROOM_MAX_NODE);
        return 0;
    case KEY_CONFIG:
        options->config = text;
        return 0;
    case KEY_WORKERS:
        options->workers = read_number(state, "workers", text, HAL_WORKERS_MAX);
        return 0;
    case KEY_CAN:
        options->can = text;
        return 0;
    case KEY_CAMERA:
        options->camera = text;
        return 0;
    case KEY_DISPLAY:
        options->display = text;
        return 0;
    case KEY_KEY:
        options->key = text;
        return 0;
    case KEY_KERNELS:
        options->kernels = read_kernels(state, text);
        return 0;
    case KEY_CHECK:
        options->task = OPTIONS_CHECK;
        return 0;
    case KEY_OFF:
        options->task = OPTIONS_OFF;
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num > 0)
            argp_error(state, "found \"%s\", expected one room file", text);
        options->room = text;
        return 0;
    case ARGP_KEY_END:
        check_usage(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

options_t options_read(int argc, char **argv)
{
    static char doc[HAL_BOARD_HELP_LENGTH + 256];
    static const struct argp argp = {
        .options = option_table,
        .parser = read_option,
        .args_doc = "ROOM --node N\n--config FILE\n--check [ROOM --node N | --config FILE]\n--off",
        .doc = doc,
    };
    options_t options = {.kernels = warp_kernels_best()};
    argp_err_exit_status = OPTIONS_BAD_USAGE;
    (void)snprintf(doc, sizeof doc,
                   "The projector's firmware: shows on one wall of ROOM what the tracked viewer must see.\v%s Ends on "
                   "SIGINT or SIGTERM. Exit status: 0 done, 1 failed or something is missing, 2 bad usage.",
                   hal_board_help);
    if (argp_parse(&argp, argc, argv, 0, NULL, &options) != 0)
        exit(OPTIONS_BAD_USAGE);
    return options;
}

/* What was given, or what a configuration has. */
static const char *either(const char *given, const char *configured)
{
    return given != NULL || configured[0] == '\0' ? given : configured;
}

void options_complete(options_t *options, const board_config_t *config)
{
    options->node = options->node == 0 ? config->node : options->node;
    options->workers = options->workers == 0 ? config->workers : options->workers;
    options->room = either(options->room, config->room);
    options->key = either(options->key, config->key);
    options->can = either(options->can, config->can);
    options->camera = either(options->camera, config->camera);
    options->display = either(options->display, config->display);
}

board_table_t options_devices(const options_t *options)
{
    board_table_t devices = board_table;
    devices.can = options->can == NULL ? devices.can : options->can;
    devices.camera = options->camera == NULL ? devices.camera : options->camera;
    devices.display = options->display == NULL ? devices.display : options->display;
    devices.workers.count = options->workers == 0 ? devices.workers.count : options->workers;
    return devices;
}
