// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval grid: where projector pixels fall in the picture, from the frame's own fixed-point grid.
#include "sim/eval/eval_grid.h"

#include <stdio.h>
#include <stdlib.h>

#include "sim/eval/eval_options.h"
#include "sim/program.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/grid_row.h"

/* As typed: may lie far outside the panel. */
typedef struct {
    long i, j;
} at_t;

typedef struct {
    warp_once_place_t place;
    at_t *at; /* room for every word of the command line */
    int at_count;
} options_t;

static at_t parse_at(const char *text, struct argp_state *state)
{
    char *comma = NULL, *end = NULL;
    at_t at = {.i = strtol(text, &comma, 10)};
    if (comma == text || *comma != ',')
        argp_error(state, "--at '%s': expected \"i,j\", a projector pixel", text);
    at.j = strtol(comma + 1, &end, 10);
    if (end == comma + 1 || *end != '\0')
        argp_error(state, "--at '%s': expected \"i,j\", a projector pixel", text);
    return at;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->place;
        return 0;
    case 'a':
        options->at[options->at_count++] = parse_at(argument, state);
        return 0;
    case ARGP_KEY_END:
        if (options->at_count == 0)
            argp_error(state, "--at is missing: \"i,j\", once per projector pixel");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static bool all_on_panel(const options_t *options, const warp_once_t *once, const char *command)
{
    const int32_t width = once->homography.panel_width, height = once->homography.panel_height;
    for (int n = 0; n < options->at_count; n++) {
        const at_t at = options->at[n];
        if (at.i >= 0 && at.i < width && at.j >= 0 && at.j < height)
            continue;
        eval_error(command, "--at '%ld,%ld': outside the panel of board %s, expected i from 0 to %d, j from 0 to %d",
                   at.i, at.j, once->board.name, width - 1, height - 1);
        return false;
    }
    return true;
}

static void print_point(const homography_t *homography, const grid_t *grid, int32_t i, int32_t j)
{
    const double one = 1 << GRID_FRACTION_BITS;
    const double depth_mm = (double)homography_depth_um(homography, 2 * i + 1, 2 * j + 1) / 1000.0;
    int32_t x_q18, y_q18;
    const bool inside = grid_point(grid, i, j, &x_q18, &y_q18) && x_q18 >= 0 && y_q18 >= 0 &&
                        x_q18 <= homography->picture_width << GRID_FRACTION_BITS &&
                        y_q18 <= homography->picture_height << GRID_FRACTION_BITS;
    if (inside)
        printf("%d %d %.6f %.6f %.3f 1\n", i, j, x_q18 / one, y_q18 / one, depth_mm);
    else
        printf("%d %d - - %.3f 0\n", i, j, depth_mm);
}

static int print_points(const options_t *options, const char *command)
{
    warp_once_t once;
    const warp_once_status_t status = eval_open(&once, &options->place, command);
    if (status != WARP_ONCE_OK)
        return (int)status;
    const bool on_panel = all_on_panel(options, &once, command);
    if (on_panel) {
        grid_from_homography(&once.warp->plane[0].grid, &once.homography);
        for (int n = 0; n < options->at_count; n++)
            print_point(&once.homography, &once.warp->plane[0].grid, (int32_t)options->at[n].i,
                        (int32_t)options->at[n].j);
    }
    warp_once_close(&once);
    return on_panel ? program_finish(command) : WARP_ONCE_BAD_USAGE;
}

int eval_grid(int argc, char **argv)
{
    static const struct argp_option own[] = {
        {.name = "at", .key = 'a', .arg = "I,J", .doc = "A projector pixel; once per pixel"},
        {0},
    };
    static const struct argp_child children[] = {{.argp = &eval_place_argp}, {0}};
    static const struct argp argp = {
        .options = own,
        .parser = parse,
        .args_doc = "ROOM",
        .doc = "Where projector pixels fall in the viewer's picture, from the frame's own fixed-point grid.\v"
               "One line per pixel: i j u v depth_mm inside. u and v are picture pixels, '-' where inside is 0.",
        .children = children,
    };
    options_t options = {.at = calloc((size_t)argc, sizeof *options.at)};
    if (options.at == NULL) {
        eval_error(argv[0], "out of memory");
        return WARP_ONCE_FAILED;
    }
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const int status = print_points(&options, argv[0]);
    free(options.at);
    return status;
}
