// SPDX-License-Identifier: Apache-2.0
// What the stages of the loop take: mean and worst of each over the last second.
#include "firmware/stage_times.h"

static const int64_t hour_us = INT64_C(3600000000);

void stage_times_init(stage_times_t *times)
{
    *times = (stage_times_t){.steps = 0};
}

void stage_times_add(stage_times_t *times, const stage_step_t *step)
{
    for (int stage = 0; stage < STAGES; stage++) {
        int64_t us = step->us[stage] > 0 ? step->us[stage] : 0;
        us = us < hour_us ? us : hour_us; /* 2^32 steps of 2^32 us: sums fit, and so does an hour in 32 bits */
        times->sum_us[stage] += us;
        times->worst_us[stage] = us > times->worst_us[stage] ? us : times->worst_us[stage];
    }
    times->steps++;
    times->shown += step->shown;
    times->late += step->late;
}

stage_figures_t stage_times_close(stage_times_t *times)
{
    stage_figures_t figures = {.shown = times->shown, .late = times->late};
    for (int stage = 0; stage < STAGES && times->steps > 0; stage++) {
        figures.mean_us[stage] = (uint32_t)(times->sum_us[stage] / times->steps);
        figures.worst_us[stage] = (uint32_t)times->worst_us[stage];
    }
    stage_times_init(times);
    return figures;
}
