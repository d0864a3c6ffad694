// SPDX-License-Identifier: Apache-2.0
// Tests of the message encoders and decoders: round trips, rounding, ranges.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "tests/support/random_pose.h"

static const uint64_t SEED = 20240131;
enum { ROUNDS = 2000 };

/* How far two times are apart on a clock that wraps. */
static uint64_t time_distance(uint64_t a, uint64_t b, uint64_t wrap)
{
    const uint64_t forward = (a % wrap + wrap - b % wrap) % wrap;
    return forward < wrap - forward ? forward : wrap - forward;
}

static void assert_same_pose(const can_pose_t *sent, const can_pose_t *got, int64_t half_nm, int64_t half_q30,
                             int round)
{
    for (int i = 0; i < 3; i++)
        if (llabs(sent->pose.eye_nm[i] - got->pose.eye_nm[i]) > half_nm)
            fail_msg("seed %llu round %d: position %d sent %lld nm, got %lld nm", (unsigned long long)SEED, round, i,
                     (long long)sent->pose.eye_nm[i], (long long)got->pose.eye_nm[i]);
    for (int i = 0; i < 4; i++) {
        const int64_t most = sent->pose.quaternion_q30[i] > (1 << 30) - half_q30 ? 2 * half_q30 : half_q30;
        if (llabs((int64_t)sent->pose.quaternion_q30[i] - got->pose.quaternion_q30[i]) > most)
            fail_msg("seed %llu round %d: quaternion %d sent %d, got %d", (unsigned long long)SEED, round, i,
                     sent->pose.quaternion_q30[i], got->pose.quaternion_q30[i]);
    }
    assert_int_equal(got->quality, sent->quality);
    assert_int_equal(got->viewer, sent->viewer);
    assert_int_equal(got->counter, sent->counter);
}

static void test_random_sets_come_back_within_the_quantum(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    for (int round = 0; round < ROUNDS; round++) {
        const can_pose_t sent = random_pose(&rng, INT64_C(83886070000), CAN_E2E_P01_COUNTERS);
        can_pose_t got;
        hal_can_frame_t part[CAN_POSE_PARTS];
        assert_true(can_pose_set_encode(part, &sent));
        assert_int_equal(can_pose_set_decode(&got, part, sent.viewer), CAN_CHECK_OK);
        assert_same_pose(&sent, &got, 5000, 1 << 14, round);
        assert_int_equal(got.tracker, 0);
        assert_true(time_distance(sent.capture_time_us, got.capture_time_us, CAN_POSE_SET_WRAP_US) <= 50);
        assert_true(got.capture_time_us < CAN_POSE_SET_WRAP_US);
    }
}

static void test_random_fd_poses_come_back_within_the_quantum(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    for (int round = 0; round < ROUNDS; round++) {
        const can_pose_t sent = random_pose(&rng, INT64_C(1000000000000), CAN_E2E_P05_COUNTERS);
        can_pose_t got;
        hal_can_frame_t frame;
        assert_true(can_pose_fd_encode(&frame, &sent));
        assert_int_equal(can_pose_fd_decode(&got, &frame, sent.viewer), CAN_CHECK_OK);
        assert_same_pose(&sent, &got, 500, 1 << 7, round);
        assert_int_equal(got.tracker, sent.tracker);
        assert_true(got.capture_time_us == sent.capture_time_us % CAN_POSE_FD_WRAP_US);
    }
}

static void test_rounding_is_to_nearest_on_both_sides_of_zero(void **state)
{
    (void)state;
    const can_pose_t sent = {
        .pose = {.eye_nm = {14999, -14999, -15000}, .quaternion_q30 = {16384, -16383, -16384, 16383}},
        .quality = CAN_POSE_TRACKED};
    can_pose_t got;
    hal_can_frame_t part[CAN_POSE_PARTS];
    assert_true(can_pose_set_encode(part, &sent));
    assert_int_equal(can_pose_set_decode(&got, part, 0), CAN_CHECK_OK);
    assert_int_equal(got.pose.eye_nm[0], 10000);
    assert_int_equal(got.pose.eye_nm[1], -10000);
    assert_int_equal(got.pose.eye_nm[2], -20000);
    assert_int_equal(got.pose.quaternion_q30[0], 1 << 15);
    assert_int_equal(got.pose.quaternion_q30[1], 0);
    assert_int_equal(got.pose.quaternion_q30[2], -(1 << 15));
    assert_int_equal(got.pose.quaternion_q30[3], 0);
}

static void test_one_saturates_in_the_set_and_fits_the_fd_frame(void **state)
{
    (void)state;
    const can_pose_t sent = {.pose.quaternion_q30 = {1 << 30, -(1 << 30), 0, 0}, .quality = CAN_POSE_TRACKED};
    can_pose_t got;
    hal_can_frame_t part[CAN_POSE_PARTS];
    hal_can_frame_t frame;
    assert_true(can_pose_set_encode(part, &sent));
    assert_int_equal(can_pose_set_decode(&got, part, 0), CAN_CHECK_OK);
    assert_int_equal(got.pose.quaternion_q30[0], 32767 << 15);
    assert_int_equal(got.pose.quaternion_q30[1], -(1 << 30));
    assert_true(can_pose_fd_encode(&frame, &sent));
    assert_int_equal(can_pose_fd_decode(&got, &frame, 0), CAN_CHECK_OK);
    assert_int_equal(got.pose.quaternion_q30[0], 1 << 30);
}

/* 1 % too long is legal; the set has no room for it, but the turn must be the same and the length still legal. */
static void test_a_long_quaternion_keeps_its_turn_in_the_set(void **state)
{
    (void)state;
    const can_pose_t sent = {.pose.quaternion_q30 = {1084000000, 0, 60000000, 0}, .quality = CAN_POSE_TRACKED};
    can_pose_t got;
    hal_can_frame_t part[CAN_POSE_PARTS];
    assert_true(can_pose_set_encode(part, &sent));
    assert_int_equal(can_pose_set_decode(&got, part, 0), CAN_CHECK_OK);
    const double ratio = (double)got.pose.quaternion_q30[2] / got.pose.quaternion_q30[0];
    assert_true(fabs(ratio - 60000000.0 / 1084000000.0) < 2.0 / 32768);
    assert_true(hypot(got.pose.quaternion_q30[0], got.pose.quaternion_q30[2]) > 0.99 * 0x1p30);
}

static void test_values_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    const can_pose_t good = {.pose.quaternion_q30 = {1 << 30, 0, 0, 0}, .quality = CAN_POSE_TRACKED};
    hal_can_frame_t part[CAN_POSE_PARTS];
    hal_can_frame_t before[CAN_POSE_PARTS];
    memset(part, 0xA5, sizeof part);
    memcpy(before, part, sizeof part);
    enum { BAD_FOR_SET = 8, BAD = 12 };
    can_pose_t bad[BAD];
    for (int i = 0; i < BAD; i++)
        bad[i] = good;
    bad[0].pose.eye_nm[0] = INT64_C(83886075000);
    bad[1].pose.eye_nm[1] = -INT64_C(83886085000);
    bad[2].pose.eye_nm[2] = INT64_MAX / 4;
    bad[3].pose.quaternion_q30[0] = (1 << 30) + (1 << 24);
    bad[4].pose.quaternion_q30[3] = -(1 << 30) - (1 << 24);
    bad[5].counter = 15;
    bad[6].viewer = CAN_VIEWERS;
    bad[7].quality = (can_pose_quality_t)3;
    bad[8].pose.eye_nm[0] = INT64_C(2147483647500);
    bad[9].pose.quaternion_q30[2] = INT32_MAX;
    bad[10].tracker = 16;
    bad[11].pose.eye_nm[2] = -INT64_C(2147483648500);
    for (int i = 0; i < BAD_FOR_SET; i++)
        assert_false(can_pose_set_encode(part, &bad[i]));
    for (int i = BAD_FOR_SET - 2; i < BAD; i++)
        assert_false(can_pose_fd_encode(part, &bad[i]));
    assert_memory_equal(part, before, sizeof part);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_sets_come_back_within_the_quantum),
        cmocka_unit_test(test_random_fd_poses_come_back_within_the_quantum),
        cmocka_unit_test(test_rounding_is_to_nearest_on_both_sides_of_zero),
        cmocka_unit_test(test_one_saturates_in_the_set_and_fits_the_fd_frame),
        cmocka_unit_test(test_a_long_quaternion_keeps_its_turn_in_the_set),
        cmocka_unit_test(test_values_that_do_not_fit_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
