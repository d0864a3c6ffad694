// SPDX-License-Identifier: Apache-2.0
// The last second of one viewer's poses with the times they were captured at, oldest first.
#include "firmware/pose_history.h"

#include <stddef.h>

#include "firmware/quaternion.h"

/* Could nobody get from one to the other in this time (at most POSE_HISTORY_SILENCE_US)? */
static bool is_jump(const pose_t *from, const pose_t *to, int64_t time_us)
{
    const int64_t farthest_nm = POSE_HISTORY_STEP_NM + POSE_HISTORY_SPEED_NM_US * time_us;
    const int64_t farthest_q30 = POSE_HISTORY_TURN_Q30 + POSE_HISTORY_TURN_Q30_US * time_us;
    int64_t turn_q30[3];
    quaternion_between(turn_q30, from->quaternion_q30, to->quaternion_q30);
    for (int i = 0; i < 3; i++) {
        const int64_t step_nm = to->eye_nm[i] - from->eye_nm[i];
        if (step_nm > farthest_nm || step_nm < -farthest_nm || turn_q30[i] > farthest_q30 ||
            turn_q30[i] < -farthest_q30)
            return true;
    }
    return false;
}

pose_history_added_t pose_history_add(pose_history_t *history, const can_pose_t *pose, int64_t time_us)
{
    pose_at_t added = {.time_us = time_us,
                       .pose = pose->pose,
                       .counter = pose->counter,
                       .measured = pose->quality == CAN_POSE_TRACKED,
                       .begins_run = true};
    if (pose->quality == CAN_POSE_LOST || !quaternion_normalise(added.pose.quaternion_q30, pose->pose.quaternion_q30))
        return POSE_HISTORY_IGNORED;

    pose_history_added_t result = POSE_HISTORY_NEW_RUN;
    const pose_at_t *newest = pose_history_back(history, 0);
    if (newest != NULL) {
        const int64_t later_us = time_us - newest->time_us;
        if (later_us <= -POSE_HISTORY_SILENCE_US) {
            history->count = 0;
            result = POSE_HISTORY_NEW_CLOCK;
        } else if (later_us <= 0) {
            return POSE_HISTORY_IGNORED;
        } else if (later_us <= POSE_HISTORY_SILENCE_US && !is_jump(&newest->pose, &added.pose, later_us)) {
            added.begins_run = false;
            result = POSE_HISTORY_ADDED;
        }
    }
    history->newest = (history->newest + 1) % POSE_HISTORY_POSES;
    history->pose[history->newest] = added;
    history->count += history->count < POSE_HISTORY_POSES;
    return result;
}

const pose_at_t *pose_history_back(const pose_history_t *history, int32_t back)
{
    if (back >= history->count)
        return NULL;
    return &history->pose[(history->newest - back + POSE_HISTORY_POSES) % POSE_HISTORY_POSES];
}

static bool follows(const pose_at_t *newer, const pose_at_t *older, int counters)
{
    return newer->counter == (older->counter + 1) % counters;
}

bool pose_history_until(pose_history_t *history, int64_t limit_us, int counters)
{
    const pose_at_t *after = NULL;
    for (; history->count > 0 && pose_history_back(history, 0)->time_us > limit_us; history->count--) {
        after = pose_history_back(history, 0);
        history->newest = (history->newest + POSE_HISTORY_POSES - 1) % POSE_HISTORY_POSES;
    }
    const pose_at_t *newest = pose_history_back(history, 0), *before = pose_history_back(history, 1);
    if (newest == NULL)
        return false;
    if (after != NULL)
        return follows(after, newest, counters);
    return before != NULL && follows(newest, before, counters) &&
           limit_us - newest->time_us < (newest->time_us - before->time_us) / 4 * 3;
}
