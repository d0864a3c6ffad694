// SPDX-License-Identifier: Apache-2.0
// Keeps the first Step of each refresh, and compares the others with it.
#include "sim/pose/step_watch.h"

#include <stddef.h>

static step_watch_refresh_t *find(step_watch_t *watch, uint32_t refresh, int64_t time_us)
{
    for (int i = 0; i < STEP_WATCH_KEPT; i++) {
        step_watch_refresh_t *kept = &watch->kept[i];
        if (kept->boards != 0 && kept->first.refresh == refresh && time_us - kept->time_us <= STEP_WATCH_OPEN_US)
            return kept;
    }
    return NULL;
}

void step_watch_take(step_watch_t *watch, const can_step_t *step, int64_t time_us)
{
    const uint64_t board = UINT64_C(1) << step->node;
    if (!step->in_step)
        return;
    step_watch_refresh_t *kept = find(watch, step->refresh, time_us);
    if (kept == NULL) {
        watch->kept[watch->next] = (step_watch_refresh_t){.boards = board, .time_us = time_us, .first = *step};
        watch->next = (watch->next + 1) % STEP_WATCH_KEPT;
        return;
    }
    if ((kept->boards & board) != 0)
        return;
    const can_step_t *first = &kept->first;
    const bool differs =
        step->picture != first->picture || step->tagged != first->tagged || step->pose_us != first->pose_us;
    watch->compared += (kept->boards & (kept->boards - 1)) == 0;
    watch->differing += differs && !kept->differs;
    kept->differs |= differs;
    kept->boards |= board;
}
