// SPDX-License-Identifier: Apache-2.0
// Refreshes and microseconds, exactly, at any rate.
#include "firmware/frame_rate.h"

static const int64_t us_per_s = 1000000;

static int64_t floor_divide(int64_t a, int64_t b)
{
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/* In two parts, so that no product passes 2^63. */
int64_t frame_rate_length_us(frame_rate_t rate, int64_t n)
{
    const int64_t turns = floor_divide(n, rate.frames), rest = n - turns * rate.frames;
    return turns * rate.seconds * us_per_s + rest * rate.seconds * us_per_s / rate.frames;
}

int64_t frame_rate_before(frame_rate_t rate, int64_t time_us)
{
    const int64_t turn_us = rate.seconds * us_per_s;
    const int64_t turns = floor_divide(time_us, turn_us), rest_us = time_us - turns * turn_us;
    int64_t n = turns * rate.frames + rest_us * rate.frames / turn_us;
    while (frame_rate_length_us(rate, n + 1) <= time_us) /* once at most: lengths are rounded down */
        n++;
    return n;
}

int32_t frame_rate_period_us(frame_rate_t rate)
{
    return (int32_t)((rate.seconds * us_per_s + rate.frames / 2) / rate.frames);
}
