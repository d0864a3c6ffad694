// SPDX-License-Identifier: Apache-2.0
// A board's clock in the simulator (hal/hal_time.h): virtual or real time, with an offset and a drift of its own.
#ifndef SIM_DEVICES_SIM_CLOCK_H
#define SIM_DEVICES_SIM_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_time.h"
#include "sim/files/file_io.h"

enum { SIM_CLOCK_MAX_DRIFT_PPB = 10000000 };

/**
 * The board's clock shows t + offset_us + (t - epoch_us) * drift_ppb / 10^9 (rounded toward 0), where t is the
 * simulation's time. Boards of one simulation share epoch_us and are all set to the same t.
 */
typedef struct {
    bool real;         /**< t is CLOCK_MONOTONIC, else what sim_clock_set_us() says */
    int64_t epoch_us;  /**< virtual: t at the start; real: ignored, the epoch is the moment of creation */
    int64_t offset_us; /**< up to +-10^15 */
    int32_t drift_ppb; /**< up to +-SIM_CLOCK_MAX_DRIFT_PPB (1 %); positive runs fast */
} sim_clock_settings_t;

/** @return A clock, or NULL with the reason in error: a setting is out of range, or no memory. Uses the heap. */
hal_time_t *sim_clock_create(const sim_clock_settings_t *settings, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_clock_destroy(hal_time_t *clock);

/** Set a virtual clock's t. Must not go back, nor be called for a real clock: both are bugs of the caller. */
void sim_clock_set_us(hal_time_t *clock, int64_t time_us);

/** Let a virtual clock's t move on while its board is at work; a real one moves by itself. @param work_us  0 or more.
 */
void sim_clock_work(hal_time_t *clock, int64_t work_us);

/** @return The simulation's time t, as this clock knows it. */
int64_t sim_clock_time_us(const hal_time_t *clock);

/** @return What the board's clock shows when the simulation's time is t; for any t from the epoch on. */
int64_t sim_clock_shows_us(const hal_time_t *clock, int64_t time_us);

/** @return Whether the clock runs by itself. */
bool sim_clock_is_real(const hal_time_t *clock);

/** @return CLOCK_MONOTONIC of this machine, us: what t is for real clocks. */
int64_t sim_clock_monotonic_us(void);

/** Sleep until the board's clock shows that time. Returns at once when it has passed, or when the clock is virtual. */
void sim_clock_sleep_until_us(const hal_time_t *clock, int64_t board_time_us);

#endif
