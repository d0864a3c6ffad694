// SPDX-License-Identifier: Apache-2.0
// `wallwarp --check`: says what of the board is there and what is missing, and changes nothing.
#ifndef FIRMWARE_SELF_CHECK_H
#define FIRMWARE_SELF_CHECK_H

#include <stdbool.h>

#include "firmware/setup.h"

/**
 * Print a line for each thing on stdout: configuration, room, key, and what hal_board_check() looks at.
 *
 * @param setup    All zero bytes; nothing of it stays open.
 * @param options  As they were read; a configuration completes them.
 * @return Nothing is missing.
 */
bool self_check(setup_t *setup, options_t *options);

#endif
