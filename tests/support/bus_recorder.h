// SPDX-License-Identifier: Apache-2.0
// For tests of the simulated bus: a log of its frames, and random frames.
#ifndef TESTS_SUPPORT_BUS_RECORDER_H
#define TESTS_SUPPORT_BUS_RECORDER_H

#include "sim/bus/sim_bus.h"

enum { BUS_RECORDER_FRAMES = 4096 };

typedef struct {
    int count;
    int sender[BUS_RECORDER_FRAMES];
    hal_can_frame_t frame[BUS_RECORDER_FRAMES];
} bus_recorder_t;

/** A sim_bus_log_fn whose context is a bus_recorder_t; what does not fit is left out. */
void bus_recorder_note(void *context, int sender, const hal_can_frame_t *frame);

/** @return The next of a sequence; the state must not be 0. */
uint64_t bus_random(uint64_t *state);

/** @return A legal frame of any kind. */
hal_can_frame_t bus_random_frame(uint64_t *state, bool may_be_fd);

#endif
