// SPDX-License-Identifier: Apache-2.0
// Hears a tracker over UDP and sends its poses onto a bus.
#ifndef SIM_POSE_BRIDGE_RUN_H
#define SIM_POSE_BRIDGE_RUN_H

#include <signal.h>

#include "sim/pose/bridge.h"
#include "sim/pose/pose_auth.h"
#include "sim/pose/pose_link.h"

typedef struct {
    bridge_t *bridge;
    pose_link_t *link;
    int listener;                      /**< of udp_listen_open() */
    bool fd;                           /**< one CAN FD frame a pose, else a set of three classic frames */
    bool sync;                         /**< give bus time, so that boards can use the capture times */
    pose_auth_t *auth;                 /**< signs; sync is then true. NULL: no key */
    bool show_progress;                /**< write a line about it to stderr every second */
    int64_t duration_us;               /**< ends after that; 0 for never */
    const volatile sig_atomic_t *stop; /**< ends when it becomes non-zero; looked at every 100 ms */
    uint64_t sent;                     /**< poses; counted by bridge_run() */
} bridge_run_t;

/**
 * Go on until the stop or the end. Each packet's poses go out as soon as it has come. Those that the messages cannot
 * say are counted in bridge->counts.too_far.
 *
 * @param[out] error  On failure: one line without newline.
 * @return false when the link or the socket has failed.
 */
bool bridge_run(bridge_run_t *run, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
