// SPDX-License-Identifier: Apache-2.0
// Judges how late boards are, what they have counted, and why they are not in step.
#ifndef SIM_POSE_BUS_CHECK_LATENCY_H
#define SIM_POSE_BUS_CHECK_LATENCY_H

#include "sim/pose/bus_judge.h"
#include "sim/pose/bus_watch.h"

/** @return A short name of the fault: "in step", "no picture". */
const char *bus_check_step_name(can_step_fault_t fault);

/** @return What to look at when a board was not in step, by its newest Latency. */
const char *bus_check_step_advice(const bus_watch_board_t *board);

/** Say what one board has counted since it was heard first, and should not have. */
void bus_check_counts(bus_judge_t *judge, int node, const bus_watch_board_t *board);

/** Say how late the boards are; nothing when none has told. */
void bus_check_latency(bus_judge_t *judge, const bus_watch_t *watch);

#endif
