// SPDX-License-Identifier: Apache-2.0
// What the programs of the simulator have in common: exit statuses, and what they all say alike.
#ifndef SIM_PROGRAM_H
#define SIM_PROGRAM_H

enum { PROGRAM_DONE = 0, PROGRAM_FAILED = 1, PROGRAM_BAD_USAGE = 2, PROGRAM_NAMES_LENGTH = 512 };

/** A room_warning_fn: one line "warning: LINE" on stderr. The context is not used. */
void program_warn(void *context, const char *line);

/**
 * Name every method of this build.
 *
 * @param[out] names  "none+nearest, none+linear, ...", cut to PROGRAM_NAMES_LENGTH - 1 bytes.
 */
void program_method_names(char names[PROGRAM_NAMES_LENGTH]);

/**
 * Push out what stdout still holds.
 *
 * @param command  As it begins error messages: "wallwarp-sim run".
 * @return The exit status: 0, or 1 when stdout did not take everything (then said on stderr).
 */
int program_finish(const char *command);

#endif
