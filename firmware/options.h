// SPDX-License-Identifier: Apache-2.0
// What people tell the firmware: its command line, and what of the board's own file that leaves open.
#ifndef FIRMWARE_OPTIONS_H
#define FIRMWARE_OPTIONS_H

#include <stdint.h>

#include "firmware/board_config.h"
#include "hal/hal_board.h"
#include "warp_fixed/kernels.h"

/** Strings are the command line's own, or the configuration's. What is not given is NULL or 0. */
typedef struct {
    enum { OPTIONS_RUN, OPTIONS_CHECK, OPTIONS_OFF } task;
    const char *config; /**< the board's own file, not read yet */
    const char *room, *key;
    int32_t node;
    const char *can, *camera, *display;
    int32_t workers;
    const warp_kernels_t *kernels; /**< the fastest, when none are named */
} options_t;

enum { OPTIONS_BAD_USAGE = 2 /**< exit status */ };

/** Read the command line. Ends the program when that is wrong, or asks for help. */
options_t options_read(int argc, char **argv);

/** Take from a configuration what was not given. @param config  Must outlive the options. */
void options_complete(options_t *options, const board_config_t *config);

/** @return The board's own devices, but for those that were given. */
board_table_t options_devices(const options_t *options);

#endif
