// SPDX-License-Identifier: Apache-2.0
// Tests of the transform file: every error with its line and key, and poses worked out by hand.
#include "sim/trackers/transform.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/trackers/tracker_rotation.h"
#include "tests/support/rng.h"
#include "tests/support/scratch.h"

#define AXES "axes: {x: +x, y: -z, z: +y}\n"
#define CAMERA "camera: {right: +x, down: -z, forward: +y}"

static bool load(void **state, const char *text, tracker_transform_t *transform, char error[ROOM_MESSAGE_LENGTH])
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "transform.yaml", path);
    scratch_write(path, text, strlen(text));
    return tracker_transform_load(transform, path, error);
}

static tracker_transform_t load_good(void **state, const char *text)
{
    tracker_transform_t transform;
    char error[ROOM_MESSAGE_LENGTH] = "";
    if (!load(state, text, &transform, error))
        fail_msg("%s", error);
    return transform;
}

static void test_errors_say_line_key_and_what_was_expected(void **state)
{
    static const struct {
        const char *text, *error;
    } bad[] = {
        {"", ":1: file: empty, expected the keys axes, viewers"},
        {"hello\n", ":1: file: found 'hello', expected the keys axes, viewers, origin_mm, unit, latency_ms, tracker"},
        {AXES, ":1: viewers: missing, expected a list of 1 to 4"},
        {AXES "viewers: []\n", ":2: viewers: found a list of 0, expected a list of 1 to 4"},
        {"axes: {x: +x, y: -z, z: up}\nviewers:\n  - {viewer: 0, body: 1, " CAMERA "}\n",
         ":1: axes.z: found 'up', expected one of +x, -x, +y, -y, +z, -z"},
        {"axes: {x: +x, y: -z}\nviewers:\n  - {viewer: 0, body: 1, " CAMERA "}\n", ":1: axes.z: missing"},
        {"axes: {x: +x, y: -z, z: -z}\nviewers:\n  - {viewer: 0, body: 1, " CAMERA "}\n",
         ":1: axes: found an axis twice, expected x, y and z once each"},
        {AXES "viewers:\n  - {viewer: 0, body: 1}\n", ":3: viewers[0].camera: missing"},
        {AXES "viewers:\n  - {viewer: 4, body: 1, " CAMERA "}\n", ":3: viewers[0].viewer: found 4, expected 0 to 3"},
        {AXES "viewers:\n  - {viewer: 0, body: -1, " CAMERA "}\n", ":3: viewers[0].body: found -1, expected 0 to 4294"},
        {AXES "viewers:\n  - {viewer: 0, body: one, " CAMERA "}\n",
         ":3: viewers[0].body: found 'one', expected a whole"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\n  - {viewer: 0, body: 2, " CAMERA "}\n",
         ":4: viewers[1].viewer: found the number of a viewer above"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\n  - {viewer: 1, body: 1, " CAMERA "}\n",
         ":4: viewers[1].body: found the body of a viewer above"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, camera: {right: -x, down: -z, forward: +y}}\n",
         ":3: viewers[0].camera: found it mirrored against axes"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, camera: {right: +x, down: -x, forward: +y}}\n",
         ":3: viewers[0].camera: found an axis twice"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA ", eye_mm: [0, 1e7, 0]}\n",
         ":3: viewers[0].eye_mm[1]: found 10000000, expected -1000000 to 1000000"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA ", eye_mm: [0, 0]}\n",
         ":3: viewers[0].eye_mm: found a list of 2, expected a list of 3"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA ", turn_deg: [0, 0, 361]}\n",
         ":3: viewers[0].turn_deg[2]: found 361, expected -360 to 360"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\nunit: km\n",
         ":4: unit: found 'km', expected one of mm, cm, m, in"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\norigin_mm: [0, .nan, 0]\n",
         ":4: origin_mm[1]: found '.nan', expected a finite number"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\nlatency_ms: -1\n",
         ":4: latency_ms: found -1, expected 0 to 1000"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\ntracker: 16\n",
         ":4: tracker: found 16, expected 0 to 15"},
        {AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\nroom: 1\n",
         ":4: room: unknown key, expected one of axes"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        tracker_transform_t transform;
        memset(&transform, 0xA5, sizeof transform);
        const tracker_transform_t untouched = transform;
        char error[ROOM_MESSAGE_LENGTH] = "";
        assert_false(load(state, bad[i].text, &transform, error));
        if (strstr(error, bad[i].error) == NULL)
            fail_msg("the error is \"%s\", expected \"%s\"", error, bad[i].error);
        assert_memory_equal(&transform, &untouched, sizeof transform);
    }
    char error[ROOM_MESSAGE_LENGTH] = "";
    tracker_transform_t transform;
    assert_false(tracker_transform_load(&transform, "build/no/such.yaml", error));
    assert_non_null(strstr(error, "such.yaml:1: file: cannot be opened"));
    assert_non_null(strstr(error, "expected a transform file in YAML"));
}

/* The camera's x, y, z axes in the room. */
static void expect_looks(const pose_t *pose, const double expected[3][3])
{
    double quaternion[4];
    for (int i = 0; i < 4; i++)
        quaternion[i] = pose->quaternion_q30[i] / 1073741824.0;
    for (int i = 0; i < 3; i++) {
        double axis[3] = {0.0};
        axis[i] = 1.0;
        tracker_rotation_apply(axis, quaternion, axis);
        for (int k = 0; k < 3; k++)
            if (!(fabs(axis[k] - expected[i][k]) <= 1e-6))
                fail_msg("camera axis %d is %.7f %.7f %.7f, expected %.7f %.7f %.7f", i, axis[0], axis[1], axis[2],
                         expected[i][0], expected[i][1], expected[i][2]);
    }
}

static void expect_eye(const pose_t *pose, double x_mm, double y_mm, double z_mm)
{
    const double expected[3] = {x_mm, y_mm, z_mm};
    for (int i = 0; i < 3; i++)
        if (llabs(pose->eye_nm[i] - llround(expected[i] * 1e6)) > 1)
            fail_msg("eye_nm[%d] is %lld, expected %.6f mm", i, (long long)pose->eye_nm[i], expected[i]);
}

static pose_t apply(const tracker_transform_t *transform, const tracker_pose_t *pose)
{
    pose_t out;
    assert_true(tracker_transform_apply(transform, &transform->viewer[0], 1000.0, pose, &out));
    return out;
}

/* Tracker z up, y ahead; room y down, z ahead. At (1, 2, 3) m, turned to the left by 90 degrees. */
static void test_a_right_handed_tracker(void **state)
{
    const tracker_transform_t transform =
        load_good(state, AXES "origin_mm: [100, 200, 300]\nviewers:\n  - viewer: 0\n    body: 1\n    " CAMERA
                              "\n    eye_mm: [10, 20, 30]\n");
    tracker_pose_t pose = {.position = {1, 2, 3}, .quality = CAN_POSE_TRACKED};
    tracker_rotation_from_angles(pose.quaternion, "zxy", (const double[3]){90, 0, 0});
    const pose_t out = apply(&transform, &pose);
    /* the eye is at (10, 20, 30) in the body's axes: (-20, 10, 30) in the tracker's */
    expect_eye(&out, 100 + 1000 - 20, 200 - 3000 - 30, 300 + 2000 + 10);
    expect_looks(&out, (const double[3][3]){{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}});
}

/* x right, y up, z ahead. By the formulas for right hands, 90 degrees about y take z to x: to the right here. */
static void test_a_left_handed_tracker(void **state)
{
    const tracker_transform_t transform =
        load_good(state, "unit: cm\naxes: {x: +x, y: -y, z: +z}\nviewers:\n  - viewer: 3\n    body: 1\n"
                         "    camera: {right: +x, down: -y, forward: +z}\n    eye_mm: [0, -100, 50]\n");
    tracker_pose_t pose = {.position = {10, 20, 30}, .quality = CAN_POSE_TRACKED};
    tracker_rotation_from_angles(pose.quaternion, "xyz", (const double[3]){0, 90, 0});
    const pose_t out = apply(&transform, &pose);
    expect_eye(&out, 100 + 50, -200 + 100, 300);
    expect_looks(&out, (const double[3][3]){{0, 0, -1}, {0, 1, 0}, {1, 0, 0}});
    assert_int_equal(transform.viewer[0].viewer, 3);
}

/* Each part of turn_deg alone, for a viewer who looks straight ahead. */
static void test_turns_of_the_camera(void **state)
{
    static const struct {
        const char *turn;
        double looks[3][3];
    } turned[] = {
        {"[90, 0, 0]", {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}}, /* to the right: ahead is +x */
        {"[0, 90, 0]", {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, /* up: ahead is -y */
        {"[0, 0, 90]", {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}, /* clockwise: right is down */
        {"[90, 90, 0]", {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}},
    };
    for (size_t i = 0; i < sizeof turned / sizeof turned[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA ", turn_deg: %s}\n",
                 turned[i].turn);
        const tracker_transform_t transform = load_good(state, text);
        const tracker_pose_t pose = {.quaternion = {1, 0, 0, 0}, .quality = CAN_POSE_TRACKED};
        const pose_t out = apply(&transform, &pose);
        expect_looks(&out, turned[i].looks);
    }
}

static void test_units_and_the_other_numbers(void **state)
{
    static const struct {
        const char *unit;
        double mm;
    } unit[] = {{"", 1000}, {"unit: mm\n", 1}, {"unit: cm\n", 10}, {"unit: m\n", 1000}, {"unit: in\n", 25.4}};
    for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "%s" AXES "viewers:\n  - {viewer: 0, body: 4294967295, " CAMERA "}\n"
                 "latency_ms: 8.5\ntracker: 15\n",
                 unit[i].unit);
        const tracker_transform_t transform = load_good(state, text);
        const tracker_pose_t pose = {.position = {2, 0, 0}, .quaternion = {1, 0, 0, 0}};
        const pose_t out = apply(&transform, &pose);
        expect_eye(&out, 2 * unit[i].mm, 0, 0);
        assert_int_equal(transform.latency_us, 8500);
        assert_int_equal(transform.tracker, 15);
        assert_ptr_equal(tracker_transform_viewer(&transform, UINT32_MAX), &transform.viewer[0]);
        assert_null(tracker_transform_viewer(&transform, 0));
    }
}

static void test_eyes_too_far_away_are_refused(void **state)
{
    const tracker_transform_t transform =
        load_good(state, AXES "viewers:\n  - {viewer: 0, body: 1, " CAMERA "}\norigin_mm: [0, 0, 1000]\n");
    pose_t out = {.eye_nm = {7, 7, 7}};
    tracker_pose_t pose = {.position = {0, 999.0, 0}, .quaternion = {1, 0, 0, 0}};
    assert_true(tracker_transform_apply(&transform, &transform.viewer[0], 1000.0, &pose, &out));
    assert_int_equal(out.eye_nm[2], INT64_C(1000000000000));
    pose.position[1] = 999.001;
    out.eye_nm[2] = 7;
    assert_false(tracker_transform_apply(&transform, &transform.viewer[0], 1000.0, &pose, &out));
    assert_int_equal(out.eye_nm[2], 7);
}

/* Whatever the axes and the turn: a point ahead of the eye, known by the body, is where the room has it. */
static void test_points_fixed_to_the_head_stay_there(void **state)
{
    const uint64_t seed = 5;
    rng_t rng = {seed};
    static const char *const frame[][2] = {
        {"{x: +x, y: -z, z: +y}", "{right: +x, down: -z, forward: +y}"},
        {"{x: -y, y: +z, z: -x}", "{right: -z, down: +x, forward: -y}"},
        {"{x: +x, y: -y, z: +z}", "{right: -y, down: -x, forward: +z}"},
    };
    for (int n = 0; n < 300; n++) {
        double eye[3], degrees[3];
        tracker_pose_t pose = {.quality = CAN_POSE_TRACKED};
        for (int i = 0; i < 3; i++) {
            eye[i] = rng_double(&rng, -200, 200);
            degrees[i] = rng_double(&rng, -180, 180);
            pose.position[i] = rng_double(&rng, -5, 5);
        }
        tracker_rotation_from_angles(pose.quaternion, "zxy", degrees);
        char text[512];
        snprintf(text, sizeof text,
                 "axes: %s\nviewers:\n  - viewer: 0\n    body: 1\n    camera: %s\n"
                 "    eye_mm: [%.17g, %.17g, %.17g]\n",
                 frame[n % 3][0], frame[n % 3][1], eye[0], eye[1], eye[2]);
        const tracker_transform_t transform = load_good(state, text);
        const tracker_viewer_t *viewer = &transform.viewer[0];
        const pose_t out = apply(&transform, &pose);
        /* 1 m right, 2 m down, 3 m ahead of the eye: in the body, in the tracker, in the room */
        double body[3], tracker[3], camera[3] = {1000, 2000, 3000}, quaternion[4];
        for (int k = 0; k < 3; k++)
            body[k] = eye[k] + 1000 * viewer->camera_axis[0][k] + 2000 * viewer->camera_axis[1][k] +
                      3000 * viewer->camera_axis[2][k];
        tracker_rotation_apply(tracker, pose.quaternion, body);
        for (int i = 0; i < 4; i++)
            quaternion[i] = out.quaternion_q30[i] / 1073741824.0;
        tracker_rotation_apply(camera, quaternion, camera);
        for (int i = 0; i < 3; i++) {
            double expected = 0.0;
            for (int k = 0; k < 3; k++)
                expected += transform.room_axis[i][k] * (tracker[k] + 1000 * pose.position[k]);
            if (!(fabs((double)out.eye_nm[i] / 1e6 + camera[i] - expected) <= 1e-4))
                fail_msg("seed %llu case %d: axis %d is %.6f, expected %.6f mm", (unsigned long long)seed, n, i,
                         (double)out.eye_nm[i] / 1e6 + camera[i], expected);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_say_line_key_and_what_was_expected),
        cmocka_unit_test(test_a_right_handed_tracker),
        cmocka_unit_test(test_a_left_handed_tracker),
        cmocka_unit_test(test_turns_of_the_camera),
        cmocka_unit_test(test_units_and_the_other_numbers),
        cmocka_unit_test(test_eyes_too_far_away_are_refused),
        cmocka_unit_test(test_points_fixed_to_the_head_stay_there),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
