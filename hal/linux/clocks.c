// SPDX-License-Identifier: Apache-2.0
// This machine's clocks: one, or two at one moment.
#include "hal/linux/clocks.h"

#include <time.h>

enum { TRIES = 3, CLOSE_NS = 5000 };

static int64_t read_ns(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

int64_t clock_monotonic_ns(void)
{
    return read_ns(CLOCK_MONOTONIC);
}

clock_pair_t clock_pair(void)
{
    clock_pair_t best = {0, 0};
    int64_t best_width_ns = INT64_MAX;
    for (int i = 0; i < TRIES && best_width_ns > CLOSE_NS; i++) {
        const int64_t before_ns = read_ns(CLOCK_MONOTONIC);
        const int64_t realtime_ns = read_ns(CLOCK_REALTIME);
        const int64_t width_ns = read_ns(CLOCK_MONOTONIC) - before_ns;
        if (width_ns < best_width_ns) {
            best_width_ns = width_ns;
            best = (clock_pair_t){before_ns + width_ns / 2, realtime_ns};
        }
    }
    return best;
}
