// SPDX-License-Identifier: Apache-2.0
// Command-line arguments that the commands of wallwarp-sim and wallwarp-pose share.
//
// Each reads one text; a wrong one ends the program as bad usage.
#ifndef SIM_OPTIONS_H
#define SIM_OPTIONS_H

#include <argp.h>

#include "warp_fixed/kernels.h"
#include "warp_fixed/method.h"

/** @return The table of loops that --kernels names. */
const warp_kernels_t *options_kernels(struct argp_state *state, const char *text);

/** @return The method that --method names. */
const warp_method_t *options_method(struct argp_state *state, const char *text);

/** Take the only argument that is no option: the room file. @return 0. */
error_t options_room(const char **room, char *text, struct argp_state *state);

/** @return A whole number from least to most. @param option  For the message: "--frames". */
long options_whole(struct argp_state *state, const char *option, const char *text, long least, long most);

#endif
