// SPDX-License-Identifier: Apache-2.0
// What is predicted when poses go on, stop, jump, return, or are at the ends of their ranges.
#include "firmware/pose_predict.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "sim/study/study_pose.h"

enum { STEP_US = 4167 };

/* The pose of somebody who walks along x and turns about y at constant speed, without noise. */
static can_pose_t walker(int64_t time_us)
{
    pose_t pose = {{1400 * time_us, 1600000000, 0}, {1 << 30, 0, 0, 0}};
    study_pose_turn_head(&pose, (const double[3]){0.0, 1.2e-6 * (double)time_us, 0.0});
    return (can_pose_t){.pose = pose, .quality = CAN_POSE_TRACKED};
}

static void add_walk(pose_history_t *history, int64_t begin_us, int64_t end_us)
{
    for (int64_t time_us = begin_us; time_us < end_us; time_us += STEP_US) {
        const can_pose_t pose = walker(time_us);
        (void)pose_history_add(history, &pose, time_us);
    }
}

static double off_mm(const pose_t *pose, int64_t time_us)
{
    const can_pose_t expected = walker(time_us);
    double off = 0.0;
    for (int i = 0; i < 3; i++)
        off = hypot(off, (double)(pose->eye_nm[i] - expected.pose.eye_nm[i]) * 1e-6);
    return off;
}

static double off_deg(const pose_t *pose, int64_t time_us)
{
    const can_pose_t expected = walker(time_us);
    const int32_t *p = pose->quaternion_q30, *q = expected.pose.quaternion_q30;
    return fabs(atan2(p[2], p[0]) - atan2(q[2], q[0])) * 360.0 / M_PI;
}

static void constant_speed_goes_on_and_fades(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    add_walk(&history, 0, 1000000);
    const int64_t newest_us = pose_history_back(&history, 0)->time_us;
    double before_mm = 0.0, step_mm = 0.0;
    for (int32_t lead_us = 0; lead_us <= 300000; lead_us += 5000) {
        pose_t pose;
        const pose_predict_t how = pose_predict(&history, newest_us + lead_us, &pose);
        const pose_predict_t expected = lead_us == 0                      ? POSE_PREDICT_TRACKED
                                        : lead_us < POSE_PREDICT_STILL_US ? POSE_PREDICT_PREDICTED
                                                                          : POSE_PREDICT_HELD;
        assert_int_equal(how, expected);
        if (lead_us <= POSE_PREDICT_FULL_US &&
            (off_mm(&pose, newest_us + lead_us) > 0.01 || off_deg(&pose, newest_us + lead_us) > 0.001))
            fail_msg("lead %d ms: off by %g mm, %g degrees", lead_us / 1000, off_mm(&pose, newest_us + lead_us),
                     off_deg(&pose, newest_us + lead_us));
        const double moved_mm = (double)pose.eye_nm[0] * 1e-6 - before_mm;
        if (lead_us > POSE_PREDICT_FULL_US && (moved_mm > step_mm + 1e-3 || moved_mm < 0.0))
            fail_msg("lead %d ms: %g mm farther, before it %g", lead_us / 1000, moved_mm, step_mm);
        if (lead_us >= POSE_PREDICT_STILL_US && off_mm(&pose, newest_us + 100000) > 0.01)
            fail_msg("lead %d ms: not where 100 ms lead", lead_us / 1000);
        before_mm += moved_mm;
        step_mm = moved_mm;
    }
}

static void lost_poses_at_random_leave_the_motion(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    rng_t rng = {3};
    for (int64_t time_us = 0; time_us < 1000000; time_us += STEP_US) {
        const can_pose_t pose = walker(time_us);
        if (rng_next(&rng) % 2 == 0)
            (void)pose_history_add(&history, &pose, time_us);
        pose_t predicted;
        if (time_us < 200000)
            continue;
        assert_int_equal(pose_predict(&history, time_us + 20000, &predicted), POSE_PREDICT_PREDICTED);
        assert_true(off_mm(&predicted, time_us + 20000) < 1.0); /* more than 60 ms without one fades */
    }
}

static void holds_before_anything_is_known(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    pose_t pose = {{1, 2, 3}, {4, 5, 6, 7}};
    const pose_t before = pose;
    assert_int_equal(pose_predict(&history, 0, &pose), POSE_PREDICT_NONE);
    assert_memory_equal(&pose, &before, sizeof pose);
    add_walk(&history, 0, 10000);
    assert_int_equal(pose_predict(&history, 50000, &pose), POSE_PREDICT_HELD);
    assert_memory_equal(&pose, &pose_history_back(&history, 0)->pose, sizeof pose);
    add_walk(&history, 3 * STEP_US, 40000);
    assert_int_equal(pose_predict(&history, 75000, &pose), POSE_PREDICT_PREDICTED);
    assert_true(off_mm(&pose, 75000) < 1.0);
}

/* Another person, 3 m away: held there until the new run tells of a velocity, and never between the two. */
static void a_jump_is_not_overshot(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    add_walk(&history, 0, 1000000);
    for (int64_t time_us = 1000000; time_us < 1200000; time_us += STEP_US) {
        can_pose_t other = walker(0);
        other.pose.eye_nm[2] = 3000000000;
        (void)pose_history_add(&history, &other, time_us);
        pose_t pose;
        const pose_predict_t how = pose_predict(&history, time_us + 40000, &pose);
        assert_int_equal(how, time_us < 1025000 ? POSE_PREDICT_HELD : POSE_PREDICT_PREDICTED);
        assert_int_equal(pose.eye_nm[2], 3000000000);
        assert_int_equal(pose.eye_nm[0], 0);
    }
}

static void silence_forgets_the_motion(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    add_walk(&history, 0, 1000000);
    add_walk(&history, 1300000, 1304000);
    pose_t pose;
    assert_int_equal(pose_predict(&history, 1340000, &pose), POSE_PREDICT_HELD);
    assert_memory_equal(&pose, &pose_history_back(&history, 0)->pose, sizeof pose);
}

static void the_trackers_guess_is_no_measurement(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    add_walk(&history, 0, 1000000);
    const int64_t time_us = pose_history_back(&history, 0)->time_us;
    pose_t pose;
    assert_int_equal(pose_predict(&history, time_us - 500000, &pose), POSE_PREDICT_TRACKED);
    assert_true(off_mm(&pose, time_us) < 0.01);
    can_pose_t guess = walker(time_us + STEP_US);
    guess.quality = CAN_POSE_PREDICTED;
    (void)pose_history_add(&history, &guess, time_us + STEP_US);
    assert_int_equal(pose_predict(&history, time_us + STEP_US, &pose), POSE_PREDICT_PREDICTED);
}

/* The largest coordinates and steps that a checked pose may have. */
static void extremes_fit(void **state)
{
    (void)state;
    for (int way = -1; way <= 1; way += 2) {
        pose_history_t history = {.count = 0};
        for (int n = 0; n < 256; n++) {
            can_pose_t pose = {.pose = {{0}, {1 << 30, 0, 0, 0}}, .quality = CAN_POSE_TRACKED};
            study_pose_turn_head(&pose.pose, (const double[3]){0.08 * n, 0.0, 0.0});
            for (int i = 0; i < 3; i++)
                pose.pose.eye_nm[i] = way * (INT64_C(1000000000000) - n * INT64_C(20000000));
            assert_int_equal(pose_history_add(&history, &pose, n + 1),
                             n == 0 ? POSE_HISTORY_NEW_RUN : POSE_HISTORY_ADDED);
        }
        pose_t pose;
        assert_true(pose_predict(&history, INT64_MAX / 4, &pose) != POSE_PREDICT_NONE);
        assert_true(pose_predict(&history, INT64_MIN / 4, &pose) != POSE_PREDICT_NONE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_speed_goes_on_and_fades),
        cmocka_unit_test(lost_poses_at_random_leave_the_motion),
        cmocka_unit_test(holds_before_anything_is_known),
        cmocka_unit_test(a_jump_is_not_overshot),
        cmocka_unit_test(silence_forgets_the_motion),
        cmocka_unit_test(the_trackers_guess_is_no_measurement),
        cmocka_unit_test(extremes_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
