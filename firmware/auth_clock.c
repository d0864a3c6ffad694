// SPDX-License-Identifier: Apache-2.0
// The least that bus time can be.
#include "firmware/auth_clock.h"

enum { MILLION = 1000000 };

static int64_t drift_us(const auth_clock_t *clock, int64_t local_us)
{
    const int64_t silent_us = local_us - clock->local_us;
    return silent_us > 0 ? silent_us / MILLION * AUTH_CLOCK_MAX_PPM + AUTH_CLOCK_MAX_PPM : 0;
}

uint64_t auth_clock_least_us(const auth_clock_t *clock, int64_t local_us)
{
    const int64_t least_us = (int64_t)clock->bus_us + (local_us - clock->local_us) - drift_us(clock, local_us);
    return least_us > 0 ? (uint64_t)least_us : 0;
}

void auth_clock_begin(auth_clock_t *clock, uint64_t bus_us, int64_t local_us)
{
    *clock = (auth_clock_t){.bus_us = bus_us, .local_us = local_us, .begun = true};
}

void auth_clock_hear(auth_clock_t *clock, uint64_t bus_us, int64_t local_us)
{
    const uint64_t least_us = auth_clock_least_us(clock, local_us);
    if (bus_us > least_us)
        *clock = (auth_clock_t){.bus_us = bus_us, .local_us = local_us};
    clock->begun = false;
}

can_auth_window_t auth_clock_window(const auth_clock_t *clock, int64_t local_us)
{
    return (can_auth_window_t){
        .now_us = auth_clock_least_us(clock, local_us),
        .past_us = AUTH_CLOCK_PAST_US,
        .future_us =
            (clock->begun ? AUTH_CLOCK_FIRST_US : AUTH_CLOCK_AHEAD_US) + 2 * (uint64_t)drift_us(clock, local_us),
    };
}

uint64_t auth_clock_sign_us(const auth_clock_t *clock, int64_t bus_us, int64_t local_us)
{
    const can_auth_window_t window = auth_clock_window(clock, local_us);
    const bool can_be =
        bus_us >= 0 && (uint64_t)bus_us >= window.now_us && (uint64_t)bus_us - window.now_us <= window.future_us;
    return can_be ? (uint64_t)bus_us : window.now_us;
}
