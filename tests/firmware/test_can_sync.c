// SPDX-License-Identifier: Apache-2.0
// Tests of the messages that carry bus time: what is encoded comes back, and what does not fit is refused.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"

static void test_sync_comes_back(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_sync_t got;
    for (int number = 0; number <= CAN_MAX_NODE; number++) {
        const can_sync_t sync = {
            .number = (uint8_t)number, .counter = (uint8_t)(number % 15), .origin = (uint8_t)(CAN_MAX_NODE - number)};
        assert_true(can_sync_encode(&frame, &sync));
        assert_int_equal(frame.id, 0x40 + number);
        assert_true(frame.id < CAN_ID_POSE_FD);
        assert_int_equal(can_sync_decode(&got, &frame), CAN_CHECK_OK);
        assert_int_equal(got.number, number);
        assert_int_equal(got.counter, number % 15);
        assert_int_equal(got.origin, CAN_MAX_NODE - number);
    }
    assert_false(can_sync_encode(&frame, &(can_sync_t){.number = 64}));
    assert_false(can_sync_encode(&frame, &(can_sync_t){.counter = 15}));
    assert_false(can_sync_encode(&frame, &(can_sync_t){.origin = 64}));
}

static void test_follow_up_comes_back(void **state)
{
    (void)state;
    static const uint64_t TIME_US[] = {0, 1, UINT32_MAX, UINT64_C(1) << 32, 0x89ABCDEF0123, 0xFFFFFFFFFFFF};
    hal_can_frame_t frame;
    can_follow_up_t got;
    for (size_t i = 0; i < sizeof TIME_US / sizeof TIME_US[0]; i++) {
        const can_follow_up_t follow_up = {.number = 63, .counter = 14, .time_us = TIME_US[i]};
        assert_true(can_follow_up_encode(&frame, &follow_up));
        assert_int_equal(frame.id, 0xBF);
        assert_int_equal(can_follow_up_decode(&got, &frame), CAN_CHECK_OK);
        assert_int_equal(got.number, 63);
        assert_int_equal(got.counter, 14);
        assert_true(got.time_us == TIME_US[i]);
    }
    assert_false(can_follow_up_encode(&frame, &(can_follow_up_t){.time_us = UINT64_C(1) << 48}));
    assert_false(can_follow_up_encode(&frame, &(can_follow_up_t){.number = 64}));
    assert_false(can_follow_up_encode(&frame, &(can_follow_up_t){.counter = 15}));
}

static void test_neither_is_the_other(void **state)
{
    (void)state;
    hal_can_frame_t sync, follow_up;
    can_sync_t got_sync;
    can_follow_up_t got_follow_up;
    assert_true(can_sync_encode(&sync, &(can_sync_t){.number = 63}));
    assert_true(can_follow_up_encode(&follow_up, &(can_follow_up_t){.number = 0}));
    assert_int_equal(can_sync_decode(&got_sync, &follow_up), CAN_CHECK_OTHER);
    assert_int_equal(can_follow_up_decode(&got_follow_up, &sync), CAN_CHECK_OTHER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sync_comes_back),
        cmocka_unit_test(test_follow_up_comes_back),
        cmocka_unit_test(test_neither_is_the_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
