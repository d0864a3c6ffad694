// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-eval psnr.
#include "sim/eval/psnr_options.h"

#include <stdlib.h>
#include <string.h>

#include "sim/eval/eval_options.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/program.h"

enum { DEFAULT_FACTOR = 4 };

static const char limit_name[] = "limit";

const char *psnr_method_name(const warp_method_t *method)
{
    return method != NULL ? method->name : limit_name;
}

static void add_method(psnr_options_t *options, const char *name, struct argp_state *state)
{
    const warp_method_t *method = warp_method_from_name(name);
    if (method == NULL && strcmp(name, limit_name) != 0) {
        char names[PROGRAM_NAMES_LENGTH];
        program_method_names(names);
        argp_error(state, "--method '%s': no such method, expected all, limit, %s", name, names);
    }
    if (options->method_count == PSNR_MAX_METHODS)
        argp_error(state, "--method: too many methods, expected at most %d", PSNR_MAX_METHODS);
    options->method[options->method_count++] = method;
}

static void parse_methods(psnr_options_t *options, char *list, struct argp_state *state)
{
    options->method_count = 0;
    if (strcmp(list, "all") == 0) {
        add_method(options, limit_name, state);
        for (int m = 0; m < WARP_METHODS; m++)
            if (warp_methods[m].resampler != WARP_AUTO) /* it is one of the others */
                add_method(options, warp_methods[m].name, state);
        return;
    }
    for (char *name = strsep(&list, ","); name != NULL; name = strsep(&list, ","))
        add_method(options, name, state);
}

static int32_t parse_factor(const char *text, struct argp_state *state)
{
    char *end = NULL;
    const long factor = strtol(text, &end, 10);
    if (end == text || *end != '\0' || factor < 1 || factor > MESH_MAX_FACTOR)
        argp_error(state, "--factor '%s': expected a whole number from 1 to %d", text, MESH_MAX_FACTOR);
    return (int32_t)factor;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    psnr_options_t *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->place;
        return 0;
    case 'i':
        options->picture = argument;
        return 0;
    case 'o':
        options->original = argument;
        return 0;
    case 'f':
        options->factor = parse_factor(argument, state);
        return 0;
    case 'm':
        parse_methods(options, argument, state);
        return 0;
    case 'c':
        options->channels = true;
        return 0;
    case ARGP_KEY_END:
        if (options->picture == NULL)
            argp_error(state, "--in is missing: a PNG of the camera's size");
        if (options->method_count == 0)
            argp_error(state, "--method is missing: names of methods, or all");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

void psnr_options_parse(psnr_options_t *options, int argc, char **argv)
{
    static const struct argp_option own[] = {
        {.name = "in", .key = 'i', .arg = "PNG", .doc = "The picture, of the camera's size; colour is taken as luma"},
        {.name = "method", .key = 'm', .arg = "M[,M...]", .doc = "Methods to try, or all; limit is the best possible"},
        {.name = "factor", .key = 'f', .arg = "S", .doc = "Samples per picture pixel along each axis (default 4)"},
        {.name = "original",
         .key = 'o',
         .arg = "PNG",
         .doc = "Take this finer original as the truth: q times the picture's size; S is a multiple of q"},
        {.name = "channels", .key = 'c', .doc = "Besides luma (Y), red, green and blue of the picture in colour"},
        {0},
    };
    static const struct argp_child children[] = {{.argp = &eval_view_argp}, {0}};
    static const struct argp argp = {
        .options = own,
        .parser = parse,
        .args_doc = "ROOM",
        .doc =
            "How well each method's walls match the picture from the viewer's eye: the paper's mesh evaluation. "
            "Without --board: every wall, and the whole view.\v"
            "CSV on stdout, with a header. psnr_db is 'inf' when no sample differs; coverage is the share of samples "
            "on the wall.\n\n"
            "With --board the wall is alone in the view. Without, a column 'board' comes first; each sample belongs "
            "to the nearest wall in its way, a board's row counts the samples that it contributes, and a row 'view' "
            "follows with those of all walls, its k being the largest of theirs. With --channels a column 'channel' "
            "(Y, R, G, B) comes before 'method'.\n\n"
            "A wall that the viewer does not see, or that others hide, has coverage 0.0000 and psnr_db 'inf': it has "
            "no sample to be wrong.\n\n"
            "Memory: 16 bytes per projector pixel of every wall, 64 with --channels: for each 1080p wall 33 or 133 MB.",
        .children = children,
    };
    *options = (psnr_options_t){.factor = DEFAULT_FACTOR};
    argp_parse(&argp, argc, argv, 0, NULL, options);
}
