// SPDX-License-Identifier: Apache-2.0
// A board's update by itself, and the agent of a simulated board, for tests.
#ifndef TESTS_FIRMWARE_ALONE_BENCH_H
#define TESTS_FIRMWARE_ALONE_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/projector.h"
#include "sim/bus/sim_bus.h"
#include "sim/devices/sim_update.h"

static const int64_t T0_US = 7000000, OFF_US = 123456789;

static projector_t projector; /* nothing but what an update needs */
static hal_update_t *agent;
static sim_bus_t *bus;

static inline int open_board(void **state)
{
    (void)state;
    static const sim_update_settings_t settings = {.running = "0.5", .install_us = 1000000, .reboot_us = 1000000};
    char error[FILE_ERROR_LENGTH] = "";
    const sim_bus_config_t config = {.bitrate = 500000};
    bus = sim_bus_create(&config);
    assert_non_null(bus);
    agent = sim_update_create(&settings, T0_US, error);
    assert_string_equal(error, "");
    projector.board.can = sim_bus_attach(bus);
    projector.board.update = agent;
    projector.time = (bus_master_t){.own = true};
    memset(&projector.report, 0, sizeof projector.report);
    bus_time_begin(&projector.time.time, T0_US, T0_US + OFF_US);
    update_init(&projector.update, T0_US);
    update_step(&projector, T0_US);
    return 0;
}

static inline int close_board(void **state)
{
    (void)state;
    sim_update_destroy(agent);
    sim_bus_destroy(bus);
    return 0;
}

static inline update_refusal_t ask(command_update_t update, int64_t at_us, const char *text, int64_t now_us)
{
    command_t command = {.kind = COMMAND_UPDATE, .update = update, .bus_time_us = (uint64_t)(at_us + OFF_US)};
    memcpy(command.text, text, strlen(text) + 1);
    return update_execute(&projector, &command, now_us);
}

/* A second of the agent and of the board. */
static inline void run_s(int64_t *now_us, int seconds)
{
    for (int i = 0; i < seconds; i++) {
        *now_us += 1000000;
        assert_int_not_equal(sim_update_advance(agent, *now_us), SIM_UPDATE_STARTS);
        update_step(&projector, *now_us);
    }
}

static inline int64_t install(void)
{
    int64_t now_us = T0_US;
    assert_int_equal(ask(COMMAND_UPDATE_INSTALL, 0, "/wallwarp-host-0.6.raucb", now_us), UPDATE_DONE);
    run_s(&now_us, 4);
    assert_int_equal(projector.update.said.doing, HAL_UPDATE_READY);
    return now_us;
}

/* So many frames with this report. @return Those that are healthy in a row. */
static inline int32_t healthy_after(int frames, can_board_state_t board, bool shown, bool late)
{
    projector.report.state = board;
    projector.report.times.shown = shown;
    projector.report.times.late = late;
    for (int i = 0; i < frames; i++)
        update_step(&projector, T0_US);
    return projector.update.healthy;
}

#endif
