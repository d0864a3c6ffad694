// SPDX-License-Identifier: Apache-2.0
// For tests of the simulated bus: three controllers, and numbered frames.
#ifndef TESTS_SUPPORT_BUS_BENCH_H
#define TESTS_SUPPORT_BUS_BENCH_H

#include "sim/bus/sim_bus.h"

enum { BUS_BENCH_BIT_US = 2 };

/** A classic bus of 500 kbit/s. */
typedef struct {
    sim_bus_t *bus;
    hal_can_t *a, *b, *c;
} bus_bench_t;

/** @return A new bus, for sim_bus_destroy(). */
bus_bench_t bus_bench_begin(void);

void bus_bench_run_for(const bus_bench_t *bench, int64_t us);

/** Let a send frames of identifier 5 numbered from 0, 1 ms apart. */
void bus_bench_send_numbers(const bus_bench_t *bench, int count);

/** @return The number in a frame of bus_bench_send_numbers(). */
int bus_bench_number(const hal_can_frame_t *frame);

/** Take all that a controller has heard. @return How many. */
int bus_bench_count_heard(hal_can_t *can);

#endif
