// SPDX-License-Identifier: Apache-2.0
// Tests of contents that are held back: targets, lags and what comes of a wish; boards agree through every change.
#include "firmware/frame_latency.h"
#include "firmware/picture_lag.h"
#include "tests/firmware/frame_clock_bench.h"

enum { PERIOD_US = 16667, SETTLE = 60 * 6 };

static const frame_rate_t rate_60 = {60, 1};

static void set_display(room_t *room, int board, int32_t display_us)
{
    room->board[board].clock.display_us = display_us;
}

static int32_t held(const room_t *room, int board)
{
    return room->board[board].step.held;
}

/* With 0 and 40 ms the quick ones wait for two refreshes, 33 ms, when somebody wishes so. */
static void test_a_wish_of_any_board_counts(void **state)
{
    (void)state;
    room_t *room = new_room(1, rate_60);
    set_display(room, 3, 40000);
    (void)run(room, SETTLE);
    assert_int_equal(held(room, 0), 0);
    room->board[6].wanted_ms = 1;
    (void)run(room, SETTLE);
    assert_int_equal(run(room, 60), BOARDS);
    for (int i = 0; i < BOARDS; i++) {
        assert_int_equal(held(room, i), i == 3 ? 0 : 2);
        assert_int_equal(room->board[i].clock.now.target_ms, 40);
    }
    /* 2 + 25 + 52 ms: now the slowest waits for one as well */
    room->board[2].wanted_ms = 79;
    (void)run(room, SETTLE);
    assert_int_equal(room->board[7].clock.now.target_ms, 52);
    assert_true(held(room, 0) == 3 && held(room, 3) == 1);
    room->board[2].wanted_ms = room->board[6].wanted_ms = 0;
    (void)run(room, SETTLE);
    assert_true(held(room, 0) == 0 && held(room, 3) == 0);
    assert_int_equal(run(room, 60), BOARDS);
}

/* Panels that drift, losses, a leader that goes, wishes and cameras that change: contents stay everybody's. */
static void test_contents_are_everybodys(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 600; seed++) {
        room_t *room = new_room(seed, rate_60);
        int64_t in_step = 0;
        room->drift_ppm = (int32_t)between(&room->rng, -50, 50);
        room->loss_ppm = 10000;
        for (int i = 0; i < BOARDS; i++)
            set_display(room, i, (int32_t)between(&room->rng, 0, 100) * 500);
        (void)run(room, SETTLE);
        for (int change = 0; change < 8; change++) {
            const int board = (int)between(&room->rng, 0, BOARDS - 1);
            room->board[board].wanted_ms = (int32_t)between(&room->rng, 0, 1) * (int32_t)between(&room->rng, 1, 80);
            room->board[(board + 1) % BOARDS].late_us = (int32_t)between(&room->rng, 0, 3) * 10 * MS;
            room->board[0].absent = between(&room->rng, 0, 3) == 0;
            const int refreshes = (int)between(&room->rng, 10, 2 * SETTLE);
            (void)run(room, refreshes);
            room->board[0].absent = false;
        }
        (void)run(room, SETTLE);
        for (int i = 0; i < 60; i++) {
            refresh(room);
            in_step += boards_in_step(room);
        }
        if (in_step < 60 * (BOARDS - 1))
            fail_msg("seed %llu: %lld boards in step in 60 refreshes", (unsigned long long)seed, (long long)in_step);
    }
}

/* The lag is the slowest camera's; a board that is gone asks for nothing after a while. */
static void test_the_slowest_camera_counts(void **state)
{
    (void)state;
    room_t *room = new_room(2, rate_60);
    (void)run(room, SETTLE);
    room->board[5].late_us = 17 * MS;
    (void)run(room, SETTLE);
    const int32_t lag_us = room->board[1].clock.now.lag_us;
    assert_in_range(lag_us, 37 * MS - 200, 37 * MS + 200);
    assert_int_equal(run(room, 60), BOARDS);
    room->board[5].absent = true;
    (void)run(room, SETTLE / 2);
    assert_int_equal(room->board[1].clock.now.lag_us, lag_us);
    (void)run(room, SETTLE);
    assert_in_range(room->board[1].clock.now.lag_us, 20 * MS - 200, 20 * MS + 200);
}

static void test_what_comes_of_a_wish(void **state)
{
    (void)state;
    room_t *room = new_room(3, rate_60);
    set_display(room, 3, 40000);
    set_display(room, 4, 10000);
    (void)run(room, SETTLE);
    const hal_can_t *board = &room->board[4];
    const int64_t now_us = room->blank_us + board->offset_us;
    frame_latency_t found = frame_latency_of_wish(&board->clock, 0, now_us);
    const int32_t base_us = DELAY_US + PERIOD_US * 3 / 2;
    assert_int_equal(found.will_us, base_us + 10000);
    assert_int_equal(found.least_us, base_us + 40000);
    assert_int_equal(found.most_us, base_us + 3 * PERIOD_US + PERIOD_US / 2); /* board 1 takes no time */
    found = frame_latency_of_wish(&board->clock, 1, now_us);
    assert_true(found.possible);
    assert_int_equal(found.will_us, base_us + 10000 + 2 * PERIOD_US);
    assert_true(frame_latency_of_wish(&board->clock, 85, now_us).possible);
    assert_false(frame_latency_of_wish(&board->clock, 86, now_us).possible);
}

/* Pictures that come with the blanks need their age; others the least age and a quarter of a period. */
static void test_lag_of_a_camera(void **state)
{
    (void)state;
    picture_lag_t lag = {.lag_us = 0};
    picture_lag_add(&lag, 21000, PERIOD_US);
    assert_int_equal(lag.lag_us, 21000);
    for (int i = 0; i < PICTURE_LAG_PICTURES - 1; i++)
        picture_lag_add(&lag, 20900 + i % 2 * 200, PERIOD_US);
    assert_int_equal(lag.lag_us, 21100);
    for (int i = 0; i < 2 * PICTURE_LAG_PICTURES; i++)
        picture_lag_add(&lag, 5000 + i % 5 * 3300, PERIOD_US);
    assert_int_equal(lag.lag_us, 5000 + PERIOD_US / 4);
    for (int i = 0; i < 2 * PICTURE_LAG_PICTURES; i++)
        picture_lag_add(&lag, -3, PERIOD_US);
    assert_int_equal(lag.lag_us, 1);
}

static void test_message(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_latency_t latency = {.node = 63,
                             .counter = 14,
                             .fault = CAN_STEP_NOT_SHOWN,
                             .held = 7,
                             .genlocked = true,
                             .lag_us = UINT32_MAX,
                             .display_us = UINT32_MAX,
                             .wanted_ms = UINT32_MAX,
                             .photon_us = UINT32_MAX,
                             .off_us = INT32_MIN};
    can_latency_t heard;
    assert_true(can_latency_encode(&frame, &latency));
    assert_int_equal(frame.id, 0x57F);
    assert_int_equal(can_latency_decode(&heard, &frame), CAN_CHECK_OK);
    assert_true(heard.node == 63 && heard.counter == 14 && heard.fault == CAN_STEP_NOT_SHOWN && heard.held == 7);
    assert_true(heard.genlocked && heard.lag_us == 65472 && heard.display_us == 255500 && heard.wanted_ms == 255);
    assert_true(heard.photon_us == 255750 && heard.off_us == -8064);
    latency.off_us = INT32_MAX;
    latency.lag_us = 64;
    assert_true(can_latency_encode(&frame, &latency));
    assert_int_equal(can_latency_decode(&heard, &frame), CAN_CHECK_OK);
    assert_true(heard.off_us == 8064 && heard.lag_us == 64);
    frame.data[3] ^= 4;
    assert_int_equal(can_latency_decode(&heard, &frame), CAN_CHECK_CRC);
    frame.id = 0x540;
    assert_int_equal(can_latency_decode(&heard, &frame), CAN_CHECK_OTHER);
    assert_false(can_latency_encode(&frame, &(can_latency_t){.node = 0}));
    assert_false(can_latency_encode(&frame, &(can_latency_t){.node = 1, .held = 8}));
    assert_false(can_latency_encode(&frame, &(can_latency_t){.node = 1, .fault = (can_step_fault_t)7}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_wish_of_any_board_counts),
        cmocka_unit_test(test_contents_are_everybodys),
        cmocka_unit_test(test_the_slowest_camera_counts),
        cmocka_unit_test(test_what_comes_of_a_wish),
        cmocka_unit_test(test_lag_of_a_camera),
        cmocka_unit_test(test_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
