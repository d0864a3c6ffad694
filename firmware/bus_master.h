// SPDX-License-Identifier: Apache-2.0
// Who gives bus time: one node's part in it, by the messages Sync and FollowUp.
//
// A node's number is its rank: 0 is a tracker's, which gives bus time whenever it is there; a board's is its node, and
// a board gives bus time only when nobody has for BUS_MASTER_SILENT_US and BUS_MASTER_STEP_US times its number, so that
// the lowest one does it and no two begin together. First it claims: for BUS_MASTER_CLAIM_US it sends Sync alone, and
// gives way to any whole pair and to any lower number. So a board that had lost the bus, and took the others for
// silent, comes back without disturbing them. Then it is master, and goes on with the bus time that it knew, without a
// step; when it never knew any, its own clock is bus time. Of two masters the one with the lower number stays and the
// other follows it. A master is not replaced by a better board that comes later, as long as it sends.
//
// A follower changes to a better master, or to any when its own is silent, with that one's first whole pair. When the
// new clock agrees within BUS_TIME_STEP_US the line goes on; else it is found anew after BUS_TIME_STEP_PAIRS pairs: the
// board says CAN_TIME_NONE meanwhile, and counts a relock. A bus time that is in use never jumps in silence.
//
// Integers only, no pointers inside, constant time, no waiting.
#ifndef FIRMWARE_BUS_MASTER_H
#define FIRMWARE_BUS_MASTER_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/bus_time.h"
#include "firmware/can_protocol.h"
#include "hal/hal_can.h"

enum {
    BUS_MASTER_TRACKER = 0, /**< the number of a tracker */
    BUS_MASTER_SILENT_US =
        500000,                 /**< a master that is not heard for so long, or whose Sync does not get out, is none */
    BUS_MASTER_STEP_US = 50000, /**< more than a refresh at 24 Hz: by then the one before has been heard */
    BUS_MASTER_CLAIM_US = 300000, /**< two Syncs of a master and more; a tracker does not claim */
    BUS_MASTER_PAIR_US = 100000   /**< a FollowUp later than this after its Sync is not taken */
};

/** A Sync whose FollowUp has not come yet. */
typedef struct {
    bool any;
    uint8_t number, counter, origin;
    int64_t local_us; /**< its stamp */
} bus_sync_t;

typedef struct {
    uint8_t number;      /**< of this node */
    bool claiming;       /**< it is about to be the master */
    bool own;            /**< it is the master */
    bool following;      /**< `master` is another, which it follows, maybe silent */
    uint8_t master;      /**< whom it follows or followed last, or itself */
    uint8_t origin;      /**< on whose clock this bus time began */
    bus_time_t time;     /**< bus time, over the clock that stamps the frames */
    uint32_t changes;    /**< of the master, after the first one */
    uint32_t lost;       /**< pairs of the master that did not come whole, since start */
    uint32_t mismatched; /**< FollowUps without their Sync, or too late, since start */
    uint32_t unsent;     /**< Syncs and FollowUps that the controller did not take, since start */

    bool any;          /**< the module's own from here on: there has been a master */
    int64_t heard_us;  /**< the newest Sync of another node, or when it began to wait */
    int64_t paired_us; /**< the newest pair of the followed master */
    uint8_t counted;   /**< counter of the newest Sync of the followed master */
    int64_t counted_us;
    bus_sync_t pending[2]; /**< of the followed master, and of another */
    uint8_t counter;       /**< of its own next Sync */
    int64_t due_us;
    bool on_its_way; /**< a Sync of its own has been queued; sent.local_us is not known yet */
    bool sent_any;   /**< its last bit was sent at sent.local_us: the FollowUp is due */
    bus_sync_t sent;
    int64_t sent_us;         /**< the newest Sync that got out, or when it began to claim */
    bool paired;             /**< a FollowUp was sent in the newest step: */
    hal_can_frame_t pair[2]; /**< its Sync, and it; what bus_auth_sign() signs */
    bool claimed;            /**< a Sync has got out since then: */
    int64_t claimed_us;      /**< the first */
} bus_master_t;

/**
 * Begin to listen.
 *
 * @param number  0 to CAN_MAX_NODE.
 * @param now_us  On the clock that stamps the frames, as all times here: hal_time's.
 */
void bus_master_init(bus_master_t *master, uint8_t number, int64_t now_us);

/**
 * Take a received frame, or one of its own that hal_can_receive() hands back.
 *
 * @return CAN_CHECK_OTHER when it is neither Sync nor FollowUp; CAN_CHECK_OK; or what is wrong with it: it is ignored.
 */
can_check_t bus_master_hear(bus_master_t *master, const hal_can_frame_t *frame);

/** Send what is due, and take over or give up. Call it after bus_master_hear() has had all frames, at 24 Hz or oftener;
 *  the frames are marked to be handed back. */
void bus_master_step(bus_master_t *master, hal_can_t *can, int64_t now_us);

can_time_state_t bus_master_state(const bus_master_t *master, int64_t now_us);

/** @return Whether bus time is right within BUS_TIME_STEP_US, by its own estimate: enough to compare times of other
 *          nodes with, if not locked. */
bool bus_master_knows(const bus_master_t *master, int64_t now_us);

/** @return As bus_time_error_us(); 0 for the master itself. */
uint32_t bus_master_error_us(const bus_master_t *master, int64_t now_us);

#endif
