// SPDX-License-Identifier: Apache-2.0
// What the pose history keeps, what it ignores, and where a new run begins.
#include "firmware/pose_history.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static const double q30 = 1073741824.0;

static can_pose_t pose_at(double x_mm, double yaw_deg, uint8_t counter)
{
    const double half = yaw_deg * M_PI / 360.0;
    return (can_pose_t){.pose = {{llround(x_mm * 1e6), 0, 0},
                                 {(int32_t)llround(cos(half) * q30), 0, (int32_t)llround(sin(half) * q30), 0}},
                        .quality = CAN_POSE_TRACKED,
                        .counter = counter};
}

static pose_history_added_t add(pose_history_t *history, double x_mm, double yaw_deg, int64_t time_us)
{
    const can_pose_t pose = pose_at(x_mm, yaw_deg, (uint8_t)(time_us / 1000));
    return pose_history_add(history, &pose, time_us);
}

static void keeps_the_newest(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    assert_null(pose_history_back(&history, 0));
    for (int n = 0; n < 600; n++) {
        assert_int_equal(add(&history, n, 0.0, n * 4000), n == 0 ? POSE_HISTORY_NEW_RUN : POSE_HISTORY_ADDED);
        const int kept = n + 1 < POSE_HISTORY_POSES ? n + 1 : POSE_HISTORY_POSES;
        assert_int_equal(history.count, kept);
        assert_int_equal(pose_history_back(&history, 0)->time_us, n * 4000);
        assert_int_equal(pose_history_back(&history, kept - 1)->time_us, (n + 1 - kept) * 4000);
        assert_null(pose_history_back(&history, kept));
    }
    const pose_at_t *old = pose_history_back(&history, 100);
    assert_int_equal(old->pose.eye_nm[0], INT64_C(499000000));
    assert_int_equal(old->counter, (499 * 4) % 256);
    assert_true(old->measured);
    assert_false(old->begins_run);
}

static void ignores_what_is_not_newer_or_no_pose(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    (void)add(&history, 0.0, 0.0, 1000000);
    assert_int_equal(add(&history, 1.0, 0.0, 1000000), POSE_HISTORY_IGNORED);
    assert_int_equal(add(&history, 1.0, 0.0, 999999), POSE_HISTORY_IGNORED);
    assert_int_equal(add(&history, 1.0, 0.0, 1000001 - POSE_HISTORY_SILENCE_US), POSE_HISTORY_IGNORED);
    can_pose_t pose = pose_at(0.0, 0.0, 1);
    pose.quality = CAN_POSE_LOST;
    assert_int_equal(pose_history_add(&history, &pose, 1004000), POSE_HISTORY_IGNORED);
    pose.quality = CAN_POSE_PREDICTED;
    for (int i = 0; i < 4; i++)
        pose.pose.quaternion_q30[i] = 0;
    assert_int_equal(pose_history_add(&history, &pose, 1004000), POSE_HISTORY_IGNORED);
    assert_int_equal(history.count, 1);
    assert_int_equal(pose_history_back(&history, 0)->pose.eye_nm[0], 0);

    pose = pose_at(0.0, 0.0, 1);
    pose.quality = CAN_POSE_PREDICTED;
    for (int i = 0; i < 4; i++)
        pose.pose.quaternion_q30[i] = pose.pose.quaternion_q30[i] / 100 * 101;
    assert_int_equal(pose_history_add(&history, &pose, 1004000), POSE_HISTORY_ADDED);
    assert_false(pose_history_back(&history, 0)->measured);
    assert_in_range(pose_history_back(&history, 0)->pose.quaternion_q30[0], (1 << 30) - 2, (1 << 30) + 2);
}

/* Each case: 10 s, then a pose that much later, to the side and turned. */
static void a_run_ends_with_silence_or_a_jump(void **state)
{
    (void)state;
    const struct {
        int64_t later_us;
        double x_mm, yaw_deg;
        bool begins;
    } cases[] = {
        {POSE_HISTORY_SILENCE_US, 0.0, 0.0, false},
        {POSE_HISTORY_SILENCE_US + 1, 0.0, 0.0, true},
        {4000, 59.9, 0.0, false}, /* 20 mm and 10 m/s */
        {4000, 60.1, 0.0, true},
        {4000, -60.1, 0.0, true},
        {100000, 1019.0, 0.0, false},
        {100000, 1021.0, 0.0, true},
        {4000, 0.0, 12.9, false}, /* 5 degrees and 2000 degrees/s */
        {4000, 0.0, 13.1, true},
        {4000, 0.0, -13.1, true},
        {4000, 0.0, 180.0, true},
        {100000, 0.0, 170.0, false},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        pose_history_t history = {.count = 0};
        (void)add(&history, 0.0, 0.0, 10000000);
        const pose_history_added_t added = add(&history, cases[n].x_mm, cases[n].yaw_deg, 10000000 + cases[n].later_us);
        if (added != (cases[n].begins ? POSE_HISTORY_NEW_RUN : POSE_HISTORY_ADDED))
            fail_msg("case %d: %d", (int)n, added);
        assert_int_equal(pose_history_back(&history, 0)->begins_run, cases[n].begins);
        assert_int_equal(history.count, 2);
    }
}

/* The clock was set back, or one time was far in the future: nobody waits for it. */
static void a_new_clock_forgets_the_old_one(void **state)
{
    (void)state;
    pose_history_t history = {.count = 0};
    for (int n = 0; n < 10; n++)
        (void)add(&history, n, 0.0, 5000000 + n * 4000);
    assert_int_equal(add(&history, 1000.0, 0.0, 5040000 + POSE_HISTORY_SILENCE_US), POSE_HISTORY_NEW_RUN);
    assert_int_equal(add(&history, 10.0, 0.0, 5040000), POSE_HISTORY_NEW_CLOCK);
    assert_int_equal(history.count, 1);
    assert_true(pose_history_back(&history, 0)->begins_run);
    assert_int_equal(add(&history, 11.0, 0.0, 5044000), POSE_HISTORY_ADDED);
    assert_int_equal(history.count, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_the_newest),
        cmocka_unit_test(ignores_what_is_not_newer_or_no_pose),
        cmocka_unit_test(a_run_ends_with_silence_or_a_jump),
        cmocka_unit_test(a_new_clock_forgets_the_old_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
