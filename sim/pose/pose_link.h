// SPDX-License-Identifier: Apache-2.0
// A program's way onto a CAN bus: a SocketCAN interface, or a simulator's socketcand port.
#ifndef SIM_POSE_POSE_LINK_H
#define SIM_POSE_POSE_LINK_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/hal_can.h"

enum {
    POSE_LINK_MESSAGE_LENGTH = 256,
    POSE_LINK_INPUT_BYTES = 8192,
    POSE_LINK_OUT_MS = 20 /**< a timed frame that has not won the bus by then has no time */
};

typedef struct {
    int socket;      /**< an open one */
    bool socketcand; /**< TCP with the socketcand protocol; else SocketCAN */
    bool listening;  /**< pose_link_listen() was called */
    bool timing;     /**< pose_link_time() was called, on SocketCAN */
    char name[64];   /**< the bus, for messages */
    size_t input_length;
    char input[POSE_LINK_INPUT_BYTES]; /**< socketcand: heard, but not a whole frame yet */
} pose_link_t;

/** What pose_link_receive() found. */
typedef enum {
    POSE_LINK_FRAME,
    POSE_LINK_QUIET, /**< nothing within the time */
    POSE_LINK_ERROR, /**< SocketCAN: the controller reports an error on the bus; time_us alone is set */
    POSE_LINK_ENDED  /**< the link has failed, or the simulation has come to its end */
} pose_link_heard_t;

/**
 * Can this text name a bus? Nothing is looked up or opened.
 *
 * @param[out] error  On failure: one line without newline, what was expected.
 */
bool pose_link_check(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Connect. A name with a colon is HOST:PORT (IPv6: [HOST]:PORT) of a socketcand server, whose bus is called can0;
 * a port where nobody listens yet is tried again for 5 s, and who listens has 20 s to answer. Any other name is a
 * SocketCAN interface.
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

/**
 * From now on pose_link_send_timed() tells when a frame of this identifier was on the bus. Of no effect with a server,
 * which does not say. Not for a link that listens.
 *
 * @return false when the interface refuses.
 */
bool pose_link_time(pose_link_t *link, uint32_t id, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Send one classic frame and tell when, on sim_clock_monotonic_us().
 *
 * @param[out] time_us  After pose_link_time() on an interface: the moment of its last bit on the bus, which is waited
 *                      for; -1 when that takes more than POSE_LINK_OUT_MS. Else the moment at which the link took it.
 * @return false when the link has failed.
 */
bool pose_link_send_timed(pose_link_t *link, const hal_can_frame_t *frame, int64_t *time_us,
                          char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Hear the bus from now on. Before this call nothing is kept. What the link itself sends is not heard.
 *
 * @return false when the interface refuses.
 */
bool pose_link_listen(pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Take the oldest frame heard, after pose_link_listen().
 *
 * @param[out] frame  Written for POSE_LINK_FRAME. Its time is the bus's: of the simulation, or the time of day at which
 *                    the kernel received it. Remote frames are left out.
 * @param wait_ms     How long to wait for one, 0 or more.
 * @param[out] error  For POSE_LINK_ENDED: one line without newline.
 */
pose_link_heard_t pose_link_receive(pose_link_t *link, hal_can_frame_t *frame, int wait_ms,
                                    char error[POSE_LINK_MESSAGE_LENGTH]);

/** Send what is still under way, and disconnect. */
void pose_link_close(pose_link_t *link);

#endif
