// SPDX-License-Identifier: Apache-2.0
// Gives bus time from this machine's monotonic clock.
#include "sim/pose/sync_send.h"

#include <assert.h>

#include "firmware/bus_master.h"
#include "sim/devices/sim_clock.h"

bool sync_send_begin(sync_send_t *sync, pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH])
{
    *sync = (sync_send_t){.due_us = sim_clock_monotonic_us(), .auth = sync->auth};
    return pose_link_time(link, CAN_ID_SYNC, error);
}

bool sync_send(sync_send_t *sync, pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int64_t now_us = sim_clock_monotonic_us();
    hal_can_frame_t frame[3]; /* Sync, FollowUp, code */
    int64_t time_us;
    if (now_us < sync->due_us)
        return true;
    const can_sync_t first = {.number = BUS_MASTER_TRACKER, .counter = sync->counter, .origin = BUS_MASTER_TRACKER};
    bool encoded = can_sync_encode(&frame[0], &first);
    assert(encoded);
    if (!pose_link_send_timed(link, &frame[0], &time_us, error))
        return false;
    sync->due_us = now_us + CAN_SYNC_PERIOD_MS * 1000;
    sync->counter = (uint8_t)((sync->counter + 1) % CAN_E2E_P01_COUNTERS);
    if (time_us < 0)
        return true;
    const can_follow_up_t second = {
        .number = BUS_MASTER_TRACKER, .counter = first.counter, .time_us = (uint64_t)time_us};
    encoded = can_follow_up_encode(&frame[1], &second); /* 2^48 us after the machine's start it would not be */
    assert(encoded);
    const bool coded =
        sync->auth != NULL && pose_auth_sign_time(sync->auth, frame, (uint64_t)sim_clock_monotonic_us(), &frame[2]);
    return pose_link_send(link, &frame[1], coded ? 2 : 1, error);
}
