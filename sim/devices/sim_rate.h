// SPDX-License-Identifier: Apache-2.0
// A steady beat: pictures of a camera, blanks of a display.
#ifndef SIM_DEVICES_SIM_RATE_H
#define SIM_DEVICES_SIM_RATE_H

#include <stdbool.h>
#include <stdint.h>

/** Beat n (any integer) is at start_us + floor(n * seconds * 1000000 / frames). */
typedef struct {
    int64_t start_us;        /**< when beat 0 is */
    int32_t frames, seconds; /**< frames beats in seconds seconds; 60000 in 1001 is 59.94 Hz. Both 1 or more */
} sim_rate_t;

/** @return Whether the rate is one: both parts 1 or more, and not faster than a beat each microsecond. */
bool sim_rate_is_valid(const sim_rate_t *rate);

/** @return When beat n is. Exact for any n whose time fits 64 bits. */
int64_t sim_rate_time_us(const sim_rate_t *rate, int64_t n);

/** @return The last beat at or before that time; negative before beat 0. */
int64_t sim_rate_beat_at(const sim_rate_t *rate, int64_t time_us);

#endif
