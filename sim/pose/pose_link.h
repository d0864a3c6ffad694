// SPDX-License-Identifier: Apache-2.0
// A sender's way onto a CAN bus: a SocketCAN interface, or a simulator's socketcand port.
#ifndef SIM_POSE_POSE_LINK_H
#define SIM_POSE_POSE_LINK_H

#include <stdbool.h>

#include "hal/hal_can.h"

enum { POSE_LINK_MESSAGE_LENGTH = 256 };

typedef struct {
    int socket;      /**< an open one */
    bool socketcand; /**< TCP with the socketcand protocol; else SocketCAN */
    char name[64];   /**< the bus, for messages */
} pose_link_t;

/**
 * Can this text name a bus? Nothing is looked up or opened.
 *
 * @param[out] error  On failure: one line without newline, what was expected.
 */
bool pose_link_check(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Connect. A name with a colon is HOST:PORT (IPv6: [HOST]:PORT) of a socketcand server, whose bus is called can0;
 * a port where nobody listens yet is tried again for 5 s. Any other name is a SocketCAN interface.
 *
 * @param[out] link   Written only when true is returned; close it with pose_link_close().
 * @param      fd     CAN FD frames will be sent: refused with HOST:PORT and on an interface without FD.
 * @param[out] error  On failure: one line without newline, what failed and what to do.
 */
bool pose_link_open(pose_link_t *link, const char *bus, bool fd, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Send frames in their order. Waits while the way is congested, up to a second.
 *
 * @param frame  1 to 8 frames; not FD unless opened for it.
 * @return false when the link has failed; some of the frames may have been sent.
 */
bool pose_link_send(pose_link_t *link, const hal_can_frame_t *frame, int count, char error[POSE_LINK_MESSAGE_LENGTH]);

/** Send what is still under way, and disconnect. */
void pose_link_close(pose_link_t *link);

#endif
