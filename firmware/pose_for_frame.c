// SPDX-License-Identifier: Apache-2.0
// Pose history and a picture's times -> the pose and the camera that the picture is mapped with.
#include "firmware/pose_for_frame.h"

#include <stddef.h>

#include "firmware/quaternion.h"
#include "warp_fixed/camera_for_content.h"
#include "warp_fixed/fixed.h"

/* The pose between two that follow one another in a run. */
static void interpolate(pose_at_t *between, const pose_at_t *older, const pose_at_t *newer, int64_t time_us)
{
    /* At most 0.2 s and so 2.02 * 10^9 nm apart: products stay below 2^61. */
    const int64_t part_q30 = ((time_us - older->time_us) << 30) / (newer->time_us - older->time_us);
    *between = *older;
    between->time_us = time_us;
    for (int i = 0; i < 3; i++)
        between->pose.eye_nm[i] += round_shift((newer->pose.eye_nm[i] - older->pose.eye_nm[i]) * part_q30, 30);
    quaternion_slerp(between->pose.quaternion_q30, older->pose.quaternion_q30, newer->pose.quaternion_q30,
                     (int32_t)part_q30);
}

/* The pose at a time: between its neighbours, or the older one where a run ends. @return false before the oldest. */
static bool drawn_at(pose_at_t *drawn, const pose_history_t *history, int64_t time_us)
{
    const pose_at_t *newer = pose_history_back(history, 0);
    *drawn = *newer;
    for (int32_t back = 1; newer->time_us > time_us; back++) {
        const pose_at_t *older = pose_history_back(history, back);
        if (older == NULL)
            return false;
        *drawn = *older;
        if (older->time_us <= time_us && !newer->begins_run)
            interpolate(drawn, older, newer, time_us);
        newer = older;
    }
    return true;
}

/* The newest pose that was captured when the tag says. @return false if none was. */
static bool drawn_with_tag(pose_at_t *drawn, const pose_history_t *history, const pose_for_frame_picture_t *picture)
{
    for (int32_t back = 0; back < history->count; back++) {
        const pose_at_t *pose = pose_history_back(history, back);
        if (frame_tag_is_of(&picture->tag, picture->tag.viewer, (uint64_t)pose->time_us, picture->wrap_us)) {
            *drawn = *pose;
            return true;
        }
    }
    return false;
}

static bool find_drawn(pose_at_t *drawn, const pose_history_t *history, const pose_for_frame_rule_t *rule,
                       const pose_for_frame_picture_t *picture)
{
    if (rule->mode == POSE_FOR_FRAME_LATEST) {
        *drawn = *pose_history_back(history, 0);
        return true;
    }
    const int64_t time_us = picture->picture_us - rule->render_us;
    if (rule->mode == POSE_FOR_FRAME_TAG && picture->tagged && drawn_with_tag(drawn, history, picture))
        return true;
    return drawn_at(drawn, history, time_us) && rule->mode == POSE_FOR_FRAME_DELAY;
}

bool pose_for_frame(pose_for_frame_t *chosen, const pose_history_t *history, const camera_t *camera,
                    const pose_for_frame_rule_t *rule, const pose_for_frame_picture_t *picture)
{
    if (history->count == 0)
        return false;
    pose_t eye;
    chosen->drawn_known = find_drawn(&chosen->drawn, history, rule, picture);
    (void)pose_predict(history, picture->shown_us, &eye); /* not none: the history has poses */
    chosen->camera = *camera;
    chosen->pose = chosen->drawn.pose;
    if (rule->content == POSE_FOR_FRAME_WALL ||
        (rule->content == POSE_FOR_FRAME_DEPTH &&
         !camera_for_content(&chosen->camera, camera, &chosen->drawn.pose, eye.eye_nm, rule->depth_um)))
        return true;
    for (int i = 0; i < 3; i++)
        chosen->pose.eye_nm[i] = eye.eye_nm[i];
    return true;
}
