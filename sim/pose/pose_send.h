// SPDX-License-Identifier: Apache-2.0
// Sends a pose list onto a bus at its own pace.
#ifndef SIM_POSE_POSE_SEND_H
#define SIM_POSE_POSE_SEND_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "sim/pose/pose_auth.h"
#include "sim/pose/pose_link.h"
#include "sim/pose/pose_list.h"

/** What is sent, and how. */
typedef struct {
    const pose_list_t *list;           /**< passed by pose_send_check() */
    bool fd;                           /**< one CAN FD frame a pose, else a set of three classic frames */
    uint8_t viewer;                    /**< 0 to CAN_VIEWERS - 1 */
    uint8_t tracker;                   /**< 0 to 15; only the FD frame carries it */
    bool show_progress;                /**< write a line about it to stderr now and then */
    const volatile sig_atomic_t *stop; /**< when it becomes non-zero, no further pose is sent; looked at every 100 ms */
    bool sync;                         /**< give bus time, so that boards can use the capture times */
    pose_auth_t *auth;                 /**< signs; sync is then true. NULL: no key */
} pose_send_t;

/**
 * Does every pose fit the messages?
 *
 * @param[out] error  On failure: which one does not, counted from 1, and what to do.
 */
bool pose_send_check(const pose_send_t *send, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Send the list once, in real time: the first pose at once, or with a key 1 s later, when boards know of it; each other
 * one as long after it as its time says. The capture time that goes out is the moment of sending on this machine's
 * monotonic clock, whose low bits also start the counter: a list sent twice is not taken for a repetition.
 *
 * @param[out] sent  Poses handed to the link: all of them, unless it failed or was stopped.
 * @return false when the link failed.
 */
bool pose_send_list(pose_link_t *link, const pose_send_t *send, size_t *sent, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
