// SPDX-License-Identifier: Apache-2.0
// Sends a pose list onto a bus at its own pace.
#ifndef SIM_POSE_POSE_SEND_H
#define SIM_POSE_POSE_SEND_H

#include <stdbool.h>

#include "sim/pose/pose_link.h"
#include "sim/pose/pose_list.h"

/**
 * Does every pose fit the messages?
 *
 * @param[out] error  On failure: which one does not, counted from 1, and what to do.
 */
bool pose_send_check(const pose_list_t *list, bool fd, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Send the list once, in real time: the first pose at once, each other one as long after it as its time says. The
 * capture time that goes out is the moment of sending on this machine's monotonic clock, whose low bits also start
 * the counter: a list sent twice is not taken for a repetition.
 *
 * @param list           Passed by pose_send_check() with the same fd.
 * @param show_progress  Write a line about it to stderr now and then.
 * @return false when the link failed.
 */
bool pose_send_list(pose_link_t *link, const pose_list_t *list, bool fd, bool show_progress,
                    char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
