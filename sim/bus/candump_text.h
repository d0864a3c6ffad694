// SPDX-License-Identifier: Apache-2.0
// Lines of the log format of can-utils (candump -l, canplayer), the one that other CAN tools read too.
#ifndef SIM_BUS_CANDUMP_TEXT_H
#define SIM_BUS_CANDUMP_TEXT_H

#include <stddef.h>

#include "hal/hal_can.h"

enum {
    CANDUMP_INTERFACE_LENGTH = 16, /**< of a name, with its final zero */
    CANDUMP_TEXT_LENGTH = 224      /**< of a line, with its final zero */
};

/**
 * Write a frame as a line without newline: "(12.345678) can0 123#1122", CAN FD "(12.345678) can0 123##11122" with the
 * flag 1 for bit rate switch. An extended identifier has 8 digits.
 *
 * @param[out] text       The line with a final zero.
 * @param      frame      time_us >= 0.
 * @param      interface  Its bus; at most CANDUMP_INTERFACE_LENGTH - 1 characters are written.
 * @return Characters written, without the zero.
 */
size_t candump_text_from_frame(char text[CANDUMP_TEXT_LENGTH], const hal_can_frame_t *frame, const char *interface);

/**
 * Read such a line. White space at its end and a direction (" R", " T") after the data are allowed.
 *
 * @param[out] frame      Written only on success; its time is that of the line, at most 10^10 s.
 * @param[out] interface  Its bus; written only on success.
 * @param      line       Ends with a zero.
 * @return NULL on success, else what was expected: a text that stays.
 */
const char *candump_frame_from_text(hal_can_frame_t *frame, char interface[CANDUMP_INTERFACE_LENGTH], const char *line);

#endif
