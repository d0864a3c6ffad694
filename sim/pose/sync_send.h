// SPDX-License-Identifier: Apache-2.0
// Gives bus time from this machine's monotonic clock: what a sender of poses does whose capture times boards shall use.
#ifndef SIM_POSE_SYNC_SEND_H
#define SIM_POSE_SYNC_SEND_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/pose/pose_auth.h"
#include "sim/pose/pose_link.h"

/** Made by sync_send_begin(), but for auth, which is its caller's. */
typedef struct {
    int64_t due_us; /**< of the next pair, on sim_clock_monotonic_us() */
    uint8_t counter;
    pose_auth_t *auth; /**< signs the pairs; NULL: nobody does */
} sync_send_t;

/** The first pair is due now; sync->auth stays. Calls pose_link_time(). @return false when the interface refuses. */
bool sync_send_begin(sync_send_t *sync, pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Send Sync and FollowUp, as a tracker, when they are due; CAN_SYNC_PERIOD_MS later they are again.
 *
 * FollowUp tells when the Sync was on the bus, as pose_link_send_timed() says; a Sync that has no time has no FollowUp.
 * With a server it is the moment at which the link took the Sync: earlier than its last bit by what it waited for the
 * bus and took on it, some 0.3 ms at 500 kbit/s.
 *
 * @return false when the link failed.
 */
bool sync_send(sync_send_t *sync, pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
