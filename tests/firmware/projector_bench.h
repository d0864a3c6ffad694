// SPDX-License-Identifier: Apache-2.0
// A projector in a small room, for tests of the loop body: the first of two boards.
#ifndef TESTS_FIRMWARE_PROJECTOR_BENCH_H
#define TESTS_FIRMWARE_PROJECTOR_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sim/devices/sim_camera.h"
#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_display.h"
#include "sim/devices/sim_gpio.h"
#include "sim/devices/sim_watchdog.h"
#include "tests/support/room_bench.h"

static room_bench_t bench;

static inline int open_bench(void **state)
{
    (void)state;
    room_bench_open(&bench, true);
    return 0;
}

static inline int close_bench(void **state)
{
    (void)state;
    room_bench_close(&bench);
    return 0;
}

static inline const projector_report_t *report(void)
{
    return room_bench_report(&bench, 0);
}

static inline const projector_t *projector(void)
{
    return sim_world_projector(bench.world, 0);
}

static inline const hal_board_t *devices(void)
{
    return sim_world_devices(bench.world, 0);
}

static inline bool expired(void)
{
    return sim_watchdog_expired(devices()->watchdog, room_bench_now_us(&bench));
}

static inline void start_running(void)
{
    bench.tracking = true;
    room_bench_run(&bench, 1200);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(report()->corrected);
}

/* Running, drawn for the newest pose, nothing new in the heartbeat, and the watchdog content. */
static inline void assert_well_again(void)
{
    room_bench_run(&bench, 1100);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(report()->corrected);
    assert_int_equal(report()->pose_counter, (uint8_t)(bench.poses - 1));
    assert_null(room_bench_safe_reason(&bench, 0));
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, 0);
    assert_int_equal(bench.voice[0].heartbeat.state, CAN_BOARD_RUNNING);
    assert_false(expired());
}

#endif
