// SPDX-License-Identifier: Apache-2.0
// The house's genlock signal of a run: edges on the boards' inputs, and how far from them refreshes begin.
#ifndef SIM_RUN_HOUSE_SIGNAL_H
#define SIM_RUN_HOUSE_SIGNAL_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/run/run_record.h"
#include "sim/run/sim_world.h"

/** As on the command line. All zero: there is no house signal. */
typedef struct {
    bool on;
    int32_t ppm;  /**< how much faster than the panels it is, -1000 to 1000 */
    int32_t node; /**< the one board that has it; 0: all */
} house_signal_options_t;

typedef struct {
    house_signal_options_t options;
    sim_rate_t refresh; /**< of the panels, with whose beat 0 it begins */
    int64_t next;       /**< edge to come */
} house_signal_t;

/** Let the inputs rise at all edges up to now. Call it before the boards' steps, once a refresh. */
void house_signal_advance(house_signal_t *house, const sim_world_t *world, const room_t *room, int64_t now_us);

/** Note in the newest frame who leads, and where the house's edges are. Call it after the boards' steps. */
void house_signal_note(run_frame_t *frame, const sim_world_t *world, const room_t *room);

#endif
