// SPDX-License-Identifier: Apache-2.0
// The transform file: from a tracker's axes, unit and bodies to the room and the viewers' eyes.
#include "sim/trackers/transform.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "firmware/room/room_yaml_file.h"
#include "sim/trackers/tracker_rotation.h"
#include "sim/trackers/transform_schema.h"

enum { MOST_TRACKER = 15, MOST_LATENCY_MS = 1000, QUATERNION_ONE = 1 << 30 };

static const double farthest_mm = 1e6, most_degrees = 360.0;

/* What every check needs. */
typedef struct {
    const room_report_t *report;
    const room_places_t *places;
} checker_t;

static bool refuse(const checker_t *checker, room_key_t key, const char *found, const char *expected)
{
    return room_refuse(checker->report, room_places_line(checker->places, key.text), key.text, "found %s, expected %s",
                       found, expected);
}

static bool check_whole(const checker_t *checker, room_key_t key, int64_t value, int64_t high)
{
    if (value >= 0 && value <= high)
        return true;
    const room_key_t found = room_key("%" PRId64, value), expected = room_key("0 to %" PRId64, high);
    return refuse(checker, key, found.text, expected.text);
}

static bool check_number(const checker_t *checker, room_key_t key, double value, double low, double high)
{
    if (value >= low && value <= high)
        return true;
    const room_key_t found = room_key("%.12g", value), expected = room_key("%.0f to %.0f", low, high);
    return refuse(checker, key, found.text, expected.text);
}

static bool check_three(const checker_t *checker, room_key_t key, const double value[3], double farthest)
{
    for (int i = 0; i < 3; i++)
        if (!check_number(checker, room_key("%s[%d]", key.text, i), value[i], -farthest, farthest))
            return false;
    return true;
}

/* @param[out] axis  Three unit vectors along x, y or z, one per direction. */
static bool check_axes(const checker_t *checker, room_key_t key, const transform_yaml_axes_t *yaml, double axis[3][3])
{
    memset(axis, 0, 9 * sizeof axis[0][0]);
    int used = 0;
    for (int i = 0; i < 3; i++) {
        const int along = (int)yaml->direction[i] / 2;
        used |= 1 << along;
        axis[i][along] = (int)yaml->direction[i] % 2 == 0 ? 1.0 : -1.0;
    }
    return used == 7 || refuse(checker, key, "an axis twice", "x, y and z once each, with their signs");
}

static double determinant(double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The camera's axes after the turn, each the sum of those before it. */
static void turn_camera(double axis[3][3], const double degrees[3])
{
    double quaternion[4], turned[3][3];
    tracker_rotation_from_angles(quaternion, "yxz", degrees);
    for (int i = 0; i < 3; i++) {
        double along[3] = {0.0};
        along[i] = 1.0;
        tracker_rotation_apply(along, quaternion, along);
        for (int k = 0; k < 3; k++)
            turned[i][k] = along[0] * axis[0][k] + along[1] * axis[1][k] + along[2] * axis[2][k];
    }
    memcpy(axis, turned, sizeof turned);
}

static bool check_viewer(const checker_t *checker, const transform_yaml_viewer_t *yaml, tracker_transform_t *transform,
                         int v)
{
    tracker_viewer_t *viewer = &transform->viewer[v];
    const room_key_t number = room_key("viewers[%d].viewer", v), body = room_key("viewers[%d].body", v);
    const room_key_t camera = room_key("viewers[%d].camera", v);
    if (!check_whole(checker, number, yaml->viewer, CAN_VIEWERS - 1) ||
        !check_whole(checker, body, yaml->body, UINT32_MAX) ||
        !check_axes(checker, camera, &yaml->camera, viewer->camera_axis) ||
        !check_three(checker, room_key("viewers[%d].eye_mm", v), yaml->eye_mm, farthest_mm) ||
        !check_three(checker, room_key("viewers[%d].turn_deg", v), yaml->turn_deg, most_degrees))
        return false;
    if (determinant(viewer->camera_axis) * determinant(transform->room_axis) < 0.0)
        return refuse(checker, camera, "it mirrored against axes",
                      "both right-handed or both left-handed: one sign is wrong, here or in axes");
    for (int other = 0; other < v; other++) {
        if (transform->viewer[other].viewer == yaml->viewer)
            return refuse(checker, number, "the number of a viewer above", "another one");
        if (transform->viewer[other].body == yaml->body)
            return refuse(checker, body, "the body of a viewer above", "another one");
    }
    viewer->viewer = (uint8_t)yaml->viewer;
    viewer->body = (uint32_t)yaml->body;
    memcpy(viewer->eye_mm, yaml->eye_mm, sizeof viewer->eye_mm);
    turn_camera(viewer->camera_axis, yaml->turn_deg);
    return true;
}

static bool check_all(const checker_t *checker, const transform_yaml_t *yaml, tracker_transform_t *transform)
{
    static const double unit_mm[UNITS] = {
        [UNIT_OF_PROTOCOL] = 0.0, [UNIT_MM] = 1.0, [UNIT_CM] = 10.0, [UNIT_M] = 1000.0, [UNIT_INCH] = 25.4};
    *transform = (tracker_transform_t){.unit_mm = unit_mm[yaml->unit], .viewers = (int)yaml->viewer_count};
    if (!check_axes(checker, room_key("axes"), &yaml->axes, transform->room_axis))
        return false;
    for (int v = 0; v < transform->viewers; v++)
        if (!check_viewer(checker, &yaml->viewer[v], transform, v))
            return false;
    if (!check_three(checker, room_key("origin_mm"), yaml->origin_mm, farthest_mm) ||
        !check_number(checker, room_key("latency_ms"), yaml->latency_ms, 0.0, MOST_LATENCY_MS) ||
        !check_whole(checker, room_key("tracker"), yaml->tracker, MOST_TRACKER))
        return false;
    memcpy(transform->origin_mm, yaml->origin_mm, sizeof transform->origin_mm);
    transform->latency_us = llround(yaml->latency_ms * 1000.0);
    transform->tracker = (uint8_t)yaml->tracker;
    return true;
}

bool tracker_transform_load(tracker_transform_t *transform, const char *path, char error[ROOM_MESSAGE_LENGTH])
{
    const room_report_t report = {.path = path, .what = "a transform file", .keys = "axes, viewers", .error = error};
    room_yaml_file_t file;
    if (!room_yaml_file_read(&file, &transform_schema, &report))
        return false;
    const checker_t checker = {.report = &report, .places = &file.places};
    tracker_transform_t read;
    const bool good = check_all(&checker, file.data, &read);
    room_yaml_file_free(&file);
    if (good)
        *transform = read;
    return good;
}

const tracker_viewer_t *tracker_transform_viewer(const tracker_transform_t *transform, uint32_t body)
{
    for (int v = 0; v < transform->viewers; v++)
        if (transform->viewer[v].body == body)
            return &transform->viewer[v];
    return NULL;
}

/* A vector of the tracker's, in the room's axes. */
static void to_room(double out[3], const tracker_transform_t *transform, const double vector[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = transform->room_axis[i][0] * vector[0] + transform->room_axis[i][1] * vector[1] +
                 transform->room_axis[i][2] * vector[2];
}

bool tracker_transform_apply(const tracker_transform_t *transform, const tracker_viewer_t *viewer, double unit_mm,
                             const tracker_pose_t *pose, pose_t *out)
{
    const double unit = transform->unit_mm > 0.0 ? transform->unit_mm : unit_mm;
    double eye[3], camera[3][3];
    tracker_rotation_apply(eye, pose->quaternion, viewer->eye_mm);
    for (int i = 0; i < 3; i++)
        eye[i] += unit * pose->position[i];
    to_room(eye, transform, (const double[3]){eye[0], eye[1], eye[2]});
    for (int i = 0; i < 3; i++) {
        eye[i] += transform->origin_mm[i];
        if (!(fabs(eye[i]) <= farthest_mm))
            return false;
        double axis[3];
        tracker_rotation_apply(axis, pose->quaternion, viewer->camera_axis[i]);
        to_room(camera[i], transform, axis);
    }
    const double matrix[3][3] = {{camera[0][0], camera[1][0], camera[2][0]},
                                 {camera[0][1], camera[1][1], camera[2][1]},
                                 {camera[0][2], camera[1][2], camera[2][2]}};
    double quaternion[4];
    if (!tracker_rotation_from_matrix(quaternion, matrix))
        return false;
    for (int i = 0; i < 3; i++)
        out->eye_nm[i] = llround(eye[i] * 1e6);
    for (int i = 0; i < 4; i++)
        out->quaternion_q30[i] = (int32_t)lround(quaternion[i] * QUATERNION_ONE);
    return true;
}
