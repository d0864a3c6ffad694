// SPDX-License-Identifier: Apache-2.0
// Which machine this is, by its device tree.
#ifndef HAL_LINUX_MACHINE_LINUX_H
#define HAL_LINUX_MACHINE_LINUX_H

#include <stdbool.h>

#include "hal/hal_board.h"

enum { MACHINE_LINUX_NAME_LENGTH = 64 };

/**
 * Is it the machine that a board's table names?
 *
 * A device tree lists what the machine is compatible with, from its own name to its chip's: "raspberrypi,4-model-b",
 * "brcm,bcm2711" (Devicetree Specification, 2.3.1).
 *
 * @param      root   Before /proc: "", or a test's folder.
 * @param      name   board_table_t's machine; NULL: any is.
 * @param[out] found  The first that is listed; "" when there is no device tree.
 * @return true also without a device tree: nobody can tell.
 */
bool machine_linux_is(const char *root, const char *name, char found[MACHINE_LINUX_NAME_LENGTH]);

/**
 * Refuse to go on with the firmware of another board.
 *
 * @param[out] error  On failure: one line, which machine this is, and which the table's is.
 * @return HAL_OK; HAL_IO when it is another one.
 */
MUST_CHECK hal_status_t machine_linux_open(const char *root, const board_table_t *table,
                                           char error[HAL_BOARD_ERROR_LENGTH]);

#endif
