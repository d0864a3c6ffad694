// SPDX-License-Identifier: Apache-2.0
// A board with a ladder of four steps, for tests of the choice among them.
#ifndef TESTS_FIRMWARE_DEGRADE_BOARD_H
#define TESTS_FIRMWARE_DEGRADE_BOARD_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/degrade.h"

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
static inline board_t board_of(double share)
{
    board_t board = {.least_gap = INT64_MAX};
    for (int i = 0; i < STEPS; i++)
        board.slowness[i] = share * costs[i] / COST;
    degrade_init(&board.degrade, STEPS);
    return board;
}

static inline void run_frame(board_t *board, double load)
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

static inline void run(board_t *board, int64_t frames, double load)
{
    for (int64_t n = 0; n < frames; n++)
        run_frame(board, load);
}

#endif
