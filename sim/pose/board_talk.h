// SPDX-License-Identifier: Apache-2.0
// Requests to boards over a bus, and their replies: ISO-TP with any number of boards at the same time.
#ifndef SIM_POSE_BOARD_TALK_H
#define SIM_POSE_BOARD_TALK_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "firmware/command.h"
#include "firmware/isotp.h"
#include "sim/pose/pose_link.h"

/** One request to one board. */
typedef struct {
    uint8_t node; /**< 1 to CAN_MAX_NODE */
    command_t request;
    bool replied;   /**< the rest means something: */
    uint8_t result; /**< a command_result_t, or a newer one */
    int length;     /**< bytes of the answer behind it */
    uint8_t answer[COMMAND_REPLY_BYTES];

    isotp_t link; /**< the module's own from here on */
    bool begun;
} board_talk_t;

/**
 * Send requests and wait for the replies, until all are here, or none has gone on for so long.
 *
 * @param         bus       Listening.
 * @param[in,out] talk      node and request are read, the rest is written. Each node once.
 * @param         quiet_us  How long a board may be silent.
 * @param         stop      Ends it when it becomes non-zero.
 * @param[out]    error     On failure: one line without newline.
 * @return false when the link has failed. Boards that did not reply are no failure.
 */
bool board_talk(pose_link_t *bus, board_talk_t *talk, int count, int64_t quiet_us, const volatile sig_atomic_t *stop,
                char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
