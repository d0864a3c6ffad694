// SPDX-License-Identifier: Apache-2.0
// Tests of the choice of a step: boards that are slow for good, for a while, about the limit, and by chance.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "firmware/degrade.h"
#include "tests/support/rng.h"

enum { PERIOD_US = 16667, REST_US = 400, STEPS = 4, HOUR_FRAMES = 3600 * 60, COST = 100000 };

/* A board at 60 Hz, and what it does not know. */
typedef struct {
    degrade_t degrade;
    double slowness[STEPS]; /* the true time of each step, of the period, with a load of 1 */
    int32_t late, returns;
    int64_t frame, last_change, least_gap; /* frames between a change and the return after it */
} board_t;

static const uint32_t costs[STEPS] = {COST, COST * 2 / 3, COST * 2 / 5, COST / 5};

/* A board as fast as the model says, when step 0 takes that share of the period. */
static board_t board_of(double share)
{
    board_t board = {.least_gap = INT64_MAX};
    for (int i = 0; i < STEPS; i++)
        board.slowness[i] = share * costs[i] / COST;
    degrade_init(&board.degrade, STEPS);
    return board;
}

static void run_frame(board_t *board, double load)
{
    degrade_frame_t frame = {.time_us = PERIOD_US};
    const int32_t before = board->degrade.step;
    frame.warp_us = (int64_t)(load * board->slowness[before] * PERIOD_US);
    frame.busy_us = frame.warp_us + REST_US;
    frame.late = frame.busy_us > PERIOD_US;
    for (int i = 0; i < STEPS; i++)
        frame.cost[i] = costs[i];
    const uint32_t changes = board->degrade.changes;
    const int32_t after = degrade_next(&board->degrade, &frame);
    assert_int_equal(after, board->degrade.step);
    assert_in_range(after, 0, STEPS - 1);
    assert_int_equal(board->degrade.changes - changes, after != before);
    board->late += frame.late;
    board->frame++;
    if (after < before) {
        const int64_t gap = board->frame - board->last_change;
        board->least_gap = gap < board->least_gap ? gap : board->least_gap;
        board->returns++;
    }
    if (after != before)
        board->last_change = board->frame;
}

static void run(board_t *board, int64_t frames, double load)
{
    for (int64_t n = 0; n < frames; n++)
        run_frame(board, load);
}

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

static void test_the_return_is_to_the_worst_of_late(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run(&board, 60, 1.0);
    run(&board, 60, 4.0);
    assert_int_equal(board.degrade.step, 3);
    run(&board, 200, 1.0);
    run(&board, 20, 1.3); /* step 0 is out of reach */
    run(&board, 40, 1.0);
    assert_int_equal(board.degrade.step, 1);
}

static void test_a_return_fails_once(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run(&board, 60, 1.0);
    run(&board, 60, 2.5);
    assert_int_equal(board.degrade.hold_us, DEGRADE_MIN_HOLD_S * 1000000);
    run(&board, 300, 1.0);
    assert_int_equal(board.degrade.step, 0);
    run(&board, 60, 1.35);
    assert_int_equal(board.degrade.step, 1);
    run(&board, 60, 2.5);
    assert_int_equal(board.degrade.step, 2);
    assert_int_equal(board.degrade.hold_us, 2 * DEGRADE_MIN_HOLD_S * 1000000);
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

/* The costs are wrong by a half: step 0 seems within reach, and is not. */
static void test_a_wrong_cost_is_learned_from_one_return(void **state)
{
    (void)state;
    board_t board = board_of(1.05);
    for (int i = 1; i < STEPS; i++)
        board.slowness[i] *= 0.67;
    run(&board, 600 * 60, 1.0);
    assert_int_equal(board.returns, 1);
    assert_int_equal(board.degrade.changes, 3);
    assert_int_equal(board.degrade.step, 1);
    run(&board, HOUR_FRAMES, 1.0); /* tried anew as it is forgotten */
    assert_in_range(board.returns, 2, 4);
    for (int i = 0; i < STEPS; i++) /* cured */
        board.slowness[i] = 0.7 * costs[i] / COST;
    run(&board, HOUR_FRAMES, 1.0);
    assert_int_equal(board.degrade.step, 0);
}

static void test_no_step_is_taken_to_be_more_than_four_times_dearer(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run(&board, 60, 1.0);
    run(&board, 60, 1.6);
    board.slowness[0] = 50.0;
    run(&board, 300, 1.0);
    assert_int_equal(board.returns, 1);
    assert_int_equal(board.degrade.dearer_q8[0], 4 * 256);
}

/* Whenever step 0 is back for three seconds, the load rises, and falls at once when it is left. */
static void run_worst_load(board_t *board, int64_t frames)
{
    for (int64_t n = 0; n < frames; n++)
        run_frame(board, board->degrade.step == 0 && board->frame > board->last_change + 180 ? 2.0 : 1.0);
}

static void test_failing_returns_become_rare_and_are_forgiven(void **state)
{
    (void)state;
    board_t board = board_of(0.7);
    run_worst_load(&board, HOUR_FRAMES);
    assert_in_range(board.returns, 12, 13);
    assert_in_range(board.least_gap, 60 * DEGRADE_MIN_HOLD_S, 60 * DEGRADE_MIN_HOLD_S + 20);
    board.returns = 0;
    run_worst_load(&board, HOUR_FRAMES);
    assert_in_range(board.returns, 6, 7);
    assert_int_equal(board.degrade.hold_us, DEGRADE_MAX_HOLD_S * 1000000);
    run(&board, 2 * HOUR_FRAMES, 1.0);
    assert_int_equal(board.degrade.step, 0);
    run(&board, 600, 2.5);
    assert_int_equal(board.degrade.hold_us, DEGRADE_MIN_HOLD_S * 1000000);
}

/* Loads about the limit that swing, walk, jump and have spikes, for an hour each: never a flicker. */
static void test_no_flicker_about_the_limit(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        rng_t rng = {seed};
        board_t board = board_of(rng_double(&rng, 0.6, 1.6));
        for (int i = 0; i < STEPS; i++)
            board.slowness[i] *= rng_double(&rng, 0.77, 1.3);
        const double noise = rng_double(&rng, 0, 0.3), swing = rng_double(&rng, 0, 0.5);
        const int64_t half_swing = rng_int(&rng, 10, 6000), spike = rng_int(&rng, 5, 2000);
        for (int64_t n = 0; n < HOUR_FRAMES; n++) {
            const double base = n / half_swing % 2 == 0 ? 1.0 : 1.0 - swing;
            run_frame(&board, (base + rng_double(&rng, -noise, noise)) * (rng_int(&rng, 1, spike) == 1 ? 3.0 : 1.0));
        }
        if (board.degrade.changes > 45 || board.returns > 14 || board.least_gap < 60 * DEGRADE_MIN_HOLD_S)
            fail_msg("seed %d: %u changes, %d returns in an hour; a return %d frames after another change", (int)seed,
                     board.degrade.changes, board.returns, (int)board.least_gap);
    }
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
        cmocka_unit_test(test_the_return_is_to_the_worst_of_late),
        cmocka_unit_test(test_a_return_fails_once),
        cmocka_unit_test(test_steps_that_begin_late_are_no_reason),
        cmocka_unit_test(test_one_step_alone_and_no_cheaper_step_change_nothing),
        cmocka_unit_test(test_extreme_numbers_do_not_overflow),
        cmocka_unit_test(test_a_wrong_cost_is_learned_from_one_return),
        cmocka_unit_test(test_no_step_is_taken_to_be_more_than_four_times_dearer),
        cmocka_unit_test(test_failing_returns_become_rare_and_are_forgiven),
        cmocka_unit_test(test_no_flicker_about_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
