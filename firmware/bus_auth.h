// SPDX-License-Identifier: Apache-2.0
// A board's part in authentication (can_auth.h): which frames it may believe, which commands, and what it signs itself.
//
// Signed are poses, Sync with its FollowUp, FrameClock, Latency, and all commands but `nonce`. What boards report of
// themselves besides is not: nothing is shown by it. A Sync without FollowUp, by which a board claims to become master,
// is not either: it is not heard then, and of boards that begin together the lowest one stays.
//
// A board without a session believes nobody and signs nothing, but says in its heartbeat that it wants one; so it does
// when no tracker of its session is heard. Whoever has the key tells it, by the commands `nonce` and `session`.
//
// No pointers inside but to the key; integers only, no heap, constant time.
#ifndef FIRMWARE_BUS_AUTH_H
#define FIRMWARE_BUS_AUTH_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/auth_clock.h"
#include "firmware/bus_master.h"
#include "firmware/can_auth.h"
#include "firmware/frame_clock.h"
#include "firmware/pose_from_can.h"
#include "hal/hal_can.h"

enum {
    BUS_AUTH_NONCE_US = 2000000,  /**< a number for a command is good for so long */
    BUS_AUTH_SILENT_US = 2000000, /**< without the session's tracker for so long: a session is wanted */
    BUS_AUTH_CODE_US = 20000, /**< a code comes so soon after its message has begun: before FrameClock is due again */
    BUS_AUTH_MOST_UNCODED = 3 /**< messages one after the other whose codes may be lost; more never had one */
};

/** Frames of a message whose code has not come yet. */
typedef struct {
    hal_can_frame_t frame[CAN_AUTH_MAX_FRAMES];
    int frames;
    bool whole;     /**< the code is due */
    int uncoded;    /**< whole messages since the newest that was believed, whose codes never came; */
    uint8_t newest; /**< that one's counter */
    int torn;       /**< codes since then whose message did not come whole: they explain a gap in the counter */
} bus_auth_message_t;

/** All zero bytes: the room has no key, every frame is believed, nothing is signed. */
typedef struct {
    can_auth_t *key; /**< the room's; NULL: it has none */
    uint8_t viewer;  /**< whose poses matter */
    bool has_session;
    uint64_t session;
    auth_clock_t clock;
    int64_t tracker_us; /**< newest authentic message of a tracker, on the board's clock */

    uint64_t seed, nonces; /**< the module's own from here on: of the random numbers, and how many were given */
    uint64_t nonce;
    bool nonce_given;
    int64_t nonce_us;
    can_auth_stream_t fd, set, time[CAN_MAX_NODE + 1], frame_clock[CAN_MAX_NODE + 1], latency[CAN_MAX_NODE + 1];
    bus_auth_message_t set_parts, pair[CAN_MAX_NODE + 1], epochs[CAN_MAX_NODE + 1], latencies[CAN_MAX_NODE + 1];
    can_auth_fresh_t own_time, own_clock, own_latency;
} bus_auth_t;

/**
 * Begin without a session.
 *
 * @param key     Must outlive this; NULL: no key.
 * @param viewer  Whose poses the board follows.
 * @param seed    Random, another one at every start: numbers for commands come from it and the key.
 */
void bus_auth_init(bus_auth_t *auth, can_auth_t *key, uint8_t viewer, uint64_t seed);

/**
 * Take a frame from the bus.
 *
 * @param[out]    believed  Frames that may be believed from now on, in their order, with their own stamps: those of a
 *                          message whose code has come, an FD pose without its code, or a frame that needs none.
 * @param[in,out] faults    What is refused is counted.
 * @return How many; 0 for one that is refused, or waits for its code.
 */
int bus_auth_take(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t believed[CAN_AUTH_MAX_FRAMES],
                  can_faults_t *faults);

/** @return May the board speak to others: give bus time, say what latency it needs? Without a session nobody would
 *  believe it. */
bool bus_auth_may_speak(const bus_auth_t *auth);

/** Sign what master and leader have sent in this step, if anything. Call it after their steps. */
void bus_auth_sign(bus_auth_t *auth, bus_master_t *master, frame_clock_t *clock, hal_can_t *can, int64_t now_us);

/** Sign the board's own Latency, which was just sent. @return false when the code is not on its way; true without a key
 *  or session. */
bool bus_auth_sign_latency(bus_auth_t *auth, const bus_time_t *time, const hal_can_frame_t *latency, hal_can_t *can,
                           int64_t now_us);

/** @return A new number for one command; the one before is void. There must be a key. */
uint64_t bus_auth_give_nonce(bus_auth_t *auth, int64_t now_us);

/**
 * Check the code behind a command. The number that was given is used up.
 *
 * @param id  Of the link that it came on.
 * @return Bytes of the command without its code; 0: refused.
 */
int bus_auth_check_command(bus_auth_t *auth, uint32_t id, const uint8_t *command, int length, int64_t now_us);

/** Believe another session from now on, or the same one again, whose messages that were taken stay old. */
void bus_auth_begin_session(bus_auth_t *auth, uint64_t session, uint64_t bus_us, int64_t now_us);

/** @return There is a key, and no session, or nobody who keeps it up. */
bool bus_auth_wants_session(const bus_auth_t *auth, int64_t now_us);

#endif
