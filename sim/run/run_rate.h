// SPDX-License-Identifier: Apache-2.0
// The refresh rate of a run, and how many frames a pose list lasts.
#ifndef SIM_RUN_RUN_RATE_H
#define SIM_RUN_RUN_RATE_H

#include "sim/devices/sim_rate.h"
#include "sim/pose/pose_list.h"

enum { RUN_RATE_USUAL_HZ = 60, RUN_RATE_MAX_HZ = 1000 };

/**
 * @param hz  Above 0, up to RUN_RATE_MAX_HZ; taken to 1/1000 Hz, at least that.
 * @return The rate, with beat 0 half a period after 0.
 */
sim_rate_t run_rate_from_hz(double hz);

/**
 * @return The list's median rate, up to RUN_RATE_USUAL_HZ, which it also is when the list has no rate (a single pose);
 *         beat 0 is half a period after 0. A whole number of Hz when the times, rounded to 1 us, allow it.
 */
sim_rate_t run_rate_of_poses(const pose_list_t *list);

/** @return How many frames of that rate the list lasts, its last pose included; 1 or more. */
int64_t run_rate_frames(const sim_rate_t *rate, const pose_list_t *list);

#endif
