// SPDX-License-Identifier: Apache-2.0
// An operator who updates the board of operator_bench.h.
#ifndef TESTS_FIRMWARE_UPDATE_BENCH_H
#define TESTS_FIRMWARE_UPDATE_BENCH_H

#include "firmware/update_status.h"
#include "sim/devices/sim_update.h"
#include "tests/firmware/operator_bench.h"

static const char bundle[] = "/wallwarp-host-0.6.raucb";

static inline void ask_update(command_update_t update, uint64_t bus_time_us, const char *text, update_refusal_t refusal)
{
    command_t command = {.kind = COMMAND_UPDATE, .update = update, .bus_time_us = bus_time_us};
    memcpy(command.text, text, strlen(text) + 1);
    ask_command(command, refusal == UPDATE_DONE ? COMMAND_OK : COMMAND_IMPOSSIBLE);
    if (refusal == UPDATE_DONE)
        return;
    assert_int_equal(operator.length, 3);
    assert_int_equal(operator.reply[2], refusal);
}

static inline update_status_t status(void)
{
    update_status_t said;
    ask_update(COMMAND_UPDATE_STATUS, 0, "", UPDATE_DONE);
    assert_true(update_status_decode(&said, operator.reply + 2, operator.length - 2));
    return said;
}

/* Until the board has bus time, and a version waits. */
static inline void install(void)
{
    room_bench_run(&bench, 6000);
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_DONE);
    room_bench_run(&bench, ROOM_BENCH_INSTALL_US / 1000 + 2300);
    assert_int_equal(status().state, CAN_UPDATE_READY);
}

/* @return The moment, in bus time. */
static inline uint64_t switch_in(uint64_t ahead_us)
{
    const uint64_t at_us = status().bus_time_us + ahead_us;
    ask_update(COMMAND_UPDATE_SWITCH, at_us, "0.6", UPDATE_DONE);
    ask_update(COMMAND_UPDATE_CONFIRM, at_us, "", UPDATE_DONE);
    return at_us;
}

#endif
