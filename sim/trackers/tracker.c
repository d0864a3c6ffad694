// SPDX-License-Identifier: Apache-2.0
// What every tracker protocol's decoder makes of a packet: poses, or the reason why not.
#include "sim/trackers/tracker.h"

#include <math.h>
#include <string.h>

static const double farthest = 1e9, length_tolerance = 0.01;
static const int64_t latest_us = INT64_C(1) << 60;

_Static_assert((int)TRACKER_MAX_POSES == 64, "said in a text");

const char *const tracker_check_text[TRACKER_CHECKS] = {
    "good",
    "other message",
    "part of a message",
    "wrong length",
    "wrong checksum",
    "unknown version or encoding",
    "malformed",
    "segment missing before it",
    "repeated or late",
    "value out of range",
    "without position or orientation",
    "beyond the first 64 bodies of a packet",
};

static bool position_is_sound(const double position[3])
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(position[i]) <= farthest))
            return false;
    return true;
}

/* Comparisons with NaN are false: it is refused too. */
static bool make_unit(double quaternion[4])
{
    double length = 0.0;
    for (int i = 0; i < 4; i++)
        length = hypot(length, quaternion[i]);
    if (!(fabs(length - 1.0) <= length_tolerance))
        return false;
    for (int i = 0; i < 4; i++)
        quaternion[i] /= length;
    return true;
}

void tracker_packet_add(tracker_packet_t *packet, const tracker_pose_t *pose)
{
    tracker_pose_t added = *pose;
    if (pose->quality == CAN_POSE_LOST) {
        memset(added.position, 0, sizeof added.position);
        memcpy(added.quaternion, (const double[4]){1.0, 0.0, 0.0, 0.0}, sizeof added.quaternion);
    }
    const bool time_is_sound = !pose->timed || (pose->time_us >= 0 && pose->time_us <= latest_us);
    if (!time_is_sound || !position_is_sound(added.position) || !make_unit(added.quaternion))
        packet->left_out[TRACKER_VALUE]++;
    else if (packet->count == TRACKER_MAX_POSES)
        packet->left_out[TRACKER_CROWDED]++;
    else
        packet->pose[packet->count++] = added;
}
