// SPDX-License-Identifier: Apache-2.0
// The name of a display, as a board's table has it: a connector, and the card it is on.
#ifndef HAL_LINUX_DISPLAY_KMS_NAME_H
#define HAL_LINUX_DISPLAY_KMS_NAME_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_board.h"

enum { KMS_NAME_LENGTH = 32, KMS_MAX_CARDS = 16, KMS_ANY_CARD = -1 };

typedef struct {
    int32_t card;                    /**< N of /dev/dri/cardN, or KMS_ANY_CARD */
    char connector[KMS_NAME_LENGTH]; /**< as the kernel names it: HDMI-A-1; "" for the first that is connected */
} kms_name_t;

/**
 * Read a name: HDMI-A-1, card1:HDMI-A-1, auto, card1:auto.
 *
 * @param[out] name   Written only when true is returned.
 * @param[out] error  Else: one line, what was found and expected.
 */
bool kms_name_parse(kms_name_t *name, const char *text, char error[HAL_BOARD_ERROR_LENGTH]);

#endif
