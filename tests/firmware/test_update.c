// SPDX-License-Identifier: Apache-2.0
// Tests of a board's update: an operator has it install and switch.
#include "tests/firmware/update_bench.h"

enum { ONE_TURN_MS = 2000 / ROOM_BENCH_HZ }; /* so soon the bus tells of a change */

static void test_install(void **state)
{
    (void)state;
    update_status_t said = status();
    assert_int_equal(said.state, CAN_UPDATE_IDLE);
    assert_string_equal(said.running, "0.5");
    assert_int_equal(said.slot, 'A');
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_DONE);
    assert_int_equal(status().state, CAN_UPDATE_INSTALLING); /* before the agent says so */
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_DONE);
    ask_update(COMMAND_UPDATE_INSTALL, 0, "/wallwarp-host-0.7.raucb", UPDATE_BUSY);
    room_bench_run(&bench, 2000);
    said = status();
    assert_int_equal(said.state, CAN_UPDATE_INSTALLING);
    assert_in_range(said.progress, 40, 99);
    room_bench_run(&bench, 1500);
    said = status();
    assert_int_equal(said.state, CAN_UPDATE_READY);
    assert_string_equal(said.waiting, "0.6");
    room_bench_run(&bench, 1100);
    const can_update_t *heard = &bench.voice[0].update;
    assert_int_equal(heard->state, CAN_UPDATE_READY);
    assert_int_equal(heard->progress, 100);
    assert_int_equal(heard->slot, 1);
    assert_int_equal(heard->running, can_update_fingerprint("0.5"));
    assert_int_equal(heard->waiting, can_update_fingerprint("0.6"));
    assert_false(heard->trial);
    assert_string_equal(said.other, "0.6");
    assert_false(said.trial);
    assert_well_again();
}

static void test_install_that_fails(void **state)
{
    (void)state;
    sim_update_faults(devices()->update)->install = true;
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_DONE);
    room_bench_run(&bench, 4300);
    const update_status_t said = status();
    assert_int_equal(said.state, CAN_UPDATE_FAILED);
    assert_non_null(strstr(said.message, "signature"));
    ask_update(COMMAND_UPDATE_SWITCH, said.bus_time_us + 5000000, "0.6", UPDATE_NOT_THERE);
}

static void test_switch_is_refused(void **state)
{
    (void)state;
    ask_update(COMMAND_UPDATE_SWITCH, status().bus_time_us + 5000000, "0.6", UPDATE_NOT_THERE);
    ask_update(COMMAND_UPDATE_CONFIRM, 5000000, "", UPDATE_NO_PROMISE);
    install();
    const uint64_t now_us = status().bus_time_us;
    ask_update(COMMAND_UPDATE_SWITCH, now_us + 5000000, "0.7", UPDATE_NOT_THERE);
    ask_update(COMMAND_UPDATE_SWITCH, now_us + 5000000, "0.5", UPDATE_NOT_THERE);
    ask_update(COMMAND_UPDATE_SWITCH, now_us, "0.6", UPDATE_BAD_TIME);
    ask_update(COMMAND_UPDATE_SWITCH, now_us + 62000000, "0.6", UPDATE_BAD_TIME);
    assert_int_equal(status().plan, UPDATE_NO_PLAN);
    ask_update(COMMAND_UPDATE_SWITCH, now_us + 5000000, "0.6", UPDATE_DONE);
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_BUSY);
    ask_update(COMMAND_UPDATE_CONFIRM, now_us + 5000001, "", UPDATE_NO_PROMISE);
    assert_int_equal(status().plan, UPDATE_PROMISED);
    assert_int_equal(status().switch_bus_us, now_us + 5000000);
}

static int64_t switched_us(int board)
{
    return sim_update_switched_us(sim_world_devices(bench.world, board)->update);
}

static void test_switch_without_confirmation_is_dropped(void **state)
{
    (void)state;
    install();
    const uint64_t at_us = status().bus_time_us + 1500000;
    ask_update(COMMAND_UPDATE_SWITCH, at_us, "0.6", UPDATE_DONE);
    room_bench_run(&bench, ONE_TURN_MS);
    assert_int_equal(bench.voice[0].update.plan, UPDATE_PROMISED);
    room_bench_run(&bench, 2000);
    assert_true(switched_us(0) == INT64_MIN);
    assert_int_equal(status().plan, UPDATE_NO_PLAN);
    ask_update(COMMAND_UPDATE_CONFIRM, at_us, "", UPDATE_NO_PROMISE);
    assert_well_again();
}

static void test_switch_that_is_cancelled(void **state)
{
    (void)state;
    install();
    const uint64_t at_us = status().bus_time_us + 1500000;
    ask_update(COMMAND_UPDATE_SWITCH, at_us, "0.6", UPDATE_DONE);
    ask_update(COMMAND_UPDATE_CONFIRM, at_us, "", UPDATE_DONE);
    ask_update(COMMAND_UPDATE_SWITCH, at_us, "0.6", UPDATE_DONE); /* again: stays confirmed */
    ask_update(COMMAND_UPDATE_SWITCH, at_us + 5000000, "0.6", UPDATE_BUSY);
    assert_int_equal(status().plan, UPDATE_CONFIRMED);
    ask_update(COMMAND_UPDATE_CANCEL, 0, "", UPDATE_DONE);
    ask_update(COMMAND_UPDATE_CANCEL, 0, "", UPDATE_DONE);
    room_bench_run(&bench, 2000);
    assert_true(switched_us(0) == INT64_MIN);
}

/* Somebody plugs a stick in: what was promised is not there any more. */
static void test_promise_ends_with_what_it_was_for(void **state)
{
    (void)state;
    install();
    const uint64_t at_us = status().bus_time_us + 3000000;
    ask_update(COMMAND_UPDATE_SWITCH, at_us, "0.6", UPDATE_DONE);
    assert_int_equal(hal_update_install(devices()->update, "/wallwarp-host-0.7.raucb"), HAL_OK);
    room_bench_run(&bench, 1500);
    assert_int_equal(status().plan, UPDATE_NO_PLAN);
    ask_update(COMMAND_UPDATE_CONFIRM, at_us, "", UPDATE_NO_PROMISE);
}

static void test_switch_at_its_moment(void **state)
{
    (void)state;
    install();
    const uint64_t at_us = switch_in(2000000);
    const int64_t local_us = projector()->update.switch_us, period_us = 1000000 / ROOM_BENCH_HZ;
    assert_int_equal(bus_time_from_local(&projector()->time.time, local_us), at_us);
    room_bench_run(&bench, ONE_TURN_MS);
    assert_int_equal(bench.voice[0].update.plan, UPDATE_CONFIRMED);
    room_bench_run(&bench, 2300);
    assert_int_equal(bench.voice[0].update.state, CAN_UPDATE_SWITCHING);
    assert_int_equal(bench.voice[0].update.plan, UPDATE_NO_PLAN);
    assert_in_range(switched_us(0), local_us, local_us + period_us);
    room_bench_run(&bench, 1000);
    const uint32_t frames = report()->frame_number;
    room_bench_run(&bench, 1000);
    assert_int_equal(report()->frame_number, frames); /* it is down */
    assert_null(sim_world_shown(bench.world, 0, room_bench_now_us(&bench)));
    room_bench_run(&bench, 2500);
    const update_status_t said = status();
    assert_string_equal(said.running, "0.6");
    assert_string_equal(said.other, "0.5");
    assert_int_equal(said.slot, 'B');
    assert_true(said.trial);
    assert_int_equal(said.state, CAN_UPDATE_IDLE);
    room_bench_run(&bench, 1100);
    assert_true(bench.voice[0].update.trial);
    assert_int_equal(bench.voice[0].update.slot, 2);
    ask_update(COMMAND_UPDATE_INSTALL, 0, bundle, UPDATE_ON_TRIAL);
}

static void test_version_that_does_not_start(void **state)
{
    (void)state;
    install();
    sim_update_faults(devices()->update)->start = true;
    (void)switch_in(1000000);
    room_bench_run(&bench, 1400 + 4 * ROOM_BENCH_REBOOT_US / 1000);
    const update_status_t said = status();
    assert_string_equal(said.running, "0.5");
    assert_int_equal(said.state, CAN_UPDATE_FAILED);
    assert_non_null(strstr(said.message, "did not start"));
    assert_well_again();
}

static void test_log_has_it(void **state)
{
    (void)state;
    install();
    const event_log_t *log = &projector()->events.log;
    bool commanded = false;
    uint32_t updates = 0;
    for (uint32_t i = 0; i < log->count; i++) {
        const event_t *event = &log->entry[i % EVENT_LOG_ENTRIES];
        commanded |=
            event->kind == EVENT_COMMAND && event->value == COMMAND_UPDATE + EVENT_ARGUMENT * COMMAND_UPDATE_INSTALL;
        updates += event->kind == EVENT_UPDATE;
        assert_true(event->kind != EVENT_COMMAND || event->value != COMMAND_UPDATE); /* status is not logged */
    }
    assert_true(commanded);
    assert_int_equal(updates, 3); /* idle, installing, ready */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_install, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_install_that_fails, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_switch_is_refused, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_switch_without_confirmation_is_dropped, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_switch_that_is_cancelled, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_promise_ends_with_what_it_was_for, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_switch_at_its_moment, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_version_that_does_not_start, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_log_has_it, open_operator, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
