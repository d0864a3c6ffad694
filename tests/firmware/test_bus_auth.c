// SPDX-License-Identifier: Apache-2.0
// Tests of what a board with a key believes: frames that wait for their code, damaged and missing ones, sessions.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/bus_auth.h"
#include "firmware/can_frame_clock.h"
#include "firmware/command.h"
#include "tests/support/auth_frames.h"

enum { VIEWER = 2, SET_ID = CAN_ID_POSE_SET + 4 * VIEWER, T0 = 1000000, SEED = 9 };

static can_auth_t *key;
static bus_auth_t board;
static can_faults_t faults;
static can_auth_fresh_t fresh;
static hal_can_frame_t believed[CAN_AUTH_MAX_FRAMES];

/* A board with a session, whose clock shows bus time. */
static int begin(void **state)
{
    (void)state;
    key = can_auth_open(&AUTH_KEY);
    assert_non_null(key);
    bus_auth_init(&board, key, VIEWER, SEED);
    bus_auth_begin_session(&board, AUTH_SESSION, T0, T0);
    faults = (can_faults_t){.length = 0};
    fresh = (can_auth_fresh_t){AUTH_SESSION, T0};
    return 0;
}

static int end(void **state)
{
    (void)state;
    can_auth_close(key);
    return 0;
}

static int hear(const hal_can_frame_t *frame, int64_t now_us)
{
    hal_can_frame_t stamped = *frame;
    stamped.time_us = now_us;
    return bus_auth_take(&board, &stamped, believed, &faults);
}

/* @return The frame behind these. */
static hal_can_frame_t code_of(const hal_can_frame_t *frame, int frames, uint32_t id, int64_t now_us)
{
    hal_can_frame_t tag;
    const can_auth_message_t message = {frame, frames, id};
    can_auth_fresh_step(&fresh, (uint64_t)now_us);
    assert_true(can_auth_sign(key, fresh, &message, &tag));
    return tag;
}

static void make_set(hal_can_frame_t part[CAN_POSE_PARTS + 1], int counter, int64_t now_us)
{
    const can_pose_t pose = {.pose = {.quaternion_q30 = {1 << 30, 0, 0, 0}},
                             .quality = CAN_POSE_TRACKED,
                             .viewer = VIEWER,
                             .counter = (uint8_t)counter};
    assert_true(can_pose_set_encode(part, &pose));
    part[CAN_POSE_PARTS] = code_of(part, CAN_POSE_PARTS, SET_ID + CAN_POSE_PARTS, now_us);
}

static void test_a_set_waits_for_its_code(void **state)
{
    (void)state;
    hal_can_frame_t part[CAN_POSE_PARTS + 1];
    make_set(part, 3, T0 + 10);
    for (int p = 0; p < CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 100 + p), 0);
    assert_int_equal(hear(&part[CAN_POSE_PARTS], T0 + 200), CAN_POSE_PARTS);
    for (int p = 0; p < CAN_POSE_PARTS; p++) {
        assert_int_equal(believed[p].id, SET_ID + p);
        assert_int_equal(believed[p].time_us, T0 + 100 + p); /* their own stamps */
        assert_memory_equal(believed[p].data, part[p].data, 8);
    }
    assert_int_equal(hear(&part[CAN_POSE_PARTS], T0 + 300), 0); /* the code alone */
    assert_int_equal(faults.incomplete_set, 1);
    for (int p = 0; p <= CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 400 + p), 0);
    assert_int_equal(faults.auth_replayed, 1);
    assert_int_equal(can_faults_refused(&faults), 1);
}

/* Every frame of a message is lost once: the next message is believed. */
static void test_what_is_lost_costs_one_message(void **state)
{
    (void)state;
    for (int lost = 0; lost <= CAN_POSE_PARTS; lost++) {
        hal_can_frame_t part[CAN_POSE_PARTS + 1];
        const int64_t now_us = T0 + 10000 * (lost + 1);
        make_set(part, 2 * lost, now_us);
        for (int p = 0; p <= CAN_POSE_PARTS; p++)
            assert_int_equal(p == lost ? 0 : hear(&part[p], now_us), 0);
        make_set(part, 2 * lost + 1, now_us + 4000);
        for (int p = 0; p < CAN_POSE_PARTS; p++)
            assert_int_equal(hear(&part[p], now_us + 4000), 0);
        assert_int_equal(hear(&part[CAN_POSE_PARTS], now_us + 4000), CAN_POSE_PARTS);
    }
    assert_int_equal(faults.incomplete_set, CAN_POSE_PARTS);
    assert_int_equal(faults.auth_lost, 1);
    assert_int_equal(can_faults_refused(&faults), 0);
}

static void test_every_bit_counts(void **state)
{
    (void)state;
    for (int bit = 0; bit < 64 * (CAN_POSE_PARTS + 1); bit++) {
        hal_can_frame_t part[CAN_POSE_PARTS + 1];
        make_set(part, 1, T0 + 100 * (bit + 1));
        part[bit / 64].data[bit % 64 / 8] ^= (uint8_t)(1 << bit % 8);
        for (int p = 0; p <= CAN_POSE_PARTS; p++)
            assert_int_equal(hear(&part[p], T0 + 100 * (bit + 1)), 0);
    }
    assert_int_equal(faults.auth_forged, 64 * (CAN_POSE_PARTS + 1));
}

static void test_fd_poses_lose_their_code(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    const can_pose_t pose = {
        .pose = {.quaternion_q30 = {1 << 30, 0, 0, 0}}, .quality = CAN_POSE_TRACKED, .viewer = VIEWER, .counter = 200};
    assert_true(can_pose_fd_encode(&frame, &pose));
    const hal_can_frame_t plain = frame;
    assert_int_equal(hear(&plain, T0 + 5), 0);
    assert_int_equal(faults.auth_unsigned, 1);
    can_auth_fresh_step(&fresh, T0 + 10);
    assert_true(can_auth_sign_fd(key, fresh, &frame));
    frame.id = CAN_AUTH_ID_POSE_FD + VIEWER;
    assert_int_equal(hear(&frame, T0 + 20), 1);
    can_pose_t read;
    assert_int_equal(can_pose_fd_decode(&read, &believed[0], VIEWER), CAN_CHECK_OK);
    assert_int_equal(read.counter, 200);
    assert_int_equal(hear(&frame, T0 + 30), 0);
    assert_int_equal(faults.auth_replayed, 1);
    frame.id = CAN_AUTH_ID_POSE_FD + VIEWER - 1; /* of another viewer: not ours to judge */
    assert_int_equal(hear(&frame, T0 + 30), 1);
    assert_int_equal(can_faults_refused(&faults), 2);
}

static void test_pairs_of_each_number_by_themselves(void **state)
{
    (void)state;
    hal_can_frame_t pair[2][2], tag[2];
    for (uint8_t n = 0; n < 2; n++) {
        assert_true(can_sync_encode(&pair[n][0], &(can_sync_t){.number = (uint8_t)(7 * n)}));
        assert_true(can_follow_up_encode(&pair[n][1], &(can_follow_up_t){.number = (uint8_t)(7 * n), .time_us = T0}));
        tag[n] = code_of(pair[n], 2, CAN_AUTH_ID_TIME + 7U * n, T0 + 10);
    }
    for (int f = 0; f < 2; f++)
        for (int n = 0; n < 2; n++)
            assert_int_equal(hear(&pair[n][f], T0 + 20), 0);
    assert_int_equal(hear(&tag[1], T0 + 30), 2);
    assert_int_equal(believed[0].id, CAN_ID_SYNC + 7);
    assert_int_equal(believed[1].id, CAN_ID_FOLLOW_UP + 7);
    assert_int_equal(hear(&tag[0], T0 + 30), 2);
    assert_int_equal(hear(&pair[0][0], T0 + 40), 0); /* a claim: Syncs alone, which nobody hears and nobody minds */
    assert_int_equal(hear(&pair[0][0], T0 + 50), 0);
    assert_int_equal(can_faults_total(&faults), 0);
    assert_int_equal(hear(&pair[0][1], T0 + 60), 0);
    for (int f = 0; f < 2; f++)
        assert_int_equal(hear(&pair[0][f], T0 + 70), 0); /* a pair without a code */
    const hal_can_frame_t code = code_of(pair[0], 2, CAN_AUTH_ID_TIME, T0 + 80);
    assert_int_equal(hear(&code, T0 + 80), 2);
    assert_int_equal(faults.auth_unsigned, 1);
}

static void test_frame_clocks_of_a_change_are_one_message(void **state)
{
    (void)state;
    hal_can_frame_t frame[2], alone, tag;
    const can_frame_clock_t to_come = {.node = 3, .counter = 1, .epoch = 5, .to_come = true};
    const can_frame_clock_t now = {.node = 3, .counter = 2, .epoch = 4, .changes = true};
    assert_true(can_frame_clock_encode(&frame[0], &to_come));
    assert_true(can_frame_clock_encode(&frame[1], &now));
    assert_true(can_frame_clock_encode(&alone, &(can_frame_clock_t){.node = 3, .counter = 3, .epoch = 4}));
    tag = code_of(frame, 2, CAN_AUTH_ID_FRAME_CLOCK + 3, T0 + 10);
    assert_int_equal(hear(&frame[0], T0 + 10), 0); /* and its code lost */
    assert_int_equal(hear(&frame[0], T0 + 20), 0);
    assert_int_equal(hear(&frame[1], T0 + 20), 0);
    assert_int_equal(hear(&tag, T0 + 20), 2);
    tag = code_of(frame, 2, CAN_AUTH_ID_FRAME_CLOCK + 3, T0 + 25); /* the first is lost */
    assert_int_equal(hear(&frame[1], T0 + 25), 0);
    assert_int_equal(hear(&tag, T0 + 25), 0);
    tag = code_of(&alone, 1, CAN_AUTH_ID_FRAME_CLOCK + 3, T0 + 30);
    assert_int_equal(hear(&alone, T0 + 30), 0);
    assert_int_equal(hear(&tag, T0 + 30), 1);
    assert_int_equal(believed[0].id, CAN_ID_FRAME_CLOCK + 3);
    assert_int_equal(hear(&alone, T0 + 40), 0); /* its code is lost, and the next message */
    tag = code_of(&frame[1], 1, CAN_AUTH_ID_FRAME_CLOCK + 3, T0 + 41 + BUS_AUTH_CODE_US);
    assert_int_equal(hear(&tag, T0 + 41 + BUS_AUTH_CODE_US), 0);
    assert_int_equal(can_faults_refused(&faults), 0);
    for (int i = 0; i < 10; i++) /* strangers' */
        assert_int_equal(hear(&frame[0], T0 + 40), 0);
    for (int i = 0; i < 10; i++)
        assert_int_equal(hear(&alone, T0 + 40), 0);
    assert_int_equal(faults.auth_unsigned, 8); /* the 9th may have lost its code */
}

static void test_what_needs_no_code_passes(void **state)
{
    (void)state;
    static const uint32_t id[] = {0x03F, 0x11C, 0x1C0, CAN_ID_STATUS + 1, CAN_ID_HEARTBEAT + 1, 0x605};
    for (size_t i = 0; i < sizeof id / sizeof id[0]; i++) {
        const hal_can_frame_t frame = {.id = id[i], .length = 8};
        assert_int_equal(hear(&frame, T0), 1);
        assert_int_equal(believed[0].id, id[i]);
    }
    const hal_can_frame_t own = {.id = CAN_ID_SYNC + 3, .length = 8, .own = true};
    assert_int_equal(hear(&own, T0), 1);
    const hal_can_frame_t wide = {.id = CAN_ID_SYNC, .length = 8, .extended = true};
    assert_int_equal(hear(&wide, T0), 1);
    const hal_can_frame_t fd = {.id = CAN_ID_SYNC, .length = 12, .fd = true};
    assert_int_equal(hear(&fd, T0), 0);
    assert_int_equal(faults.auth_unsigned, 1);
    bus_auth_init(&board, NULL, VIEWER, SEED);
    assert_int_equal(hear(&fd, T0), 1); /* no key */
}

static void test_sessions(void **state)
{
    (void)state;
    hal_can_frame_t part[CAN_POSE_PARTS + 1];
    bus_auth_init(&board, key, VIEWER, SEED);
    assert_true(bus_auth_wants_session(&board, T0));
    assert_false(bus_auth_may_speak(&board));
    make_set(part, 1, T0 + 10);
    for (int p = 0; p <= CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 10), 0);
    assert_int_equal(can_faults_refused(&faults), 0); /* it cannot judge, and says so otherwise */
    bus_auth_begin_session(&board, AUTH_SESSION, T0 + 100, T0 + 100);
    for (int p = 0; p <= CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 110), 0); /* from before */
    assert_int_equal(faults.auth_replayed, 1);
    assert_false(bus_auth_wants_session(&board, T0 + 100 + BUS_AUTH_SILENT_US));
    assert_true(bus_auth_wants_session(&board, T0 + 101 + BUS_AUTH_SILENT_US));
    make_set(part, 2, T0 + 200);
    for (int p = 0; p < CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 210), 0);
    assert_int_equal(hear(&part[CAN_POSE_PARTS], T0 + 210), CAN_POSE_PARTS);
    assert_false(bus_auth_wants_session(&board, T0 + 210 + BUS_AUTH_SILENT_US));
    bus_auth_begin_session(&board, AUTH_SESSION, T0 + 150, T0 + 150); /* told again, with a time of before */
    for (int p = 0; p <= CAN_POSE_PARTS; p++)
        assert_int_equal(hear(&part[p], T0 + 220), 0);
    assert_int_equal(faults.auth_replayed, 2);
}

static void test_numbers_for_commands(void **state)
{
    (void)state;
    static const uint8_t command[] = {COMMAND_FREEZE, 1};
    uint8_t bytes[sizeof command + CAN_AUTH_COMMAND_BYTES];
    memcpy(bytes, command, sizeof command);
    const uint64_t first = bus_auth_give_nonce(&board, T0), second = bus_auth_give_nonce(&board, T0);
    assert_int_not_equal(first, second);
    const can_auth_command_t plain = {0x605, command, sizeof command, second};
    assert_true(can_auth_sign_command(key, &plain, bytes + sizeof command));
    assert_int_equal(bus_auth_check_command(&board, 0x606, bytes, sizeof bytes, T0), 0); /* of another board; used up */
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, sizeof bytes, T0), 0);
    const int64_t late_us = T0 + BUS_AUTH_NONCE_US + 1;
    can_auth_command_t next = {0x605, command, sizeof command, bus_auth_give_nonce(&board, T0)};
    assert_true(can_auth_sign_command(key, &next, bytes + sizeof command));
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, sizeof bytes, late_us), 0);
    next.nonce = bus_auth_give_nonce(&board, T0);
    assert_true(can_auth_sign_command(key, &next, bytes + sizeof command));
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, sizeof bytes, late_us - 1), sizeof command);
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, sizeof bytes, late_us - 1), 0);
    (void)bus_auth_give_nonce(&board, T0);
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, CAN_AUTH_COMMAND_BYTES, T0),
                     0); /* a code of nothing */
    assert_int_equal(bus_auth_check_command(&board, 0x605, bytes, 1, T0), 0);
    bus_auth_init(&board, key, VIEWER, SEED + 1); /* another start: other numbers */
    const uint64_t third = bus_auth_give_nonce(&board, T0);
    assert_true(third != first && third != second);
}

#define TEST(test) cmocka_unit_test_setup_teardown(test, begin, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_a_set_waits_for_its_code),
        TEST(test_what_is_lost_costs_one_message),
        TEST(test_every_bit_counts),
        TEST(test_fd_poses_lose_their_code),
        TEST(test_pairs_of_each_number_by_themselves),
        TEST(test_frame_clocks_of_a_change_are_one_message),
        TEST(test_what_needs_no_code_passes),
        TEST(test_sessions),
        TEST(test_numbers_for_commands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
