// SPDX-License-Identifier: Apache-2.0
// An OpenTrackIO 1.0.1 sample, as values -> pose.
#include "sim/trackers/opentrackio_sample.h"

#include <string.h>

#include "sim/trackers/tracker_rotation.h"

enum { VERSION_MAJOR = 1, LAST_SOURCE = 200, NS_PER_S = 1000000000, NS_PER_US = 1000, US_PER_S = 1000000 };

static const int64_t latest_s = INT64_C(1) << 40;

static bool is_our_protocol(const json_t *sample)
{
    const json_t *protocol = json_object_get(sample, "protocol");
    const char *name = json_string_value(json_object_get(protocol, "name"));
    const json_t *major = json_array_get(json_object_get(protocol, "version"), 0);
    return name != NULL && strcmp(name, "OpenTrackIO") == 0 && json_is_integer(major) &&
           json_integer_value(major) == VERSION_MAJOR;
}

static bool read_three(const json_t *object, const char *const key[3], double value[3])
{
    for (int i = 0; i < 3; i++) {
        const json_t *number = json_object_get(object, key[i]);
        if (!json_is_number(number))
            return false;
        value[i] = json_number_value(number);
    }
    return true;
}

/* Without a scale there is nothing to read. */
static bool read_scale(const json_t *transform, bool *scaled)
{
    static const char *const key[3] = {"x", "y", "z"};
    const json_t *scale = json_object_get(transform, "scale");
    double value[3];
    if (scale == NULL)
        return true;
    if (!read_three(scale, key, value))
        return false;
    /* written as decimals: a 1 is exact */
    *scaled |= !(value[0] >= 1.0 && value[0] <= 1.0 && value[1] >= 1.0 && value[1] <= 1.0 && value[2] >= 1.0 &&
                 value[2] <= 1.0);
    return true;
}

static bool read_transforms(const json_t *transforms, tracker_pose_t *pose, bool *scaled)
{
    static const char *const place[3] = {"x", "y", "z"}, *const angle[3] = {"pan", "tilt", "roll"};
    size_t i;
    const json_t *transform;
    json_array_foreach(transforms, i, transform)
    {
        double translation[3], degrees[3], turn[4];
        if (!read_three(json_object_get(transform, "translation"), place, translation) ||
            !read_three(json_object_get(transform, "rotation"), angle, degrees) || !read_scale(transform, scaled))
            return false;
        tracker_rotation_apply(translation, pose->quaternion, translation);
        for (int axis = 0; axis < 3; axis++)
            pose->position[axis] += translation[axis];
        tracker_rotation_from_angles(turn, "zxy", degrees);
        tracker_rotation_multiply(pose->quaternion, pose->quaternion, turn);
    }
    return true;
}

static bool read_time(const json_t *sample, tracker_pose_t *pose)
{
    const json_t *stamp = json_object_get(json_object_get(sample, "timing"), "sampleTimestamp");
    if (stamp == NULL)
        return true;
    const json_t *seconds = json_object_get(stamp, "seconds"), *nanoseconds = json_object_get(stamp, "nanoseconds");
    if (!json_is_integer(seconds) || !json_is_integer(nanoseconds))
        return false;
    const int64_t s = json_integer_value(seconds), ns = json_integer_value(nanoseconds);
    if (s < 0 || s >= latest_s || ns < 0 || ns >= NS_PER_S)
        return false;
    pose->timed = true;
    pose->time_us = s * US_PER_S + ns / NS_PER_US;
    return true;
}

tracker_check_t opentrackio_sample_read(tracker_packet_t *packet, const json_t *sample)
{
    if (!is_our_protocol(sample))
        return TRACKER_VERSION;
    const json_t *source = json_object_get(sample, "sourceNumber"), *transforms = json_object_get(sample, "transforms");
    if (!json_is_integer(source))
        return TRACKER_SYNTAX;
    if (json_integer_value(source) < 1 || json_integer_value(source) > LAST_SOURCE)
        return TRACKER_VALUE;
    tracker_pose_t pose = {
        .id = (uint32_t)json_integer_value(source), .quaternion = {1.0, 0.0, 0.0, 0.0}, .quality = CAN_POSE_TRACKED};
    bool scaled = false;
    if (transforms != NULL && !json_is_array(transforms))
        return TRACKER_SYNTAX;
    if (!read_transforms(transforms, &pose, &scaled) || !read_time(sample, &pose))
        return TRACKER_SYNTAX;
    if (json_array_size(transforms) == 0)
        packet->left_out[TRACKER_INCOMPLETE]++;
    else if (scaled)
        packet->left_out[TRACKER_VALUE]++;
    else
        tracker_packet_add(packet, &pose);
    return TRACKER_OK;
}
