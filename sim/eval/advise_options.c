// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-eval advise.
#include "sim/eval/advise_options.h"

#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As far as poses may be from the origin. */
static const double most_mm = 1e6;

/* One number; *text moves behind it. NAN when there is none within +-most_mm. */
static double number_from(const char **text)
{
    char *end = NULL;
    const double number = strtod(*text, &end);
    const bool good = end != *text && fabs(number) <= most_mm;
    *text = end;
    return good ? number : (double)NAN;
}

static walk_area_t parse_area(const char *text, struct argp_state *state)
{
    double number[4];
    const char *at = text;
    bool good = true;
    for (int n = 0; n < 4; n++) {
        number[n] = number_from(&at);
        good = good && !isnan(number[n]);
    }
    if (!good || at[strspn(at, " \t")] != '\0')
        argp_error(state, "--area '%s': expected \"A0 B0 A1 B1\", two opposite corners in mm, within 1000 m", text);
    walk_area_t area;
    for (int s = 0; s < 2; s++) {
        area.low_mm[s] = fmin(number[s], number[s + 2]);
        area.high_mm[s] = fmax(number[s], number[s + 2]);
    }
    return area;
}

static double parse_height(const char *text, struct argp_state *state)
{
    const char *end = text;
    const double height_mm = number_from(&end);
    if (isnan(height_mm) || *end != '\0')
        argp_error(state, "--height '%s': expected mm above the lowest corner, within 1000 m", text);
    return height_mm;
}

static walk_up_t parse_up(const char *text, struct argp_state *state)
{
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2)
            if (strcmp(walk_up_name((walk_up_t){axis, sign}), text) == 0)
                return (walk_up_t){axis, sign};
    argp_error(state, "--up '%s': expected x, y, z, -x, -y or -z", text);
    return (walk_up_t){0, 0};
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    advise_options_t *options = state->input;
    switch (key) {
    case 'a':
        if (options->areas == ADVISE_MAX_AREAS)
            argp_error(state, "--area: too many areas, expected at most %d", ADVISE_MAX_AREAS);
        options->area[options->areas++] = parse_area(argument, state);
        return 0;
    case 'e':
        options->height_mm = parse_height(argument, state);
        return 0;
    case 'u':
        options->up = parse_up(argument, state);
        return 0;
    case 'c':
        options->csv = true;
        return 0;
    case ARGP_KEY_ARG:
        if (options->room != NULL)
            argp_error(state, "'%s' is one argument too many, expected one ROOM", argument);
        options->room = argument;
        return 0;
    case ARGP_KEY_END:
        if (options->room == NULL)
            argp_error(state, "ROOM is missing: the path of a room file");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

void advise_options_parse(advise_options_t *options, int argc, char **argv)
{
    static const struct argp_option own[] = {
        {.name = "area",
         .key = 'a',
         .arg = "\"A0 B0 A1 B1\"",
         .doc = "Where the viewer walks: two opposite corners, mm, on the two level axes in the order x, y, z; may be "
                "repeated"},
        {.name = "height",
         .key = 'e',
         .arg = "MM",
         .doc = "Height of the eye above the lowest corner of all walls (default 1700)"},
        {.name = "up", .key = 'u', .arg = "AXIS", .doc = "The world's way up: x, y, z, -x, -y or -z"},
        {.name = "csv", .key = 'c', .doc = "Print CSV instead of a table to read"},
        {0},
    };
    static const struct argp argp = {
        .options = own,
        .parser = parse,
        .args_doc = "ROOM",
        .doc =
            "Which method suits each wall of a room, for a viewer who walks in it: the range of the step k, how far "
            "each method stays below the limit, and what it costs.\v"
            "From 7 x 7 places of each area the viewer looks at the wall's centre; k is what the board's 'step' takes. "
            "Where k is least, median and largest, every method warps a built-in picture (edges of all sizes, "
            "amplitude 1/f, as photographs have), with picture and projector made smaller alike. Gaps are dB below "
            "the limit, means of the three: 'gap_db' with the picture's own pixels for the truth, as in the paper, "
            "'gap_original_db' with an original 4 times as fine, which is nearer to what an eye wants. That other "
            "walls may hide a wall is not considered.\n\n"
            "Cost: texels read per projector pixel, plus filter taps per picture pixel times the picture's pixels "
            "per projector pixel. none+nearest is 1.\n\n"
            "Unless given, up is the axis towards which most walls have the tops of their pictures, and the area is "
            "the rectangle around all walls, less 0.5 m on every side. Before a wall that stands alone the area "
            "reaches "
            "as far as the wall is wide, and at least 3 m.\n\n"
            "--csv: board,method,k_min,k_median,k_max,gap_db,gap_original_db,cost; '-' where the wall is not seen.",
    };
    *options = (advise_options_t){.height_mm = WALK_DEFAULT_HEIGHT_MM};
    argp_parse(&argp, argc, argv, 0, NULL, options);
}
