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

/* The boards' messages, with every field at some value. */
static const can_heartbeat_t HEARTBEAT = {.node = 63,
                                          .counter = 14,
                                          .state = CAN_BOARD_FAULT,
                                          .fault_flags = CAN_FAULT_BUS | CAN_FAULT_DEADLINE,
                                          .frame_number = 0x12345,
                                          .uptime_s = 0x1FFFE};
static const can_status_t STATUS = {.node = 1,
                                    .counter = 3,
                                    .pose_counter = 200,
                                    .pose_age_ms = 17,
                                    .step_q8 = 700,
                                    .warp_time_us = 12360,
                                    .can_faults = 1025};

static void test_heartbeat_comes_back(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_heartbeat_t got;
    assert_true(can_heartbeat_encode(&frame, &HEARTBEAT));
    assert_int_equal(frame.id, 0x73F);
    assert_int_equal(can_heartbeat_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, 63);
    assert_int_equal(got.counter, 14);
    assert_int_equal(got.state, CAN_BOARD_FAULT);
    assert_int_equal(got.fault_flags, CAN_FAULT_BUS | CAN_FAULT_DEADLINE);
    assert_int_equal(got.frame_number, 0x2345);
    assert_int_equal(got.uptime_s, 0xFFFE);

    can_heartbeat_t bad[5] = {HEARTBEAT, HEARTBEAT, HEARTBEAT, HEARTBEAT, HEARTBEAT};
    bad[0].node = 0;
    bad[1].node = CAN_MAX_NODE + 1;
    bad[2].counter = 15;
    bad[3].state = (can_board_state_t)5;
    bad[4].fault_flags = 0x10000;
    for (int i = 0; i < 5; i++)
        assert_false(can_heartbeat_encode(&frame, &bad[i]));
}

static void test_status_comes_back_saturated(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_status_t got;
    assert_true(can_status_encode(&frame, &STATUS));
    assert_int_equal(frame.id, 0x401);
    assert_int_equal(can_status_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, 1);
    assert_int_equal(got.counter, 3);
    assert_int_equal(got.pose_counter, 200);
    assert_int_equal(got.pose_age_ms, 17);
    assert_int_equal(got.step_q8, 700);
    assert_int_equal(got.warp_time_us, 12400);
    assert_int_equal(got.can_faults, 1);

    can_status_t large = STATUS;
    large.pose_age_ms = large.step_q8 = large.warp_time_us = UINT32_C(100) << 24;
    assert_true(can_status_encode(&frame, &large));
    assert_int_equal(can_status_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.pose_age_ms, 1023);
    assert_int_equal(got.step_q8, 16383);
    assert_int_equal(got.warp_time_us, 102300);
    assert_int_equal(got.pose_counter, 200);
    large.counter = 15;
    assert_false(can_status_encode(&frame, &large));
    large.counter = 0;
    large.node = 64;
    assert_false(can_status_encode(&frame, &large));
}

static void test_stages_come_back_saturated(void **state)
{
    (void)state;
    const can_stage_t stage = {
        .node = 9, .counter = 14, .stage = STAGE_WAIT, .mean_us = 65535, .worst_us = 1, .shown = 255, .late = 254};
    hal_can_frame_t frame;
    can_stage_t got;
    assert_true(can_stage_encode(&frame, &stage));
    assert_int_equal(frame.id, 0x449);
    assert_int_equal(can_stage_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, 9);
    assert_int_equal(got.counter, 14);
    assert_int_equal(got.stage, STAGE_WAIT);
    assert_int_equal(got.mean_us, 65535);
    assert_int_equal(got.worst_us, 1);
    assert_int_equal(got.shown, 255);
    assert_int_equal(got.late, 254);

    can_stage_t large = stage;
    large.mean_us = large.worst_us = large.shown = large.late = 65536;
    assert_true(can_stage_encode(&frame, &large));
    assert_int_equal(can_stage_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.mean_us, 65535);
    assert_int_equal(got.worst_us, 65535);
    assert_int_equal(got.shown, 255);
    assert_int_equal(got.late, 255);

    can_stage_t bad[3] = {stage, stage, stage};
    bad[0].node = 0;
    bad[1].counter = 15;
    bad[2].stage = STAGES;
    for (int i = 0; i < 3; i++)
        assert_false(can_stage_encode(&frame, &bad[i]));
}

static void test_quality_comes_back_saturated(void **state)
{
    (void)state;
    const can_quality_t quality = {.node = 2,
                                   .counter = 1,
                                   .step = 4,
                                   .filter = WARP_FILTER_BUTTER,
                                   .resampler = WARP_AUTO,
                                   .changes = 65537,
                                   .wanted_us = 65536,
                                   .hold_s = 2047};
    hal_can_frame_t frame;
    can_quality_t got;
    assert_true(can_quality_encode(&frame, &quality));
    assert_int_equal(frame.id, 0x482);
    assert_int_equal(can_quality_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, 2);
    assert_int_equal(got.counter, 1);
    assert_int_equal(got.step, 4);
    assert_int_equal(got.filter, WARP_FILTER_BUTTER);
    assert_int_equal(got.resampler, WARP_AUTO);
    assert_int_equal(got.changes, 1);
    assert_int_equal(got.wanted_us, 65535);
    assert_int_equal(got.hold_s, 1020);

    can_quality_t bad[5] = {quality, quality, quality, quality, quality};
    bad[0].node = 64;
    bad[1].counter = 15;
    bad[2].step = 5;
    bad[3].filter = (warp_filter_t)4;
    bad[4].resampler = (warp_resampler_t)9;
    for (int i = 0; i < 5; i++)
        assert_false(can_quality_encode(&frame, &bad[i]));
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
        cmocka_unit_test(test_heartbeat_comes_back),
        cmocka_unit_test(test_status_comes_back_saturated),
        cmocka_unit_test(test_stages_come_back_saturated),
        cmocka_unit_test(test_quality_comes_back_saturated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
