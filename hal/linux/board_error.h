// SPDX-License-Identifier: Apache-2.0
// How a device of Linux says why it can't be opened.
#ifndef HAL_LINUX_BOARD_ERROR_H
#define HAL_LINUX_BOARD_ERROR_H

#include "hal/hal_board.h"

/**
 * Write the one line that hal_board_open() hands on: what, with which device, what was expected, and the command that
 * mends it. A line that is too long is cut.
 *
 * @return HAL_IO, for the caller to return.
 */
hal_status_t board_error(char error[HAL_BOARD_ERROR_LENGTH], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
