// SPDX-License-Identifier: Apache-2.0
// A tracker's part in authentication: signs its poses and its bus time, and tells boards its session.
//
// In a room with a key one tracker sends, and gives bus time: the boards believe one session.
#ifndef SIM_POSE_POSE_AUTH_H
#define SIM_POSE_POSE_AUTH_H

#include "firmware/can_auth.h"
#include "sim/pose/pose_link.h"
#include "sim/pose/session_teller.h"

enum {
    POSE_AUTH_FRAMES = CAN_POSE_PARTS + 1, /**< of a signed pose at most */
    POSE_AUTH_TURN_US = 5000               /**< how often it must have its turn */
};

/** 90 KB. */
typedef struct {
    can_auth_t *auth;
    pose_link_t link; /**< of pose_auth_open(): to talk with boards */
    can_auth_fresh_t pose[CAN_VIEWERS], time;
    session_teller_t teller;
} pose_auth_t;

/** Begin a session. @param session  Random. @param bus_us  Bus time now. */
void pose_auth_init(pose_auth_t *tracker, can_auth_t *auth, uint64_t session, uint64_t bus_us);

/**
 * pose_auth_init() with the key in a file, a session from the system, and a link of its own. Uses the heap.
 *
 * @param      bus    As pose_link_open() takes it.
 * @param[out] error  On failure: one line without newline.
 * @return NULL on failure; end it with pose_auth_close().
 */
pose_auth_t *pose_auth_open(const char *key_file, const char *bus, char error[HAL_KEY_ERROR_LENGTH]);

/** NULL is allowed. */
void pose_auth_close(pose_auth_t *tracker);

/**
 * Sign a pose.
 *
 * @param         tracker  NULL: no key, nothing is done.
 * @param[in,out] frame    The frames of the pose: an FD frame grows, a set has one more.
 * @return How many frames there are now; 0 when they cannot be signed.
 */
int pose_auth_sign_pose(pose_auth_t *tracker, hal_can_frame_t frame[POSE_AUTH_FRAMES], int frames, uint8_t viewer,
                        uint64_t bus_us);

/** Make the frame behind a tracker's Sync and FollowUp. @return false, and nothing is made, when that cannot be. */
bool pose_auth_sign_time(pose_auth_t *tracker, const hal_can_frame_t pair[2], uint64_t bus_us, hal_can_frame_t *tag);

/**
 * After pose_auth_open(): hear what is waiting on the bus, and send boards what they are to be told. Does not wait. Bus
 * time is this machine's monotonic clock.
 *
 * @return false when the link has failed.
 */
bool pose_auth_turn(pose_auth_t *tracker, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
