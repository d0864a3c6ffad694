// SPDX-License-Identifier: Apache-2.0
// Command-line options that the commands of wallwarp-eval share: ROOM --board NAME --pose "...".
#ifndef SIM_EVAL_EVAL_OPTIONS_H
#define SIM_EVAL_EVAL_OPTIONS_H

#include <argp.h>

#include "sim/eval/warp_once.h"

/**
 * An argp child whose input is a warp_once_place_t, empty at the start. All three are required; anything missing or
 * too much ends the program as bad usage.
 */
extern const struct argp eval_place_argp;

/** The same for commands that take every board of the room when none is named. */
extern const struct argp eval_view_argp;

/**
 * Open the wall; on failure say on stderr why. Warnings of the room file go to stderr too.
 *
 * @param command  As it begins error messages: "wallwarp-eval grid".
 */
warp_once_status_t eval_open(warp_once_t *once, const warp_once_place_t *place, const char *command);

/** The same for the walls of a place, as warp_once_open_walls() has it. */
warp_once_status_t eval_open_walls(warp_once_t *wall, int32_t *walls, const warp_once_place_t *place,
                                   const char *command);

/** Write one line "COMMAND: what" on stderr. */
void eval_error(const char *command, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
