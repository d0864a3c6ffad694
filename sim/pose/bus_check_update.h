// SPDX-License-Identifier: Apache-2.0
// Judges whether the boards run one version of the firmware.
#ifndef SIM_POSE_BUS_CHECK_UPDATE_H
#define SIM_POSE_BUS_CHECK_UPDATE_H

#include "sim/pose/bus_judge.h"
#include "sim/pose/bus_watch.h"

/** Say which boards run another version than the first, have failed to install one, or have not marked theirs good;
 *  nothing of boards without an update agent. */
void bus_check_updates(bus_judge_t *judge, const bus_watch_t *watch);

#endif
