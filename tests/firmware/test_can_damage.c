// SPDX-License-Identifier: Apache-2.0
// Tests of the decoders with damaged and misplaced frames: every single-bit error, wrong kinds, mixed sets.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "tests/support/random_pose.h"

static const uint64_t SEED = 20240131;

static const can_heartbeat_t HEARTBEAT = {
    .node = 63, .counter = 14, .state = CAN_BOARD_RUNNING, .frame_number = 0x1234};
static const can_status_t STATUS = {.node = 1, .counter = 3, .step_q8 = 700, .warp_time_us = 12300};
static const can_stage_t STAGE_SENT = {.node = 1, .counter = 3, .stage = STAGE_WARP, .mean_us = 12300, .shown = 60};
static const can_quality_t QUALITY_SENT = {
    .node = 1, .counter = 3, .step = 2, .resampler = WARP_LINEAR, .changes = 9, .hold_s = 8};
static const can_time_t TIME_SENT = {.node = 1, .counter = 3, .state = CAN_TIME_LOCKED, .drift_ppb = -51000};
static const can_sync_t SYNC_SENT = {.number = 1, .counter = 3};
static const can_follow_up_t FOLLOW_UP_SENT = {.number = 1, .counter = 3, .time_us = 12345678901234};

typedef enum { SET_A, SET_B, SET_C, FD, HEART, STAT, STAGE, QUALITY, TIME, SYNC, FOLLOW_UP, MESSAGES } message_t;

static void encode_one(hal_can_frame_t *frame, message_t message, const can_pose_t *pose)
{
    hal_can_frame_t part[CAN_POSE_PARTS];
    switch (message) {
    case SET_A:
    case SET_B:
    case SET_C:
        assert_true(can_pose_set_encode(part, pose));
        *frame = part[message];
        break;
    case FD:
        assert_true(can_pose_fd_encode(frame, pose));
        break;
    case HEART:
        assert_true(can_heartbeat_encode(frame, &HEARTBEAT));
        break;
    case STAT:
        assert_true(can_status_encode(frame, &STATUS));
        break;
    case STAGE:
        assert_true(can_stage_encode(frame, &STAGE_SENT));
        break;
    case QUALITY:
        assert_true(can_quality_encode(frame, &QUALITY_SENT));
        break;
    case TIME:
        assert_true(can_time_encode(frame, &TIME_SENT));
        break;
    case SYNC:
        assert_true(can_sync_encode(frame, &SYNC_SENT));
        break;
    case FOLLOW_UP:
    case MESSAGES:
        assert_true(can_follow_up_encode(frame, &FOLLOW_UP_SENT));
        break;
    }
}

/* With every decoder there is. */
static can_check_t decode_any(const hal_can_frame_t *frame, uint8_t viewer)
{
    int part = 0;
    uint8_t counter = 0;
    can_pose_t pose;
    can_heartbeat_t heartbeat;
    can_status_t status;
    can_stage_t stage;
    can_quality_t quality;
    can_time_t time;
    can_sync_t sync;
    can_follow_up_t follow_up;
    const can_check_t check[] = {can_pose_part_check(frame, viewer, &part, &counter),
                                 can_pose_fd_decode(&pose, frame, viewer),
                                 can_heartbeat_decode(&heartbeat, frame),
                                 can_status_decode(&status, frame),
                                 can_stage_decode(&stage, frame),
                                 can_quality_decode(&quality, frame),
                                 can_time_decode(&time, frame),
                                 can_sync_decode(&sync, frame),
                                 can_follow_up_decode(&follow_up, frame)};
    for (size_t i = 0; i < sizeof check / sizeof check[0]; i++)
        if (check[i] != CAN_CHECK_OTHER)
            return check[i];
    return CAN_CHECK_OTHER;
}

static void test_every_single_bit_error_is_refused(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    for (int round = 0; round < 20; round++) {
        const can_pose_t pose = random_pose(&rng, INT64_C(80000000000), CAN_E2E_P01_COUNTERS);
        for (message_t message = SET_A; message < MESSAGES; message++) {
            hal_can_frame_t frame;
            encode_one(&frame, message, &pose);
            assert_int_equal(decode_any(&frame, pose.viewer), CAN_CHECK_OK);
            for (int bit = 0; bit < 8 * frame.length; bit++) {
                hal_can_frame_t bad = frame;
                bad.data[bit / 8] = (uint8_t)(bad.data[bit / 8] ^ (1 << (bit % 8)));
                if (decode_any(&bad, pose.viewer) != CAN_CHECK_CRC)
                    fail_msg("seed %llu round %d: message %d, bit %d flipped was not seen", (unsigned long long)SEED,
                             round, (int)message, bit);
            }
            for (int bit = 0; bit < 11; bit++) {
                hal_can_frame_t bad = frame;
                bad.id ^= 1U << bit;
                if (decode_any(&bad, pose.viewer) == CAN_CHECK_OK)
                    fail_msg("seed %llu round %d: message %d, identifier bit %d flipped was not seen",
                             (unsigned long long)SEED, round, (int)message, bit);
            }
        }
    }
}

static void test_wrong_kind_and_length_are_refused(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    const can_pose_t pose = random_pose(&rng, 1000000, CAN_E2E_P01_COUNTERS);
    for (message_t message = SET_A; message < MESSAGES; message++) {
        hal_can_frame_t frame;
        encode_one(&frame, message, &pose);
        hal_can_frame_t bad = frame;
        bad.extended = true;
        assert_int_equal(decode_any(&bad, pose.viewer), CAN_CHECK_OTHER);
        bad = frame;
        bad.fd = !bad.fd;
        assert_int_equal(decode_any(&bad, pose.viewer), CAN_CHECK_LENGTH);
        for (int length = 0; length <= HAL_CAN_MAX_LENGTH; length++) {
            bad = frame;
            bad.length = (uint8_t)length;
            if (length != frame.length)
                assert_int_equal(decode_any(&bad, pose.viewer), CAN_CHECK_LENGTH);
        }
    }
}

static void sign_p01(hal_can_frame_t *frame)
{
    frame->data[0] = can_e2e_p01_crc((uint16_t)frame->id, frame->data, 8);
}

static void test_reserved_values_under_a_right_crc_are_refused(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    const can_pose_t pose = random_pose(&rng, 1000000, CAN_E2E_P01_COUNTERS);
    hal_can_frame_t part[CAN_POSE_PARTS];
    can_pose_t got = {.counter = 77};
    assert_true(can_pose_set_encode(part, &pose));
    part[0].data[1] = (uint8_t)((part[0].data[1] & 0x0F) | 0x30); /* quality 3 */
    sign_p01(&part[0]);
    assert_int_equal(can_pose_set_decode(&got, part, pose.viewer), CAN_CHECK_VALUE);
    for (int i = 0; i < CAN_POSE_PARTS; i++) {
        part[i].data[1] |= 0x0F; /* counter 15 */
        sign_p01(&part[i]);
    }
    assert_int_equal(can_pose_set_decode(&got, part, pose.viewer), CAN_CHECK_COUNTER);

    hal_can_frame_t frame;
    assert_true(can_pose_fd_encode(&frame, &pose));
    frame.data[3] = 0x03;
    const uint16_t crc = can_e2e_p05_crc((uint16_t)frame.id, frame.data, 32);
    frame.data[0] = (uint8_t)(crc & 0xFF);
    frame.data[1] = (uint8_t)(crc >> 8);
    assert_int_equal(can_pose_fd_decode(&got, &frame, pose.viewer), CAN_CHECK_VALUE);
    assert_int_equal(got.counter, 77);

    can_heartbeat_t heartbeat = {.node = 77};
    assert_true(can_heartbeat_encode(&frame, &HEARTBEAT));
    frame.data[1] = 0x7E; /* state 7 */
    sign_p01(&frame);
    assert_int_equal(can_heartbeat_decode(&heartbeat, &frame), CAN_CHECK_VALUE);
    assert_int_equal(heartbeat.node, 77);

    can_stage_t stage = {.node = 77};
    assert_true(can_stage_encode(&frame, &STAGE_SENT));
    frame.data[1] = 0x43; /* stage 4 */
    sign_p01(&frame);
    assert_int_equal(can_stage_decode(&stage, &frame), CAN_CHECK_VALUE);
    assert_int_equal(stage.node, 77);

    static const uint8_t reserved[3][2] = {{0x53, 0x01}, {0x23, 0x09}, {0x23, 0x40}}; /* step, resampler, filter */
    can_quality_t quality = {.node = 77};
    assert_true(can_quality_encode(&frame, &QUALITY_SENT));
    for (int i = 0; i < 3; i++) {
        memcpy(frame.data + 1, reserved[i], 2);
        sign_p01(&frame);
        assert_int_equal(can_quality_decode(&quality, &frame), CAN_CHECK_VALUE);
        assert_int_equal(quality.node, 77);
    }
}

static void test_reserved_values_of_bus_time_under_a_right_crc_are_refused(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_time_t time = {.node = 77};
    assert_true(can_time_encode(&frame, &TIME_SENT));
    frame.data[1] = 0x43; /* state 4 */
    sign_p01(&frame);
    assert_int_equal(can_time_decode(&time, &frame), CAN_CHECK_VALUE);
    assert_true(can_time_encode(&frame, &TIME_SENT));
    frame.data[4] = 0x00; /* the drift that has no opposite */
    frame.data[5] = 0x20;
    sign_p01(&frame);
    assert_int_equal(can_time_decode(&time, &frame), CAN_CHECK_VALUE);
    assert_int_equal(time.node, 77);

    can_sync_t sync = {.number = 77};
    assert_true(can_sync_encode(&frame, &SYNC_SENT));
    frame.data[2] = 0x04; /* origin 64 */
    sign_p01(&frame);
    assert_int_equal(can_sync_decode(&sync, &frame), CAN_CHECK_VALUE);
    assert_int_equal(sync.number, 77);
}

static void test_parts_of_different_sets_and_wrong_order_are_refused(void **state)
{
    (void)state;
    rng_t rng = {.state = SEED};
    can_pose_t pose = random_pose(&rng, 1000000, CAN_E2E_P01_COUNTERS);
    pose.counter = 4;
    hal_can_frame_t one[CAN_POSE_PARTS];
    hal_can_frame_t two[CAN_POSE_PARTS];
    can_pose_t got;
    assert_true(can_pose_set_encode(one, &pose));
    pose.counter = 5;
    assert_true(can_pose_set_encode(two, &pose));
    for (int i = 0; i < CAN_POSE_PARTS; i++) {
        hal_can_frame_t mixed[CAN_POSE_PARTS];
        memcpy(mixed, one, sizeof mixed);
        mixed[i] = two[i];
        assert_int_equal(can_pose_set_decode(&got, mixed, pose.viewer), CAN_CHECK_COUNTER);
        mixed[i] = one[(i + 1) % CAN_POSE_PARTS];
        assert_int_equal(can_pose_set_decode(&got, mixed, pose.viewer), CAN_CHECK_OTHER);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_single_bit_error_is_refused),
        cmocka_unit_test(test_wrong_kind_and_length_are_refused),
        cmocka_unit_test(test_reserved_values_under_a_right_crc_are_refused),
        cmocka_unit_test(test_reserved_values_of_bus_time_under_a_right_crc_are_refused),
        cmocka_unit_test(test_parts_of_different_sets_and_wrong_order_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
