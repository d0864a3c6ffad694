// SPDX-License-Identifier: Apache-2.0
// Tests of the choice of a step: boards that are slow for good, for a while, and by chance.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/firmware/degrade_board.h"

static void test_a_fast_board_keeps_the_method(void **state)
{
    (void)state;
    board_t board = board_of(0.85);
    run(&board, HOUR_FRAMES, 1.0);
    assert_int_equal(board.degrade.changes, 0);
    assert_in_range(board.degrade.wanted_us, 14560, 14570);
}

static void test_a_slow_board_takes_the_best_step_that_it_can_hold_and_stays(void **state)
{
    (void)state;
    static const struct {
        double share;
        int32_t step;
    } cases[] = {{0.95, 1}, {1.15, 1}, {1.3, 2}, {1.9, 2}, {2.5, 3}, {9.0, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        board_t board = board_of(cases[i].share);
        run(&board, HOUR_FRAMES / 60, 1.0);
        assert_int_equal(board.degrade.step, cases[i].step);
        assert_int_equal(board.degrade.changes, 1);
        if (cases[i].share < 0.97)
            assert_int_equal(board.late, 0);
        else if (cases[i].share < 3)
            assert_in_range(board.late, 1, DEGRADE_WARM_UP + 2);
    }
}

static void test_a_rising_load_is_met_before_a_picture_is_late(void **state)
{
    (void)state;
    board_t board = board_of(0.6);
    for (int n = 0; n < 60 * 60; n++) /* three times as slow within a minute */
        run_frame(&board, 1.0 + 2.0 * n / 3600);
    assert_int_equal(board.late, 0);
    assert_int_equal(board.degrade.step, 2);
    assert_in_range(board.degrade.changes, 2, 2);
    run(&board, 60 * DEGRADE_MIN_HOLD_S - 10, 0.5);
    assert_int_equal(board.degrade.step, 2);
    run(&board, 60, 0.5);
    assert_int_equal(board.degrade.step, 0);
    assert_int_equal(board.degrade.changes, 3);
}

static void test_a_sudden_load_costs_two_pictures(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run(&board, 600, 1.0);
    run(&board, 600, 2.5);
    assert_int_equal(board.late, 2);
    assert_int_equal(board.degrade.step, 2);
    assert_int_equal(board.degrade.changes, 1);
}

static void test_single_late_pictures_are_no_reason(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    for (int n = 0; n < 100; n++) {
        run(&board, 119, 1.0);
        run_frame(&board, 6.0);
    }
    assert_int_equal(board.late, 100);
    assert_int_equal(board.degrade.changes, 0);
    for (int n = 0; n < 100; n++) {
        run(&board, 29, 1.0);
        run_frame(&board, 6.0);
    }
    assert_true(board.degrade.changes > 0);
}

static void test_the_first_frames_are_not_judged(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run(&board, DEGRADE_WARM_UP, 5.0);
    run(&board, 600, 1.0);
    assert_int_equal(board.late, DEGRADE_WARM_UP);
    assert_int_equal(board.degrade.changes, 0);
}

/* Pictures are late because the step began late: no method mends that. */
static void test_steps_that_begin_late_are_no_reason(void **state)
{
    (void)state;
    degrade_t degrade;
    degrade_init(&degrade, 2);
    for (int n = 0; n < 600; n++) {
        const bool late = n % 128 >= 64 && n % 128 < 104;
        degrade_next(&degrade, &(degrade_frame_t){.busy_us = 8000,
                                                  .warp_us = 7000,
                                                  .time_us = late ? 5000 : PERIOD_US,
                                                  .late = late,
                                                  .cost = {COST, COST / 2}});
    }
    assert_int_equal(degrade.changes, 0);
    assert_int_equal(degrade.frames, 600);
}

static void test_one_step_alone_and_no_cheaper_step_change_nothing(void **state)
{
    (void)state;
    degrade_t degrade;
    const degrade_frame_t slow = {
        .busy_us = 90000, .warp_us = 90000, .time_us = PERIOD_US, .late = true, .cost = {COST, COST + 1, COST}};
    for (int32_t steps = 1; steps <= 3; steps++) {
        degrade_init(&degrade, steps);
        for (int n = 0; n < 1000; n++)
            assert_int_equal(degrade_next(&degrade, &slow), 0);
    }
    degrade_init(&degrade, 2);
    for (int n = 0; n < 1000; n++) /* without a period nothing can be said */
        assert_int_equal(
            degrade_next(&degrade, &(degrade_frame_t){.busy_us = 9, .warp_us = 9, .late = true, .cost = {2, 1}}), 0);
}

static void test_extreme_numbers_do_not_overflow(void **state)
{
    (void)state;
    degrade_t degrade;
    const int64_t hour_us = INT64_C(3600000000);
    degrade_init(&degrade, 2);
    for (int n = 0; n < 100; n++)
        degrade_next(&degrade, &(degrade_frame_t){hour_us, hour_us, 1, true, {1U << 28, 1}});
    assert_int_equal(degrade.step, 1);
    degrade_init(&degrade, 2);
    for (int n = 0; n < 100; n++)
        degrade_next(&degrade, &(degrade_frame_t){hour_us, hour_us, hour_us, true, {1, 1U << 28}});
    assert_int_equal(degrade.step, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_fast_board_keeps_the_method),
        cmocka_unit_test(test_a_slow_board_takes_the_best_step_that_it_can_hold_and_stays),
        cmocka_unit_test(test_a_rising_load_is_met_before_a_picture_is_late),
        cmocka_unit_test(test_a_sudden_load_costs_two_pictures),
        cmocka_unit_test(test_single_late_pictures_are_no_reason),
        cmocka_unit_test(test_the_first_frames_are_not_judged),
        cmocka_unit_test(test_steps_that_begin_late_are_no_reason),
        cmocka_unit_test(test_one_step_alone_and_no_cheaper_step_change_nothing),
        cmocka_unit_test(test_extreme_numbers_do_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
