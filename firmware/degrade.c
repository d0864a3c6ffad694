// SPDX-License-Identifier: Apache-2.0
// Which step of its ladder a board can hold: down before pictures are late, and back up without flicker.
#include "firmware/degrade.h"

enum {
    LIMIT_PERCENT = 90,
    RETURN_PERCENT = 80,
    OVER_FRAMES = 8,
    MEAN_FRAMES = 8,
    WINDOW_FRAMES = 64,
    MISS = 64,
    MISSES = 120,
    AS_STATED_Q8 = 256,
    DEAREST_Q8 = 1024
};

static const int64_t stable_us = INT64_C(600000000);
static const int64_t second_us = 1000000;

void degrade_init(degrade_t *degrade, int32_t steps)
{
    *degrade = (degrade_t){.steps = steps, .hold_us = DEGRADE_MIN_HOLD_S * second_us};
    for (int32_t step = 0; step < steps; step++)
        degrade->dearer_q8[step] = AS_STATED_Q8;
}

static int64_t median(const int64_t of[3])
{
    const int64_t low = of[0] < of[1] ? of[0] : of[1], high = of[0] < of[1] ? of[1] : of[0];
    return of[2] < low ? low : of[2] > high ? high : of[2];
}

/* What a unit of cost takes on this board. */
static void measure(degrade_t *d, const degrade_frame_t *frame)
{
    const int64_t most_q16 = INT64_C(1) << 31; /* times a cost fits 62 bits; an hour in Q16 fits 48 */
    int64_t unit_q16 = (frame->warp_us << 16) / frame->cost[d->step];
    unit_q16 = unit_q16 < most_q16 ? unit_q16 : most_q16;
    d->unit_q16[d->frames % 3] = unit_q16;
    if (d->frames == DEGRADE_WARM_UP + 1)
        d->unit_q16[0] = d->unit_q16[1] = d->unit_q16[2] = d->mean_q16 = unit_q16;
    d->mean_q16 += (median(d->unit_q16) - d->mean_q16) / MEAN_FRAMES;
}

/* The time that there is for a frame: a step that begins late has less, through no fault of its method. */
static int64_t period(degrade_t *d, int64_t time_us)
{
    if (d->frames % WINDOW_FRAMES == 0) {
        d->longest_us[1] = d->longest_us[0];
        d->longest_us[0] = 0;
    }
    d->longest_us[0] = time_us > d->longest_us[0] ? time_us : d->longest_us[0];
    return d->longest_us[d->longest_us[1] > d->longest_us[0]];
}

/* What the frame would take with that step. */
static int64_t expected(const degrade_frame_t *frame, int32_t step, int64_t unit_q16)
{
    return frame->busy_us - frame->warp_us + ((unit_q16 * frame->cost[step]) >> 16);
}

static void change(degrade_t *d, int32_t step)
{
    d->step = step;
    d->changes++;
    d->over = 0;
    d->misses = 0;
    d->candidate_us = 0;
}

/* A return has failed at once: its step costs more than was thought, a unit takes what it took before. */
static void learn(degrade_t *d)
{
    const int64_t now_q16 = median(d->unit_q16);
    if (now_q16 <= d->returned_q16 || d->returned_q16 <= 0)
        return;
    const int64_t dearer_q8 = d->dearer_q8[d->step] * now_q16 / d->returned_q16;
    d->dearer_q8[d->step] = (int32_t)(dearer_q8 < DEAREST_Q8 ? dearer_q8 : DEAREST_Q8);
    d->since_learned_us = 0;
    d->unit_q16[0] = d->unit_q16[1] = d->unit_q16[2] = d->mean_q16 = d->returned_q16;
}

/* What was learned was of a load that may have gone. */
static void forget(degrade_t *d, int64_t period_us)
{
    d->since_learned_us += period_us;
    if (d->since_learned_us < stable_us)
        return;
    d->since_learned_us = 0;
    for (int32_t step = 0; step < d->steps; step++)
        d->dearer_q8[step] = (d->dearer_q8[step] + AS_STATED_Q8) / 2;
}

/* A return has ended; how long it has lasted decides how soon the next may come. */
static void judge_return(degrade_t *d)
{
    if (!d->returned)
        return;
    d->returned = false;
    if (d->since_return_us < second_us)
        learn(d);
    const int64_t most_us = DEGRADE_MAX_HOLD_S * second_us, least_us = DEGRADE_MIN_HOLD_S * second_us;
    if (d->since_return_us < stable_us)
        d->hold_us = 2 * d->hold_us < most_us ? 2 * d->hold_us : most_us;
    for (; d->since_return_us >= stable_us && d->hold_us > least_us; d->since_return_us -= stable_us)
        d->hold_us /= 2;
}

static void step_down(degrade_t *d, const degrade_frame_t *frame, int64_t period_us)
{
    judge_return(d);
    const int64_t last_q16 = median(d->unit_q16); /* the mean is too slow when a board has suddenly become so */
    const int64_t unit_q16 = last_q16 > d->mean_q16 ? last_q16 : d->mean_q16;
    int32_t below = d->step;
    for (int32_t step = d->step + 1; step < d->steps; step++) {
        if (frame->cost[step] >= frame->cost[below])
            continue;
        below = step;
        if (100 * expected(frame, step, unit_q16) <= RETURN_PERCENT * period_us)
            break;
    }
    if (below != d->step)
        change(d, below);
}

static void step_up(degrade_t *d, const degrade_frame_t *frame, int64_t period_us)
{
    int32_t above = 0;
    while (above < d->step && 100 * expected(frame, above, d->mean_q16) > RETURN_PERCENT * period_us)
        above++;
    if (above == d->step) {
        d->candidate_us = 0;
        return;
    }
    if (2 * d->candidate_us < d->hold_us || above > d->candidate)
        d->candidate = above; /* the worst in the second half: while the mean falls, better ones come into reach */
    d->candidate_us += period_us;
    if (d->candidate_us < d->hold_us)
        return;
    d->returned = true;
    d->since_return_us = 0;
    d->returned_q16 = d->mean_q16;
    change(d, d->candidate);
}

int32_t degrade_next(degrade_t *d, const degrade_frame_t *stated)
{
    degrade_frame_t known = *stated;
    const degrade_frame_t *frame = &known;
    const int64_t period_us = period(d, frame->time_us);
    d->frames++;
    if (d->frames <= DEGRADE_WARM_UP || period_us <= 0)
        return d->step;
    forget(d, period_us);
    for (int32_t step = 0; step < d->steps; step++)
        known.cost[step] = (uint32_t)((uint64_t)stated->cost[step] * (uint64_t)d->dearer_q8[step] / AS_STATED_Q8);
    measure(d, frame);
    d->wanted_us = expected(frame, 0, d->mean_q16);
    d->since_return_us += period_us;
    d->over = 100 * expected(frame, d->step, d->mean_q16) > LIMIT_PERCENT * period_us ? d->over + 1 : 0;
    d->misses -= d->misses > 0;
    d->misses += frame->late && 100 * frame->busy_us > LIMIT_PERCENT * period_us ? MISS : 0;
    if (d->misses >= MISSES || d->over >= OVER_FRAMES)
        step_down(d, frame, period_us);
    else
        step_up(d, frame, period_us);
    return d->step;
}
