// SPDX-License-Identifier: Apache-2.0
// A tracker's part in authentication.
#include "sim/pose/pose_auth.h"

#include <stdio.h>
#include <stdlib.h>

#include "firmware/auth_key.h"
#include "hal/hal_random.h"
#include "sim/devices/sim_clock.h"

void pose_auth_init(pose_auth_t *tracker, can_auth_t *auth, uint64_t session, uint64_t bus_us)
{
    const can_auth_fresh_t fresh = {session, bus_us};
    tracker->auth = auth;
    tracker->time = fresh;
    for (int v = 0; v < CAN_VIEWERS; v++)
        tracker->pose[v] = fresh;
    session_teller_init(&tracker->teller, auth, session);
}

/* @return Is all open? */
static bool open_all(pose_auth_t *tracker, const char *key_file, const char *bus, char error[HAL_KEY_ERROR_LENGTH])
{
    uint64_t session = 0;
    if (hal_random(&session) != HAL_OK) {
        snprintf(error, HAL_KEY_ERROR_LENGTH, "no random numbers from the system");
        return false;
    }
    can_auth_t *auth = auth_key_open(key_file, error);
    if (auth == NULL)
        return false;
    if (pose_link_open(&tracker->link, bus, false, error)) {
        if (pose_link_listen(&tracker->link, error)) {
            pose_auth_init(tracker, auth, session, (uint64_t)sim_clock_monotonic_us());
            return true;
        }
        pose_link_close(&tracker->link);
    }
    can_auth_close(auth);
    return false;
}

_Static_assert((int)HAL_KEY_ERROR_LENGTH >= (int)POSE_LINK_MESSAGE_LENGTH, "a link's message fits too");

pose_auth_t *pose_auth_open(const char *key_file, const char *bus, char error[HAL_KEY_ERROR_LENGTH])
{
    pose_auth_t *tracker = malloc(sizeof *tracker);
    if (tracker == NULL) {
        snprintf(error, HAL_KEY_ERROR_LENGTH, "out of memory");
        return NULL;
    }
    if (open_all(tracker, key_file, bus, error))
        return tracker;
    free(tracker);
    return NULL;
}

void pose_auth_close(pose_auth_t *tracker)
{
    if (tracker == NULL)
        return;
    pose_link_close(&tracker->link);
    can_auth_close(tracker->auth);
    free(tracker);
}

int pose_auth_sign_pose(pose_auth_t *tracker, hal_can_frame_t frame[POSE_AUTH_FRAMES], int frames, uint8_t viewer,
                        uint64_t bus_us)
{
    if (tracker == NULL || frames == 0)
        return frames;
    can_auth_fresh_t *fresh = &tracker->pose[viewer];
    can_auth_fresh_step(fresh, bus_us);
    if (frame[0].fd) {
        const bool coded = can_auth_sign_fd(tracker->auth, *fresh, frame);
        frame[0].id = CAN_AUTH_ID_POSE_FD + (uint32_t)viewer;
        return coded ? 1 : 0;
    }
    const can_auth_message_t set = {frame, frames, CAN_AUTH_ID_POSE_SET + 4 * (uint32_t)viewer};
    return can_auth_sign(tracker->auth, *fresh, &set, &frame[frames]) ? frames + 1 : 0;
}

bool pose_auth_sign_time(pose_auth_t *tracker, const hal_can_frame_t pair[2], uint64_t bus_us, hal_can_frame_t *tag)
{
    const can_auth_message_t message = {pair, 2, CAN_AUTH_ID_TIME};
    can_auth_fresh_step(&tracker->time, bus_us);
    return can_auth_sign(tracker->auth, tracker->time, &message, tag);
}

bool pose_auth_turn(pose_auth_t *tracker, char error[POSE_LINK_MESSAGE_LENGTH])
{
    pose_link_t *link = &tracker->link;
    hal_can_frame_t frame;
    pose_link_heard_t heard = pose_link_receive(link, &frame, 0, error);
    const int64_t now_us = sim_clock_monotonic_us();
    for (; heard == POSE_LINK_FRAME || heard == POSE_LINK_ERROR; heard = pose_link_receive(link, &frame, 0, error)) {
        if (heard == POSE_LINK_FRAME)
            session_teller_hear(&tracker->teller, &frame, now_us, (uint64_t)now_us);
        if (sim_clock_monotonic_us() - now_us > POSE_AUTH_TURN_US)
            break; /* a flood must not keep poses from being sent */
    }
    if (heard == POSE_LINK_ENDED)
        return false;
    while (session_teller_next(&tracker->teller, &frame, now_us))
        if (!pose_link_send(link, &frame, 1, error))
            return false;
    return true;
}
