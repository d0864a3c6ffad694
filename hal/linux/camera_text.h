// SPDX-License-Identifier: Apache-2.0
// What cameras say when something is wrong: one line, the same line once.
#ifndef HAL_LINUX_CAMERA_TEXT_H
#define HAL_LINUX_CAMERA_TEXT_H

#include <stdbool.h>

#include "hal/hal_board.h"

/** The line said last. Begin with zeros. */
typedef struct {
    char line[HAL_BOARD_ERROR_LENGTH];
} camera_told_t;

/** Write the reason of a failure; cut where it is too long. @return false, always. */
bool camera_fail(char error[HAL_BOARD_ERROR_LENGTH], const char *format, ...) __attribute__((format(printf, 2, 3)));

/**
 * Say "camera NAME: TEXT" on stderr, unless that was said last.
 *
 * @return Was it said?
 */
bool camera_tell(camera_told_t *told, const char *name, const char *text);

#endif
