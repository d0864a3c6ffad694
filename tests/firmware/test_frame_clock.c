// SPDX-License-Identifier: Apache-2.0
// Tests of the frame clock: boards on a made-up bus number refreshes alike, or say that they cannot.
#include "tests/firmware/frame_clock_bench.h"

static const frame_rate_t rate_60 = {60, 1};

static void test_boards_come_into_step(void **state)
{
    (void)state;
    static const frame_rate_t rates[] = {{60, 1}, {60000, 1001}, {24, 1}, {50, 1}, {120, 1}, {30000, 1001}};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        room_t *room = new_room(1 + i, rates[i]);
        (void)run(room, rates[i].frames / rates[i].seconds); /* a second */
        assert_int_equal(run(room, 1000), BOARDS);
        assert_int_equal(leader(room), 1);
        const int64_t number = room->board[5].step.number;
        refresh(room);
        assert_int_equal(room->board[5].step.number, number + 1);
    }
}

/* start(n) is the blank, within what bus time and the epoch's age allow; the limits are what the header says. */
static void test_times_of_a_refresh(void **state)
{
    (void)state;
    room_t *room = new_room(7, rate_60);
    (void)run(room, 600);
    const frame_step_t *step = &room->board[2].step;
    assert_in_range(step->start_us - room->blank_us + 1000, 1000 - 400, 1000 + 400);
    assert_int_equal(step->pose_limit_us, step->start_us - DELAY_US);
    const int64_t lag_us = step->start_us + 4166 - step->picture_limit_us;
    assert_in_range(lag_us, room->lag_us - 4200, room->lag_us + 4200);
    const frame_clock_t *clock = &room->board[2].clock;
    for (int64_t n = step->number - 3; n < step->number + 3; n++) {
        const int64_t length_us = frame_clock_start_us(clock, n + 1) - frame_clock_start_us(clock, n);
        assert_in_range(length_us, 16666, 16667);
        /* a picture is shown first at the refresh whose limit it just meets */
        const int64_t limit_us = frame_clock_start_us(clock, n) - lag_us + 4166;
        assert_int_equal(frame_clock_picture_number(clock, &step->epoch, limit_us), n);
        assert_int_equal(frame_clock_picture_number(clock, &step->epoch, limit_us + 2), n + 1);
    }
}

/* Panels 50 ppm off drift by a period in 5.5 minutes; the epochs follow, and numbers stay alike all the time. */
static void test_drift_is_followed(void **state)
{
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        room_t *room = new_room(11, rate_60);
        room->drift_ppm = sign * 50;
        room->loss_ppm = 10000;
        (void)run(room, 60);
        assert_int_equal(run(room, 60 * 800), BOARDS);
        assert_true(room->board[0].clock.now.number != 0);
        assert_int_equal(room->board[3].clock.missed, 0);
        assert_in_range(room->board[3].step.off_us + 600, 0, 1200);
    }
}

static void test_video_that_slides_is_followed(void **state)
{
    (void)state;
    room_t *room = new_room(13, rate_60);
    (void)run(room, 60);
    for (int i = 0; i < 60 * 60; i++) {
        room->lag_us = 18 * MS + (i * 5 + 9000) % 16667;
        refresh(room);
        assert_int_equal(boards_in_step(room), BOARDS);
        const int32_t wrong_us = room->lag_us - room->board[4].clock.now.lag_us;
        if (i > 300 && (i * 5 + 9000) % 16667 > 1000) /* and not just after it has jumped */
            assert_in_range(wrong_us + 20000, 20000 - 5500, 20000 + 5500);
    }
}

static void test_leader_goes_and_comes_back(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 1500; seed++) {
        room_t *room = new_room(seed, rate_60);
        room->drift_ppm = (int32_t)between(&room->rng, -50, 50);
        room->loss_ppm = 10000;
        (void)run(room, 120 + (int)between(&room->rng, 0, 120));
        hal_can_t *first = &room->board[0];
        first->absent = true;
        (void)run(room, (int)between(&room->rng, 60, 2000)); /* the next one has taken over by then */
        assert_true(run(room, 1) >= BOARDS - 1);
        const bool bus_off = seed % 2 == 0;
        first->absent = false;
        if (bus_off) /* the controller has thrown its queue away */
            first->sent = 0;
        /* 100 ms and the leader's next announcement; with a cable pulled both may wait for each other for a while */
        (void)run(room, bus_off ? 7 : 40);
        if (run(room, 300) < BOARDS)
            fail_msg("seed %llu: not all in step after the leader has come back", (unsigned long long)seed);
        assert_int_not_equal(leader(room), 0);
    }
}

/* An absent leader leads on by itself for a second, and then knows that nobody hears it. */
static void test_unheard_leader_says_so(void **state)
{
    (void)state;
    room_t *room = new_room(3, rate_60);
    (void)run(room, 120);
    room->board[0].absent = true;
    (void)run(room, 61);
    assert_false(room->board[0].step.in_step);
    assert_true(room->board[1].step.in_step);
}

static void test_who_hears_nothing_says_so(void **state)
{
    (void)state;
    room_t *room = new_room(5, rate_60);
    (void)run(room, 120);
    room->board[6].absent = true;
    (void)run(room, 61);
    assert_false(room->board[6].step.in_step);
    assert_true(room->board[5].step.in_step);
    assert_int_equal(leader(room), 1);
}

static void test_panel_that_is_off_says_so(void **state)
{
    (void)state;
    room_t *room = new_room(9, rate_60);
    (void)run(room, 120);
    hal_can_t *board = &room->board[3];
    const frame_blank_t late = {
        .now_us = room->blank_us + board->offset_us, .blank_us = room->blank_us + 4400, .bus_time_known = true};
    assert_false(frame_clock_step(&board->clock, board, &late).in_step);
    frame_blank_t blank = late;
    blank.blank_us = room->blank_us;
    assert_true(frame_clock_step(&board->clock, board, &blank).in_step);
    blank.bus_time_known = false;
    assert_false(frame_clock_step(&board->clock, board, &blank).in_step);
}

/* With a house signal at the leader, refreshes begin at its edges, whatever the leader's own panel does. */
static void test_house_signal_is_followed(void **state)
{
    (void)state;
    for (int off_us = -3000; off_us <= 3000; off_us += 1500) {
        room_t *room = new_room(17, rate_60);
        room->house_off_us = off_us;
        (void)run(room, 600);
        assert_int_equal(run(room, 60), BOARDS);
        assert_in_range(room->board[4].step.off_us + off_us + 1000, 1000 - 450, 1000 + 450);
    }
}

static void test_messages(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    const can_frame_clock_t clock = {.node = 63,
                                     .counter = 14,
                                     .epoch = 15,
                                     .from = 0xABC,
                                     .phase_us = 16664,
                                     .lag_us = 65520,
                                     .target_ms = 255,
                                     .changes = true};
    can_frame_clock_t heard;
    assert_true(can_frame_clock_encode(&frame, &clock));
    assert_int_equal(frame.id, 0x17F);
    assert_int_equal(can_frame_clock_decode(&heard, &frame), CAN_CHECK_OK);
    assert_true(heard.node == 63 && heard.counter == 14 && heard.epoch == 15 && heard.from == 0xABC);
    assert_true(heard.phase_us == 16664 && heard.lag_us == 65520 && heard.target_ms == 255 && heard.changes &&
                !heard.to_come && !heard.sure);
    frame.data[3] ^= 4;
    assert_int_equal(can_frame_clock_decode(&heard, &frame), CAN_CHECK_CRC);
    frame.id = 0x140;
    assert_int_equal(can_frame_clock_decode(&heard, &frame), CAN_CHECK_OTHER);
    assert_false(can_frame_clock_encode(&frame, &(can_frame_clock_t){.node = 0}));
    assert_false(can_frame_clock_encode(&frame, &(can_frame_clock_t){.node = 1, .epoch = 16}));

    const can_step_t step = {
        .node = 1, .counter = 3, .in_step = true, .refresh = 70000, .picture = 131073, .pose_us = 6553600 + 4250};
    can_step_t read;
    assert_true(can_step_encode(&frame, &step));
    assert_int_equal(frame.id, 0x501);
    assert_int_equal(can_step_decode(&read, &frame), CAN_CHECK_OK);
    assert_true(read.in_step && !read.tagged);
    assert_int_equal(read.refresh, 70000 - 65536);
    assert_int_equal(read.picture, 1);
    assert_int_equal(read.pose_us, 4200);
    assert_false(can_step_encode(&frame, &(can_step_t){.node = 64}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boards_come_into_step),      cmocka_unit_test(test_times_of_a_refresh),
        cmocka_unit_test(test_drift_is_followed),          cmocka_unit_test(test_video_that_slides_is_followed),
        cmocka_unit_test(test_leader_goes_and_comes_back), cmocka_unit_test(test_unheard_leader_says_so),
        cmocka_unit_test(test_who_hears_nothing_says_so),  cmocka_unit_test(test_panel_that_is_off_says_so),
        cmocka_unit_test(test_house_signal_is_followed),   cmocka_unit_test(test_messages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
