// SPDX-License-Identifier: Apache-2.0
// Tests of the way back to a better step: when, to which, what failing teaches, and that there is no flicker.
#include "tests/firmware/degrade_board.h"

#include "tests/support/rng.h"

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
        cmocka_unit_test(test_the_return_is_to_the_worst_of_late),
        cmocka_unit_test(test_a_return_fails_once),
        cmocka_unit_test(test_a_wrong_cost_is_learned_from_one_return),
        cmocka_unit_test(test_no_step_is_taken_to_be_more_than_four_times_dearer),
        cmocka_unit_test(test_failing_returns_become_rare_and_are_forgiven),
        cmocka_unit_test(test_no_flicker_about_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
