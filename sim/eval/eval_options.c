// SPDX-License-Identifier: Apache-2.0
// Command-line options that the commands of wallwarp-eval share: ROOM --board NAME --pose "...".
#include "sim/eval/eval_options.h"

#include <stdarg.h>
#include <stdio.h>

#include "sim/program.h"

static error_t parse_view(int key, char *argument, struct argp_state *state)
{
    warp_once_place_t *place = state->input;
    switch (key) {
    case 'b':
        place->board = argument;
        return 0;
    case 'p':
        place->pose = argument;
        return 0;
    case ARGP_KEY_ARG:
        if (place->room != NULL)
            argp_error(state, "'%s' is one argument too many, expected one ROOM", argument);
        place->room = argument;
        return 0;
    case ARGP_KEY_END:
        if (place->room == NULL)
            argp_error(state, "ROOM is missing: the path of a room file");
        if (place->pose == NULL)
            argp_error(state, "--pose is missing: \"x_mm y_mm z_mm qw qx qy qz\"");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_place(int key, char *argument, struct argp_state *state)
{
    const warp_once_place_t *place = state->input;
    const error_t result = parse_view(key, argument, state);
    if (key == ARGP_KEY_END && place->board == NULL)
        argp_error(state, "--board is missing: the name of a board in the room file");
    return result;
}

static const struct argp_option place_options[] = {
    {.name = "board", .key = 'b', .arg = "NAME", .doc = "The board, by its name in the room file"},
    {.name = "pose",
     .key = 'p',
     .arg = "\"X Y Z QW QX QY QZ\"",
     .doc = "The viewer's eye in mm, and the quaternion that turns camera vectors into world vectors"},
    {0},
};

const struct argp eval_place_argp = {.options = place_options, .parser = parse_place};
const struct argp eval_view_argp = {.options = place_options, .parser = parse_view};

warp_once_status_t eval_open_walls(warp_once_t *wall, int32_t *walls, const warp_once_place_t *place,
                                   const char *command)
{
    char error[ROOM_MESSAGE_LENGTH];
    const warp_once_status_t status = warp_once_open_walls(wall, walls, place, program_warn, error);
    if (status != WARP_ONCE_OK)
        eval_error(command, "%s", error);
    return status;
}

warp_once_status_t eval_open(warp_once_t *once, const warp_once_place_t *place, const char *command)
{
    int32_t one;
    return eval_open_walls(once, &one, place, command);
}

void eval_error(const char *command, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", command);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}
