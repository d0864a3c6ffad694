// SPDX-License-Identifier: Apache-2.0
// The refresh rate of a run, and how many frames a pose list lasts.
#include "sim/run/run_rate.h"

#include <math.h>
#include <stdlib.h>

enum { US_PER_S = 1000000 };

/* Beat 0 half a period after 0. */
static sim_rate_t shifted(int32_t frames, int32_t seconds)
{
    const sim_rate_t half = {0, 2 * frames, seconds};
    return (sim_rate_t){sim_rate_time_us(&half, 1), frames, seconds};
}

sim_rate_t run_rate_from_hz(double hz)
{
    const double whole = round(hz);
    if (fabs(hz - whole) < 0.0005 && whole >= 1)
        return shifted((int32_t)whole, 1);
    const long millihertz = lround(hz * 1000);
    return shifted(millihertz < 1 ? 1 : (int32_t)millihertz, 1000);
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

sim_rate_t run_rate_of_poses(const pose_list_t *list)
{
    const int64_t median_us = median_interval_us(list);
    if (median_us <= US_PER_S / RUN_RATE_USUAL_HZ || median_us > 1000 * (int64_t)US_PER_S)
        return shifted(RUN_RATE_USUAL_HZ, 1);
    const int64_t hz = (US_PER_S + median_us / 2) / median_us;
    if (hz >= 1 && llabs(US_PER_S - hz * median_us) <= hz)
        return shifted((int32_t)hz, 1);
    return shifted(US_PER_S, (int32_t)median_us);
}

int64_t run_rate_frames(const sim_rate_t *rate, const pose_list_t *list)
{
    const sim_rate_t from_zero = {0, rate->frames, rate->seconds};
    /* the list's times are rounded to 1 us: a last pose that is 1 us early still has its frame */
    const int64_t duration_us = list->entry[list->count - 1].time_us - list->entry[0].time_us + 1;
    return sim_rate_beat_at(&from_zero, duration_us) + 1;
}
