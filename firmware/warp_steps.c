// SPDX-License-Identifier: Apache-2.0
// The steps of a planned frame, done by all workers together.
#include "firmware/warp_steps.h"

_Static_assert((int)HAL_WORKERS_MAX == (int)WORKERS_MAX, "a warp has room for every worker");

typedef struct {
    warp_t *warp;
    warp_step_t step;
} work_t;

static void do_part(void *context, int32_t part, int32_t parts)
{
    const work_t *work = context;
    warp_work(work->warp, work->step, (worker_t){part, parts});
}

void warp_steps_run(warp_t *warp, hal_workers_t *workers)
{
    for (work_t work = {warp, WARP_MEASURE}; work.step <= WARP_DRAW; work.step++)
        if (warp_needs(warp, work.step))
            hal_workers_run(workers, do_part, &work);
}
