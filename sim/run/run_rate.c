// SPDX-License-Identifier: Apache-2.0
// The refresh rate of a run, and how many frames a pose list lasts.
#include "sim/run/run_rate.h"

#include <math.h>
#include <stdlib.h>

enum { US_PER_S = 1000000, MOST_PARTS = 240240 /**< of a frame_rate_t */ };

sim_rate_t run_rate_from_frames(frame_rate_t rate)
{
    const sim_rate_t half = {0, 2 * rate.frames, rate.seconds};
    return (sim_rate_t){sim_rate_time_us(&half, 1), rate.frames, rate.seconds};
}

sim_rate_t run_rate_from_hz(double hz)
{
    const double tolerance = 0.0005, whole = round(hz), slowed = round(hz * 1.001);
    if (fabs(hz - whole) < tolerance)
        return run_rate_from_frames((frame_rate_t){(int32_t)whole, 1});
    if (fabs(hz - slowed / 1.001) < tolerance)
        return run_rate_from_frames((frame_rate_t){(int32_t)slowed * 1000, 1001});
    return run_rate_from_frames((frame_rate_t){(int32_t)lround(hz * 1000), 1000});
}

static int compare(const void *a, const void *b)
{
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

/* The median time from pose to pose; 0 when there is none, or no memory to find it. */
static int64_t median_interval_us(const pose_list_t *list)
{
    if (list->count < 2)
        return 0;
    int64_t *interval = malloc((list->count - 1) * sizeof *interval);
    if (interval == NULL)
        return 0;
    for (size_t i = 0; i + 1 < list->count; i++)
        interval[i] = list->entry[i + 1].time_us - list->entry[i].time_us;
    qsort(interval, list->count - 1, sizeof *interval, compare);
    const int64_t median_us = interval[(list->count - 1) / 2];
    free(interval);
    return median_us;
}

static int32_t rounded_quotient(int64_t a, int64_t b)
{
    return (int32_t)((a + b / 2) / b);
}

/* Is that its period, but for the rounding of both ends to 1 us? */
static bool fits(frame_rate_t rate, int64_t period_us)
{
    return llabs((int64_t)rate.seconds * US_PER_S - rate.frames * period_us) <= rate.frames;
}

static frame_rate_t rate_of_period(int64_t period_us)
{
    const frame_rate_t whole = {rounded_quotient(US_PER_S, period_us), 1};
    const frame_rate_t slowed = {rounded_quotient(1001 * US_PER_S, 1000 * period_us) * 1000, 1001};
    if (fits(whole, period_us))
        return whole;
    if (fits(slowed, period_us))
        return slowed;
    const int32_t seconds = MOST_PARTS / (int32_t)((US_PER_S + period_us - 1) / period_us);
    return (frame_rate_t){rounded_quotient((int64_t)seconds * US_PER_S, period_us), seconds};
}

sim_rate_t run_rate_of_poses(const pose_list_t *list)
{
    const int64_t median_us = median_interval_us(list);
    if (median_us <= US_PER_S / RUN_RATE_USUAL_HZ)
        return run_rate_from_frames((frame_rate_t){RUN_RATE_USUAL_HZ, 1});
    if (median_us >= US_PER_S / RUN_RATE_LEAST_HZ)
        return run_rate_from_frames((frame_rate_t){RUN_RATE_LEAST_HZ, 1});
    return run_rate_from_frames(rate_of_period(median_us));
}

int64_t run_rate_frames(const sim_rate_t *rate, const pose_list_t *list)
{
    const sim_rate_t from_zero = {0, rate->frames, rate->seconds};
    /* the list's times are rounded to 1 us: a last pose that is 1 us early still has its frame */
    const int64_t duration_us = list->entry[list->count - 1].time_us - list->entry[0].time_us + 1;
    return sim_rate_beat_at(&from_zero, duration_us) + 1;
}
