// SPDX-License-Identifier: Apache-2.0
// A steady beat: pictures of a camera, blanks of a display.
#include "sim/devices/sim_rate.h"

__extension__ typedef __int128 wide_t;

enum { US_PER_S = 1000000 };

static int64_t floor_divide(wide_t value, wide_t divisor)
{
    const wide_t quotient = value / divisor;
    return (int64_t)(value % divisor < 0 ? quotient - 1 : quotient);
}

bool sim_rate_is_valid(const sim_rate_t *rate)
{
    return rate->frames >= 1 && rate->seconds >= 1 && rate->frames <= (int64_t)rate->seconds * US_PER_S;
}

int64_t sim_rate_time_us(const sim_rate_t *rate, int64_t n)
{
    return rate->start_us + floor_divide((wide_t)n * rate->seconds * US_PER_S, rate->frames);
}

/* floor(n P / F) <= d  <=>  n P < (d + 1) F  <=>  n <= ((d + 1) F - 1) / P, rounded down. */
int64_t sim_rate_beat_at(const sim_rate_t *rate, int64_t time_us)
{
    const wide_t since_us = (wide_t)time_us - rate->start_us;
    return floor_divide((since_us + 1) * rate->frames - 1, (wide_t)rate->seconds * US_PER_S);
}
