// SPDX-License-Identifier: Apache-2.0
// A board's clock in the simulator (hal/hal_time.h): virtual or real time, with an offset and a drift of its own.
#include "sim/devices/sim_clock.h"

#include <assert.h>
#include <stdlib.h>
#include <time.h>

enum { BILLION = 1000000000, US_PER_S = 1000000, NS_PER_US = 1000 };

static const int64_t max_offset_us = 1000000000000000;

struct hal_time {
    sim_clock_settings_t settings;
    int64_t now_us; /**< virtual: the simulation's time */
};

int64_t sim_clock_monotonic_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * US_PER_S + now.tv_nsec / NS_PER_US;
}

hal_time_t *sim_clock_create(const sim_clock_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    if (settings->drift_ppb < -SIM_CLOCK_MAX_DRIFT_PPB || settings->drift_ppb > SIM_CLOCK_MAX_DRIFT_PPB) {
        file_error(error, "clock", "drift %d ppb, expected at most %d either way", settings->drift_ppb,
                   SIM_CLOCK_MAX_DRIFT_PPB);
        return NULL;
    }
    if (settings->offset_us < -max_offset_us || settings->offset_us > max_offset_us) {
        file_error(error, "clock", "offset %lld us, expected at most %lld either way", (long long)settings->offset_us,
                   (long long)max_offset_us);
        return NULL;
    }
    hal_time_t *clock = malloc(sizeof *clock);
    if (clock == NULL) {
        file_error(error, "clock", "out of memory");
        return NULL;
    }
    *clock = (hal_time_t){.settings = *settings};
    if (settings->real)
        clock->settings.epoch_us = sim_clock_monotonic_us();
    clock->now_us = clock->settings.epoch_us;
    return clock;
}

void sim_clock_destroy(hal_time_t *clock)
{
    free(clock);
}

void sim_clock_set_us(hal_time_t *clock, int64_t time_us)
{
    assert(!clock->settings.real && time_us >= clock->now_us);
    clock->now_us = time_us;
}

void sim_clock_work(hal_time_t *clock, int64_t work_us)
{
    if (!clock->settings.real)
        clock->now_us += work_us;
}

/* Never goes back: in the time that the drift takes away one microsecond, at least 100 pass. */
int64_t sim_clock_shows_us(const hal_time_t *clock, int64_t time_us)
{
    const sim_clock_settings_t *settings = &clock->settings;
    const int64_t elapsed_us = time_us - settings->epoch_us;
    const int64_t drift_ppb = settings->drift_ppb;
    /* In two parts, so that no product passes 2^63: |drift| <= 10^7, the rest of a division by 10^9 is below 10^9. */
    const int64_t drifted_us = elapsed_us / BILLION * drift_ppb + elapsed_us % BILLION * drift_ppb / BILLION;
    return time_us + settings->offset_us + drifted_us;
}

int64_t sim_clock_time_us(const hal_time_t *clock)
{
    return clock->settings.real ? sim_clock_monotonic_us() : clock->now_us;
}

int64_t hal_time_now_us(const hal_time_t *clock)
{
    return sim_clock_shows_us(clock, sim_clock_time_us(clock));
}

bool sim_clock_is_real(const hal_time_t *clock)
{
    return clock->settings.real;
}

/* A drifting clock is off by 1 % of the sleep at most: each further sleep leaves a hundredth of the rest. */
void sim_clock_sleep_until_us(const hal_time_t *clock, int64_t board_time_us)
{
    if (!clock->settings.real)
        return;
    for (int64_t rest_us = board_time_us - hal_time_now_us(clock); rest_us > 0;
         rest_us = board_time_us - hal_time_now_us(clock)) {
        const struct timespec rest = {.tv_sec = rest_us / US_PER_S, .tv_nsec = rest_us % US_PER_S * NS_PER_US};
        clock_nanosleep(CLOCK_MONOTONIC, 0, &rest, NULL);
    }
}
