// SPDX-License-Identifier: Apache-2.0
// Tests of what the loop body tells the service manager: ready with the first picture, life as to the watchdog, state.
#include "tests/firmware/projector_bench.h"

#include "sim/devices/sim_service.h"

static const sim_service_heard_t *heard(void)
{
    return sim_service_heard(devices()->service);
}

static void test_ready_with_the_first_picture(void **state)
{
    (void)state;
    sim_display_faults(devices()->display)->unplugged_until_us = room_bench_now_us(&bench) + 300000;
    room_bench_run(&bench, 250);
    assert_int_equal(report()->frame_number, 0);
    assert_int_equal(heard()->ready_us, INT64_MIN);
    assert_false(heard()->last.showing);
    room_bench_run(&bench, 250);
    assert_true(report()->frame_number > 0);
    assert_true(heard()->ready_us > INT64_MIN);
    assert_true(heard()->last.showing);
}

static void test_every_step_is_told_with_its_state(void **state)
{
    (void)state;
    start_running();
    assert_string_equal(heard()->last.state, "running");
    assert_true(heard()->last.healthy);
    const uint64_t reports = heard()->reports, states = heard()->states;
    room_bench_step(&bench);
    assert_int_equal(heard()->reports, reports + 1);
    assert_int_equal(heard()->states, states);
    bench.tracking = false;
    room_bench_run(&bench, 500);
    assert_string_equal(heard()->last.state, "holding");
    room_bench_run(&bench, 1000);
    assert_string_equal(heard()->last.state, "safe");
    assert_int_equal(heard()->states, states + 2);
}

static void test_no_life_where_the_watchdog_is_not_fed(void **state)
{
    (void)state;
    start_running();
    sim_display_faults(devices()->display)->late_blanks = 1000000;
    sim_display_faults(devices()->display)->late_next = 1;
    room_bench_run(&bench, 300);
    assert_string_equal(heard()->last.state, "fault");
    assert_false(heard()->last.healthy);
    const uint64_t healthy = heard()->healthy;
    room_bench_run(&bench, 2000);
    assert_int_equal(heard()->healthy, healthy);
    assert_true(expired());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_ready_with_the_first_picture, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_every_step_is_told_with_its_state, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_no_life_where_the_watchdog_is_not_fed, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
