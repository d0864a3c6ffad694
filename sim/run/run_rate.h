// SPDX-License-Identifier: Apache-2.0
// The refresh rate of a run, and how many frames a pose list lasts.
#ifndef SIM_RUN_RUN_RATE_H
#define SIM_RUN_RUN_RATE_H

#include "firmware/frame_rate.h"
#include "sim/devices/sim_rate.h"
#include "sim/pose/pose_list.h"

enum { RUN_RATE_LEAST_HZ = 1, RUN_RATE_USUAL_HZ = 60, RUN_RATE_MAX_HZ = 240 };

/** @return The rate, with beat 0 half a period after 0: so is it of all that follow, whose rates are frame_rate_t too.
 */
sim_rate_t run_rate_from_frames(frame_rate_t rate);

/** @param hz  RUN_RATE_LEAST_HZ to RUN_RATE_MAX_HZ; like 59.94 it is 60000 / 1001, else taken to 1/1000 Hz. */
sim_rate_t run_rate_from_hz(double hz);

/**
 * @return The list's median rate, RUN_RATE_LEAST_HZ to RUN_RATE_USUAL_HZ, which it also is when the list has no rate (a
 *         single pose). Whole Hz, or like 59.94, when the times, rounded to 1 us, allow it.
 */
sim_rate_t run_rate_of_poses(const pose_list_t *list);

/** @return How many frames of that rate the list lasts, its last pose included; 1 or more. */
int64_t run_rate_frames(const sim_rate_t *rate, const pose_list_t *list);

#endif
