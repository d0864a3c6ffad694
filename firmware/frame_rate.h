// SPDX-License-Identifier: Apache-2.0
// Refreshes and microseconds, exactly, at any rate.
#ifndef FIRMWARE_FRAME_RATE_H
#define FIRMWARE_FRAME_RATE_H

#include <stdint.h>

/** Refreshes a second as a fraction: 60 / 1, 60000 / 1001. 1 to 240 Hz, both up to 240240. */
typedef struct {
    int32_t frames, seconds;
} frame_rate_t;

/** @return Microseconds from refresh 0 to refresh n, rounded down. @param n  Within +-2^40. */
int64_t frame_rate_length_us(frame_rate_t rate, int64_t n);

/** @return The last refresh that begins at this time or before, when refresh 0 begins at 0. */
int64_t frame_rate_before(frame_rate_t rate, int64_t time_us);

/** @return The period rounded to microseconds. */
int32_t frame_rate_period_us(frame_rate_t rate);

#endif
