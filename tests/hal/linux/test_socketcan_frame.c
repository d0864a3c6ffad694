// SPDX-License-Identifier: Apache-2.0
// Frames to SocketCAN and back, illegal ones refused, and what error frames say.
#include "hal/linux/socketcan_frame.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <linux/can/error.h>
#include <string.h>

static hal_can_frame_t frame_of(uint32_t id, bool extended, bool fd, uint8_t length)
{
    hal_can_frame_t frame = {.id = id, .extended = extended, .fd = fd, .bit_rate_switch = fd, .length = length};
    for (uint8_t i = 0; i < length && i < HAL_CAN_MAX_LENGTH; i++)
        frame.data[i] = (uint8_t)(0xA0 + i);
    return frame;
}

static void legal_frames_come_back_the_same(void **state)
{
    (void)state;
    static const uint8_t lengths[] = {0, 1, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    static const uint32_t ids[2][3] = {{0, 0x123, 0x7FF}, {0, 0x12345678, 0x1FFFFFFF}};
    for (int n = 0; n < 11 * 3 * 2 * 2; n++) {
        const bool extended = n % 2, fd = n / 2 % 2;
        const hal_can_frame_t sent = frame_of(ids[extended][n / 4 % 3], extended, fd, lengths[n / 12]);
        struct canfd_frame raw;
        hal_can_frame_t received = {.time_us = 42, .own = true};
        const size_t size = socketcan_frame_pack(&raw, &sent, true);
        if (sent.length > 8 && !fd) {
            assert_int_equal(size, 0);
            continue;
        }
        assert_int_equal(size, fd ? CANFD_MTU : CAN_MTU);
        assert_true(socketcan_frame_unpack(&received, &raw, size));
        assert_int_equal(received.id, sent.id);
        assert_int_equal(received.extended, sent.extended);
        assert_int_equal(received.fd, sent.fd);
        assert_int_equal(received.bit_rate_switch, sent.bit_rate_switch);
        assert_int_equal(received.length, sent.length);
        assert_memory_equal(received.data, sent.data, sent.length);
        assert_int_equal(received.time_us, 42);
        assert_true(received.own);
    }
}

static void flags_are_where_the_kernel_looks_for_them(void **state)
{
    (void)state;
    struct canfd_frame raw;
    hal_can_frame_t frame = frame_of(0x12345678, true, true, 12);
    assert_int_equal(socketcan_frame_pack(&raw, &frame, true), CANFD_MTU);
    assert_int_equal(raw.can_id, 0x12345678 | CAN_EFF_FLAG);
    assert_int_equal(raw.flags, CANFD_BRS);
    frame.bit_rate_switch = false;
    assert_int_equal(socketcan_frame_pack(&raw, &frame, true), CANFD_MTU);
    assert_int_equal(raw.flags, 0);
    frame = frame_of(0x123, false, false, 8);
    frame.bit_rate_switch = true; /* of no meaning in a classic frame */
    assert_int_equal(socketcan_frame_pack(&raw, &frame, true), CAN_MTU);
    assert_int_equal(raw.can_id, 0x123);
    assert_int_equal(raw.flags, 0);
}

static void illegal_frames_are_not_sent(void **state)
{
    (void)state;
    static const struct canfd_frame untouched = {.can_id = 0xA5A5A5A5};
    const hal_can_frame_t wrong[] = {
        frame_of(0x800, false, false, 8),     frame_of(0xFFFFFFFF, false, false, 0),
        frame_of(0x20000000, true, false, 8), frame_of(0x1FFFFFFF | CAN_EFF_FLAG, true, false, 8),
        frame_of(1, false, false, 9),         frame_of(1, false, true, 9),
        frame_of(1, false, true, 28),         frame_of(1, false, true, 40),
        frame_of(1, false, true, 63),         frame_of(1, false, true, 65),
        frame_of(1, false, true, 255),
    };
    struct canfd_frame raw = untouched;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(socketcan_frame_pack(&raw, &wrong[i], true), 0);
    const hal_can_frame_t fd = frame_of(1, false, true, 8);
    assert_int_equal(socketcan_frame_pack(&raw, &fd, false), 0);
    assert_memory_equal(&raw, &untouched, sizeof raw);
}

static void what_is_no_data_frame_is_not_delivered(void **state)
{
    (void)state;
    static const struct {
        uint32_t id;
        uint8_t length;
        size_t size;
    } wrong[] = {
        {0x123 | CAN_RTR_FLAG, 4, CAN_MTU},
        {0x12345678 | CAN_EFF_FLAG | CAN_RTR_FLAG, 0, CAN_MTU},
        {CAN_ERR_FLAG | CAN_ERR_BUSOFF, 8, CAN_MTU},
        {0x123, 9, CAN_MTU},
        {0x123, 65, CANFD_MTU},
        {0x123, 13, CANFD_MTU},
        {0x123, 8, CAN_MTU - 1},
        {0x123, 8, 0},
    };
    static const hal_can_frame_t untouched = {.id = 0xA5};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const struct canfd_frame raw = {.can_id = wrong[i].id, .len = wrong[i].length};
        hal_can_frame_t frame = untouched;
        assert_false(socketcan_frame_unpack(&frame, &raw, wrong[i].size));
        assert_memory_equal(&frame, &untouched, sizeof frame);
    }
}

static void error_frames_tell_states(void **state)
{
    (void)state;
    static const struct {
        uint32_t id;
        uint8_t detail;
        socketcan_error_t said;
    } cases[] = {
        {CAN_ERR_FLAG | CAN_ERR_BUSOFF, 0, {true, HAL_CAN_BUS_OFF, false}},
        {CAN_ERR_FLAG | CAN_ERR_BUSOFF | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, {true, HAL_CAN_BUS_OFF, false}},
        {CAN_ERR_FLAG | CAN_ERR_RESTARTED, 0, {true, HAL_CAN_ERROR_ACTIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, {true, HAL_CAN_ERROR_PASSIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE, {true, HAL_CAN_ERROR_PASSIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL,
         CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_WARNING,
         {true, HAL_CAN_ERROR_PASSIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING, {true, HAL_CAN_ERROR_ACTIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE, {true, HAL_CAN_ERROR_ACTIVE, false}},
        {CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW, {false, HAL_CAN_ERROR_ACTIVE, true}},
        {CAN_ERR_FLAG | CAN_ERR_ACK, CAN_ERR_CRTL_TX_PASSIVE, {false, HAL_CAN_ERROR_ACTIVE, false}},
        {CAN_ERR_BUSOFF, CAN_ERR_CRTL_TX_PASSIVE, {false, HAL_CAN_ERROR_ACTIVE, false}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct canfd_frame raw = {.can_id = cases[i].id, .len = 8, .data = {0, cases[i].detail}};
        const socketcan_error_t said = socketcan_frame_error(&raw, CAN_MTU);
        assert_int_equal(said.any_state, cases[i].said.any_state);
        assert_int_equal(said.state, cases[i].said.state);
        assert_int_equal(said.overrun, cases[i].said.overrun);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legal_frames_come_back_the_same), cmocka_unit_test(flags_are_where_the_kernel_looks_for_them),
        cmocka_unit_test(illegal_frames_are_not_sent),     cmocka_unit_test(what_is_no_data_frame_is_not_delivered),
        cmocka_unit_test(error_frames_tell_states),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
