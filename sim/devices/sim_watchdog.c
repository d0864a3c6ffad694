// SPDX-License-Identifier: Apache-2.0
// The watchdog in the simulator (hal/hal_watchdog.h): says when it would have reset the board.
#include "sim/devices/sim_watchdog.h"

#include <stdlib.h>

struct hal_watchdog {
    const hal_time_t *clock;
    int64_t period_us;
    int64_t last_feed_us;
    uint64_t feeds;
    bool expired; /**< before the last feed */
    sim_watchdog_faults_t faults;
};

hal_watchdog_t *sim_watchdog_create(const hal_time_t *clock, int64_t period_us, char error[FILE_ERROR_LENGTH])
{
    if (period_us < 1) {
        file_error(error, "watchdog", "period %lld us, expected 1 or more", (long long)period_us);
        return NULL;
    }
    hal_watchdog_t *watchdog = malloc(sizeof *watchdog);
    if (watchdog == NULL) {
        file_error(error, "watchdog", "out of memory");
        return NULL;
    }
    *watchdog = (hal_watchdog_t){.clock = clock, .period_us = period_us, .last_feed_us = hal_time_now_us(clock)};
    return watchdog;
}

void sim_watchdog_destroy(hal_watchdog_t *watchdog)
{
    free(watchdog);
}

sim_watchdog_faults_t *sim_watchdog_faults(hal_watchdog_t *watchdog)
{
    return &watchdog->faults;
}

bool sim_watchdog_expired(const hal_watchdog_t *watchdog, int64_t now_us)
{
    return watchdog->expired || now_us - watchdog->last_feed_us >= watchdog->period_us;
}

uint64_t sim_watchdog_feeds(const hal_watchdog_t *watchdog)
{
    return watchdog->feeds;
}

hal_status_t hal_watchdog_feed(hal_watchdog_t *watchdog)
{
    if (watchdog->faults.io)
        return HAL_IO;
    const int64_t now_us = hal_time_now_us(watchdog->clock);
    watchdog->expired = sim_watchdog_expired(watchdog, now_us);
    watchdog->last_feed_us = now_us;
    watchdog->feeds++;
    return HAL_OK;
}
