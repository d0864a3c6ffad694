// SPDX-License-Identifier: Apache-2.0
// Command-line arguments that the commands of wallwarp-sim share.
#include "sim/options.h"

#include <stdlib.h>

#include "sim/program.h"

const warp_kernels_t *options_kernels(struct argp_state *state, const char *text)
{
    const warp_kernels_t *kernels = warp_kernels_from_name(text);
    if (kernels == NULL)
        argp_error(state, "--kernels: found \"%s\", expected scalar or neon", text);
    return kernels;
}

const warp_method_t *options_method(struct argp_state *state, const char *text)
{
    const warp_method_t *method = warp_method_from_name(text);
    if (method != NULL)
        return method;
    char names[PROGRAM_NAMES_LENGTH];
    program_method_names(names);
    argp_error(state, "--method: found \"%s\", expected one of %s", text, names);
    return NULL;
}

error_t options_room(const char **room, char *text, struct argp_state *state)
{
    if (state->arg_num > 0)
        argp_error(state, "found \"%s\", expected one room file", text);
    *room = text;
    return 0;
}

long options_whole(struct argp_state *state, const char *option, const char *text, long least, long most)
{
    char *end;
    const long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || number < least || number > most)
        argp_error(state, "%s: found \"%s\", expected a whole number from %ld to %ld", option, text, least, most);
    return number;
}
