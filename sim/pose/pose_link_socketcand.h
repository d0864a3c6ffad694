// SPDX-License-Identifier: Apache-2.0
// The TCP half of a pose link: a client of the socketcand protocol in raw mode.
#ifndef SIM_POSE_POSE_LINK_SOCKETCAND_H
#define SIM_POSE_POSE_LINK_SOCKETCAND_H

#include "sim/pose/pose_link.h"

/**
 * Is it HOST:PORT or [HOST]:PORT, with a port from 1 to 65535?
 *
 * @param[out] error  Written only on failure.
 */
bool pose_link_socketcand_check(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Connect to HOST:PORT, open can0, go to raw mode.
 *
 * @param[out] error  Written only on failure.
 * @return The socket, or -1.
 */
int pose_link_socketcand_open(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH]);

/** As pose_link_send(), in one piece of text. What the server has sent is thrown away unless the link listens. */
bool pose_link_socketcand_send(pose_link_t *link, const hal_can_frame_t *frame, int count,
                               char error[POSE_LINK_MESSAGE_LENGTH]);

/** As pose_link_receive(). Words of the server that are no frame are left out. */
pose_link_heard_t pose_link_socketcand_receive(pose_link_t *link, hal_can_frame_t *frame, int wait_ms,
                                               char error[POSE_LINK_MESSAGE_LENGTH]);

/** Wait until the server has read everything, for two seconds at most. */
void pose_link_socketcand_finish(pose_link_t *link);

#endif
