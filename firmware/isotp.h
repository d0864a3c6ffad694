// SPDX-License-Identifier: Apache-2.0
// Messages of up to 512 bytes over classic CAN frames: ISO 15765-2 (ISO-TP), normal addressing, frames padded to 8
// bytes.
#ifndef FIRMWARE_ISOTP_H
#define FIRMWARE_ISOTP_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"

enum {
    ISOTP_MAX_LENGTH = 512,     /**< of a message; longer ones are refused with the flow status "overflow" */
    ISOTP_TIMEOUT_US = 1000000, /**< N_Bs and N_Cr: the other end must go on within this time */
    ISOTP_MOST_WAITS = 10,      /**< flow controls "wait" in a row before a message is given up */
    ISOTP_GAP_MS = 5            /**< STmin that we ask for: a message then leaves most of the bus to poses */
};

/** What went wrong, counted since the start. A message it happened to is given up. */
typedef struct {
    uint32_t sequence; /**< a frame of the message was missing, or none was expected */
    uint32_t timeout;  /**< the other end did not go on */
    uint32_t overflow; /**< too long, here or there */
    uint32_t busy;     /**< a message came while the last one was not taken yet: ignored */
    uint32_t invalid;  /**< frames that are not of ISO 15765-2 */
} isotp_faults_t;

/** One direction of a link. The link's own. */
typedef struct {
    uint8_t data[ISOTP_MAX_LENGTH];
    int length, done; /**< bytes of the message; of them received or sent */
    bool active;      /**< under way */
    uint8_t sequence; /**< of the next consecutive frame */
    int64_t due_us;   /**< of the next frame, or by when the other end must go on */
} isotp_message_t;

/** A link of two ends, each of which may send at any time. No pointers inside. */
typedef struct {
    uint32_t receive_id, send_id; /**< 11 bits */
    isotp_faults_t faults;

    isotp_message_t in, out; /**< the link's own from here on */
    bool whole;              /**< in is a whole message, not taken yet */
    uint8_t answer;          /**< flow control to be sent, 0: none */
    bool waiting;            /**< out waits for a flow control */
    int waits, block;        /**< "wait"s in a row; frames left before the next flow control, -1: no end */
    int64_t gap_us;          /**< STmin of the other end */
} isotp_t;

/** @return All of them. */
uint32_t isotp_faults_total(const isotp_faults_t *faults);

/** Begin with nothing under way. */
void isotp_init(isotp_t *link, uint32_t receive_id, uint32_t send_id);

/** Take a frame from the bus. @return Was it this link's? */
bool isotp_take(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us);

/**
 * Begin to send a message.
 *
 * @param length  1 to ISOTP_MAX_LENGTH.
 * @return false, and nothing is sent, when the length is not right or a message is still under way.
 */
bool isotp_send(isotp_t *link, const uint8_t *data, int length, int64_t now_us);

/** @return Is a message of ours still under way? */
bool isotp_sending(const isotp_t *link);

/**
 * The next frame for the bus whose time has come. Call it until it has none, each time that the bus is looked at; it
 * also ends what has waited too long.
 *
 * @param[out] frame  Written only when true is returned. One that cannot be queued is lost, and its message with it.
 */
bool isotp_next(isotp_t *link, hal_can_frame_t *frame, int64_t now_us);

/**
 * The message that has come.
 *
 * @param[out] data  Valid until isotp_taken(). Written only when there is one.
 * @return Its length, 0: none.
 */
int isotp_received(const isotp_t *link, const uint8_t **data);

/** The message is not needed any more: the next one may come. */
void isotp_taken(isotp_t *link);

#endif
