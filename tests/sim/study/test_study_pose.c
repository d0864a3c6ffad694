// SPDX-License-Identifier: Apache-2.0
// Poses before the study's wall: against those of the tables in tests/oracle, turned, tracked, walking.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "sim/eval/double_homography.h"
#include "sim/pose/pose_text.h"
#include "sim/study/study_scene.h"
#include "sim/study/study_walk.h"

static void poses_are_those_of_the_tables(void **state)
{
    (void)state;
    static const struct {
        double angle_deg;
        const char *text;
    } rows[] = {
        {0, "0.000000 0.000000 -2500.000000 1.000000000 0.000000000 0.000000000 0.000000000"},
        {30, "1250.000000 0.000000 -2165.063509 0.965925826 -0.000000000 -0.258819045 -0.000000000"},
        {60, "2165.063509 0.000000 -1250.000000 0.866025404 0.000000000 -0.500000000 0.000000000"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char error[256];
        pose_t expected;
        const pose_t pose = study_pose(rows[r].angle_deg);
        assert_true(pose_from_text(rows[r].text, &expected, error));
        for (int i = 0; i < 3; i++)
            assert_int_equal(pose.eye_nm[i], expected.eye_nm[i]);
        for (int i = 0; i < 4; i++)
            assert_in_range(pose.quaternion_q30[i] - expected.quaternion_q30[i] + 2, 0, 4);
    }
}

/* Whatever the turns, the viewer looks at the wall's centre from 2.5 m. */
static void turned_poses_look_at_the_centre(void **state)
{
    (void)state;
    const study_sizes_t sizes = {1920, 1080, 1920, 1080};
    study_scene_t scene;
    study_scene(&scene, &sizes);
    for (int n = 0; n < 27; n++) {
        const double angle_deg[3] = {(n % 3 - 1) * 35.0, (n / 3 % 3 - 1) * 50.0, (n / 9 - 1) * 110.0};
        const pose_t pose = study_pose_turned(angle_deg);
        homography_t homography;
        double_homography_t seen;
        assert_true(homography_from_pose(&homography, &scene.camera, &scene.wall, &pose));
        double_homography_from_fixed(&seen, &homography);
        const double c =
            seen.panel_from_picture[2][0] * 960 + seen.panel_from_picture[2][1] * 540 + seen.panel_from_picture[2][2];
        const double depth = seen.inverse_depth[0] * 960 + seen.inverse_depth[1] * 540 + seen.inverse_depth[2];
        for (int axis = 0; axis < 2; axis++) {
            const double *row = seen.panel_from_picture[axis];
            const double at = (row[0] * 960 + row[1] * 540 + row[2]) / c;
            assert_true(fabs(at - (axis == 0 ? 960 : 540)) < 1e-4);
        }
        assert_true(fabs(1.0 / depth - 2.5) < 1e-6);
    }
    /* about Z alone by a right angle: what was right of the viewer is now above or below */
    const pose_t rolled = study_pose_turned((const double[3]){0.0, 0.0, 90.0});
    assert_int_equal(rolled.eye_nm[2], INT64_C(-2500000000));
    assert_in_range(rolled.quaternion_q30[0], 759250124 - 2, 759250125 + 2);
    assert_in_range(-rolled.quaternion_q30[3], 759250124 - 2, 759250125 + 2);
    /* about X: the eye moves up or down, not aside */
    const pose_t raised = study_pose_turned((const double[3]){30.0, 0.0, 0.0});
    assert_int_equal(raised.eye_nm[0], 0);
    assert_int_equal(llabs(raised.eye_nm[1]), INT64_C(1250000000));
    /* X first: a turn about the vertical then keeps the height */
    assert_int_equal(study_pose_turned((const double[3]){30.0, 50.0, 0.0}).eye_nm[1], raised.eye_nm[1]);
}

static void turning_keeps_place_and_length(void **state)
{
    (void)state;
    pose_t pose = study_pose(30.0);
    const pose_t before = pose;
    study_pose_turn_head(&pose, (const double[3]){0.3, -0.2, 0.5});
    double length = 0.0;
    for (int i = 0; i < 4; i++)
        length += pow(pose.quaternion_q30[i] / 1073741824.0, 2);
    assert_true(fabs(length - 1.0) < 1e-8);
    assert_memory_equal(pose.eye_nm, before.eye_nm, sizeof pose.eye_nm);
    study_pose_turn_head(&pose, (const double[3]){-0.3, 0.2, -0.5});
    for (int i = 0; i < 4; i++)
        assert_in_range(pose.quaternion_q30[i] - before.quaternion_q30[i] + 4, 0, 8);
}

static void yaw_is_about_the_camera_s_y_axis(void **state)
{
    (void)state;
    /* study_pose(a) stands at angle a and has turned by -a to look at the centre */
    pose_t turned = study_pose(0.0);
    const pose_t expected = study_pose(30.0);
    study_pose_turn_head(&turned, (const double[3]){0.0, -30.0 * M_PI / 180.0, 0.0});
    for (int i = 0; i < 4; i++)
        assert_in_range(turned.quaternion_q30[i] - expected.quaternion_q30[i] + 4, 0, 8);
}

static void walk_goes_along_the_wall(void **state)
{
    (void)state;
    const study_walk_t walk = {study_pose(0.0), 1.4, 0.02, 0.0};
    const double quarter_bob_s = 0.25 / study_walk_bob_hz;
    const pose_t pose = study_walk_pose(&walk, quarter_bob_s), start = study_walk_pose(&walk, 0.0);
    assert_int_equal(pose.eye_nm[0], llround(1.4e9 * quarter_bob_s));
    assert_int_equal(pose.eye_nm[1], 20000000);
    assert_int_equal(pose.eye_nm[2], walk.start.eye_nm[2]);
    assert_memory_equal(&start, &walk.start, sizeof start);
}

static void tracked_poses_are_off_by_the_noise(void **state)
{
    (void)state;
    enum { DRAWS = 4000 };
    const study_noise_t noise = {5.0, 0.5};
    const pose_t pose = study_pose(20.0);
    double square_mm[3] = {0.0}, square_deg = 0.0;
    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        rng_t rng = {seed};
        const pose_t tracked = study_pose_tracked(&pose, &noise, &rng);
        double cosine = 0.0;
        for (int i = 0; i < 3; i++)
            square_mm[i] += pow((double)(tracked.eye_nm[i] - pose.eye_nm[i]) / 1e6, 2) / DRAWS;
        for (int i = 0; i < 4; i++)
            cosine += (double)tracked.quaternion_q30[i] * pose.quaternion_q30[i] / 1152921504606846976.0;
        square_deg += pow(2.0 * acos(fmin(cosine, 1.0)) * 180.0 / M_PI, 2) / DRAWS;
    }
    /* 4000 draws: standard error 1.1 % of a deviation, 0.7 % of the turn about all three axes */
    for (int i = 0; i < 3; i++)
        assert_true(fabs(sqrt(square_mm[i]) / 5.0 - 1.0) < 0.05);
    assert_true(fabs(sqrt(square_deg / 3.0) / 0.5 - 1.0) < 0.04);
}

static void noise_of_one_seed_is_scaled(void **state)
{
    (void)state;
    const pose_t pose = study_pose(10.0);
    const pose_t small = study_pose_tracked(&pose, &(study_noise_t){1.0, 0.0}, &(rng_t){3});
    const pose_t large = study_pose_tracked(&pose, &(study_noise_t){10.0, 0.0}, &(rng_t){3});
    for (int i = 0; i < 3; i++)
        assert_in_range(large.eye_nm[i] - pose.eye_nm[i] - 10 * (small.eye_nm[i] - pose.eye_nm[i]) + 10, 0, 20);
    assert_memory_equal(small.quaternion_q30, pose.quaternion_q30, sizeof pose.quaternion_q30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses_are_those_of_the_tables),  cmocka_unit_test(turned_poses_look_at_the_centre),
        cmocka_unit_test(turning_keeps_place_and_length), cmocka_unit_test(yaw_is_about_the_camera_s_y_axis),
        cmocka_unit_test(walk_goes_along_the_wall),       cmocka_unit_test(tracked_poses_are_off_by_the_noise),
        cmocka_unit_test(noise_of_one_seed_is_scaled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
