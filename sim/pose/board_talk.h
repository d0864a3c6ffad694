// SPDX-License-Identifier: Apache-2.0
// Requests to boards over a bus, and their replies: ISO-TP with any number of boards at the same time.
#ifndef SIM_POSE_BOARD_TALK_H
#define SIM_POSE_BOARD_TALK_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_auth.h"
#include "firmware/command.h"
#include "firmware/isotp.h"
#include "sim/pose/pose_link.h"

enum { BOARD_TALK_TRIES = 3 };

/** One request to one board. */
typedef struct {
    uint8_t node; /**< 1 to CAN_MAX_NODE */
    command_t request;
    can_auth_t *auth; /**< for the codes behind requests; NULL: none are sent */
    int tries;        /**< how often it was asked: more than once when it, or a frame of either message, was not heard,
                           or another has asked it for a number meanwhile */
    bool alive;       /**< its heartbeat was heard meanwhile, */
    bool answering;   /**< and frames of a reply, maybe not a whole one */
    bool replied;     /**< the rest means something: */
    bool keyless;     /**< with auth: the board has no key, and has done nothing */
    uint8_t result;   /**< a command_result_t, or a newer one */
    int length;       /**< bytes of the answer behind it */
    uint8_t answer[COMMAND_REPLY_BYTES];

    isotp_t link; /**< the module's own from here on */
    bool coded;   /**< the request is sent; else, with auth, `nonce` is */
    int64_t heard_us;
} board_talk_t;

/** Begin anew: of each, node, request and auth stay. Each node once. */
void board_talk_begin(board_talk_t *talk, int count);

/**
 * Ask the next board that is due. Call it once a turn, every millisecond or so: many requests at once would fill the
 * queue of an interface.
 *
 * @param now_us  Of any steady clock, as below.
 */
void board_talk_ask(board_talk_t *talk, int count, int64_t quiet_us, int64_t now_us);

/** @return Is there a frame to be sent now? Call it until there is none, each turn. */
bool board_talk_next(board_talk_t *talk, int count, hal_can_frame_t *frame, int64_t now_us);

/** Hear a frame from the bus. */
void board_talk_hear(board_talk_t *talk, int count, const hal_can_frame_t *frame, int64_t now_us);

/** @return Have all replied, or been given up? */
bool board_talk_settled(const board_talk_t *talk, int count, int64_t quiet_us, int64_t now_us);

/**
 * Send requests and wait for the replies, until all are here or given up.
 *
 * A board that is silent for so long is asked again: the whole request, BOARD_TALK_TRIES times in all. None does more
 * when it is heard twice. A board that waits for a lost frame of ours is silent for up to ISOTP_TIMEOUT_US.
 *
 * With auth a board is asked for a number first. A code that is refused counts as silence: another may have asked for
 * a number meanwhile.
 *
 * @param         bus       Listening.
 * @param[in,out] talk      node, request and auth are read, the rest is written. Each node once.
 * @param         quiet_us  How long a board may be silent; ISOTP_TIMEOUT_US in all its tries, or more.
 * @param         stop      Ends it when it becomes non-zero.
 * @param[out]    error     On failure: one line without newline.
 * @return false when the link has failed. Boards that did not reply are no failure.
 */
bool board_talk(pose_link_t *bus, board_talk_t *talk, int count, int64_t quiet_us, const volatile sig_atomic_t *stop,
                char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
