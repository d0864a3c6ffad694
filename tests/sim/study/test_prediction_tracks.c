// SPDX-License-Identifier: Apache-2.0
// The motions are the stated ones, and errors that are known come out.
#include "sim/study/prediction_tracks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static double yaw_deg(prediction_track_t track, double time_s)
{
    const pose_t pose = prediction_pose(track, time_s);
    return 360.0 / M_PI * atan2(pose.quaternion_q30[2], pose.quaternion_q30[0]);
}

static double place_m(prediction_track_t track, int axis, double time_s)
{
    return (double)(prediction_pose(track, time_s).eye_nm[axis] - prediction_pose(track, 0.0).eye_nm[axis]) * 1e-9;
}

static bool is(double value, double expected)
{
    return fabs(value - expected) < 1e-6;
}

static void motions_are_the_stated_ones(void **state)
{
    (void)state;
    const double turn_s = 1.0 / 0.7;
    assert_true(is(yaw_deg(PREDICTION_TURNING, turn_s / 4), 45.0));
    assert_true(is(yaw_deg(PREDICTION_BOTH, 0.75 * turn_s), -45.0));
    assert_true(is(yaw_deg(PREDICTION_WALKING, 0.3), 0.0));
    assert_true(is(place_m(PREDICTION_TURNING, 0, 3.0), 0.0));
    assert_true(is(place_m(PREDICTION_WALKING, 0, 3.0), 4.2));
    assert_true(is(place_m(PREDICTION_WALKING, 1, 1.0 / 8), 0.03));
    assert_true(is(place_m(PREDICTION_BOTH, 1, 3.0 / 8), -0.03));
    /* 1.4 s up to speed, 1 s so, 1.4 s down, 1 s still */
    const struct {
        double time_s, place_m;
    } stop_and_go[] = {{0.7, 0.245}, {1.4, 0.98}, {2.4, 2.38},  {3.1, 3.115}, {3.8, 3.36},
                       {4.5, 3.36},  {4.8, 3.36}, {5.5, 3.605}, {9.6, 6.72}};
    for (size_t n = 0; n < sizeof stop_and_go / sizeof *stop_and_go; n++)
        if (!is(place_m(PREDICTION_STOP_AND_GO, 0, stop_and_go[n].time_s), stop_and_go[n].place_m))
            fail_msg("%g s: %g m", stop_and_go[n].time_s, place_m(PREDICTION_STOP_AND_GO, 0, stop_and_go[n].time_s));
}

static double root(double square, const prediction_error_t *error)
{
    return sqrt(square / (double)error->frames);
}

/* 1.4 m/s for 40 ms; noise along three axes; 45 degrees, 2 sin(pi 0.7 0.04) of them, of which 1 / sqrt 2 remains. */
static void the_held_error_is_known(void **state)
{
    (void)state;
    prediction_error_t walking = {.frames = 0}, turning = {.frames = 0}, standing = {.frames = 0};
    prediction_error_add(&walking, PREDICTION_WALKING, 40000, 0.0, 1);
    prediction_error_add(&turning, PREDICTION_TURNING, 40000, 0.0, 2);
    prediction_error_add(&standing, PREDICTION_STANDING, 0, 0.0, 3);
    assert_int_equal(walking.frames, (PREDICTION_SECONDS - 1) * PREDICTION_RATE_HZ / PREDICTION_EVERY);
    assert_int_equal(standing.frames, 5 * PREDICTION_RATE_HZ / PREDICTION_EVERY);
    const double noise = sqrt(3.0), bob_mm = 30.0 * 2.0 * sin(M_PI * 2.0 * 0.04) / sqrt(2.0);
    assert_true(fabs(root(walking.hold_mm2, &walking) - hypot(hypot(56.0, bob_mm), 0.5 * noise)) < 0.2);
    assert_true(fabs(root(walking.hold_deg2, &walking) - 0.05 * noise) < 0.004);
    const double swing_deg = 45.0 * 2.0 * sin(M_PI * 0.7 * 0.04) / sqrt(2.0);
    assert_true(fabs(root(turning.hold_deg2, &turning) - swing_deg) < 0.1);
    assert_true(fabs(root(standing.hold_mm2, &standing) - 0.5 * noise) < 0.05);
}

/* Half the poses lost: the newest is a period older on average, at 1.4 m/s 5.8 mm. */
static void lost_poses_make_the_held_one_older(void **state)
{
    (void)state;
    prediction_error_t all = {.frames = 0}, half = {.frames = 0};
    prediction_error_add(&all, PREDICTION_WALKING, 40000, 0.0, 1);
    prediction_error_add(&half, PREDICTION_WALKING, 40000, 0.5, 1);
    assert_int_equal(all.frames, half.frames);
    const double older_mm = root(half.hold_mm2, &half) - root(all.hold_mm2, &all);
    if (older_mm < 4.8 || older_mm > 7.3)
        fail_msg("%g mm", older_mm);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions_are_the_stated_ones),
        cmocka_unit_test(the_held_error_is_known),
        cmocka_unit_test(lost_poses_make_the_held_one_older),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
