// SPDX-License-Identifier: Apache-2.0
// Tests of the boards' reports: what is encoded comes back, rounded and saturated as the header says.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"

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
    bad[3].state = CAN_BOARD_STATES;
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

static void test_time_comes_back_rounded_and_saturated(void **state)
{
    (void)state;
    const can_time_t time = {.node = 3,
                             .counter = 14,
                             .state = CAN_TIME_HOLDOVER,
                             .master = 63,
                             .drift_ppb = -50051,
                             .error_us = 1023,
                             .changes = 65,
                             .relocks = 17,
                             .lost = 257};
    hal_can_frame_t frame;
    can_time_t got;
    assert_true(can_time_encode(&frame, &time));
    assert_int_equal(frame.id, 0x4C3);
    assert_int_equal(can_time_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, 3);
    assert_int_equal(got.counter, 14);
    assert_int_equal(got.state, CAN_TIME_HOLDOVER);
    assert_int_equal(got.master, 63);
    assert_int_equal(got.drift_ppb, -50100);
    assert_int_equal(got.error_us, 1023);
    assert_int_equal(got.changes, 1);
    assert_int_equal(got.relocks, 1);
    assert_int_equal(got.lost, 1);

    can_time_t large = time;
    large.drift_ppb = INT32_MIN;
    large.error_us = UINT32_MAX;
    assert_true(can_time_encode(&frame, &large));
    assert_int_equal(can_time_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.drift_ppb, -819100);
    assert_int_equal(got.error_us, 1023);
    large.drift_ppb = INT32_MAX;
    assert_true(can_time_encode(&frame, &large));
    assert_int_equal(can_time_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.drift_ppb, 819100);

    can_time_t bad[4] = {time, time, time, time};
    bad[0].node = 64;
    bad[1].counter = 15;
    bad[2].state = (can_time_state_t)4;
    bad[3].master = 64;
    for (int i = 0; i < 4; i++)
        assert_false(can_time_encode(&frame, &bad[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_heartbeat_comes_back),
        cmocka_unit_test(test_status_comes_back_saturated),
        cmocka_unit_test(test_stages_come_back_saturated),
        cmocka_unit_test(test_quality_comes_back_saturated),
        cmocka_unit_test(test_time_comes_back_rounded_and_saturated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
