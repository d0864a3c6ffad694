// SPDX-License-Identifier: Apache-2.0
// Fault confinement: error counters, error passive, bus-off and the way back.
#include "sim/bus/sim_bus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/bus_bench.h"
#include "tests/support/bus_recorder.h"

static void test_error_frames_are_counted_and_the_frame_is_sent_again(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 3, .only = bench.a});
    assert_int_equal(hal_can_send(bench.b, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(sim_bus_stats(bench.bus).error_frames, 0);
    const int64_t before_ns = sim_bus_stats(bench.bus).busy_ns;
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 2000);
    assert_int_equal(bus_bench_count_heard(bench.c), 2);
    assert_int_equal(sim_can_stats(bench.a).tec, 24 - 1);
    assert_int_equal(sim_can_stats(bench.b).rec, 3 - 1);
    assert_int_equal(sim_can_stats(bench.a).transmit_errors, 3);
    assert_int_equal(sim_bus_stats(bench.bus).error_frames, 3);
    /* three times 41 bits to the CRC delimiter, 20 of error frame, 3 of intermission; then the whole 53 */
    assert_int_equal(sim_bus_stats(bench.bus).busy_ns - before_ns, (3 * (41 + 20 + 3) + 53) * BUS_BENCH_BIT_US * 1000);
    sim_bus_destroy(bench.bus);
}

/* 16 errors make the sender passive, 32 bus-off; it is back 128 x 11 bits after the restart. */
static void test_errors_lead_to_passive_and_bus_off_and_back(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 15});
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_ACTIVE);
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 2});
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(sim_can_stats(bench.a).tec, 15 * 8 - 1 + 2 * 8 - 1);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_PASSIVE);
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.ppm = 1000000});
    for (int i = 0; i < 3; i++)
        assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_BUS_OFF);
    assert_int_equal(sim_can_stats(bench.a).discarded, 3);
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_IO);
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){0});
    assert_int_equal(hal_can_restart(bench.a), HAL_OK);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(hal_can_restart(bench.a), HAL_OK); /* does not begin anew */
    bus_bench_run_for(&bench, 128 * 11 * BUS_BENCH_BIT_US - 1001);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_BUS_OFF);
    bus_bench_run_for(&bench, 1);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_ACTIVE);
    assert_int_equal(sim_can_stats(bench.a).tec, 0);
    bus_bench_count_heard(bench.b);
    bus_bench_send_numbers(&bench, 2);
    assert_int_equal(bus_bench_count_heard(bench.b), 2);
    sim_bus_destroy(bench.bus);
}

/* An error passive sender gives way for 8 bits after each of its frames. */
static void test_passive_sender_suspends_transmission(void **state)
{
    (void)state;
    static bus_recorder_t log;
    const bus_bench_t bench = bus_bench_begin();
    log.count = 0;
    sim_bus_set_log(bench.bus, bus_recorder_note, &log);
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 20});
    for (int i = 0; i < 3; i++)
        assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(log.count, 3);
    assert_int_equal(log.frame[2].time_us - log.frame[1].time_us, (53 + 8) * BUS_BENCH_BIT_US);
    sim_bus_destroy(bench.bus);
}

static void test_forced_bus_off_silences_one_controller(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail_bus_off(bench.b);
    assert_int_equal(hal_can_state(bench.b), HAL_CAN_BUS_OFF);
    bus_bench_send_numbers(&bench, 2);
    assert_int_equal(bus_bench_count_heard(bench.b), 0);
    assert_int_equal(bus_bench_count_heard(bench.c), 2);
    bus_bench_run_for(&bench, 1000000);
    assert_int_equal(hal_can_state(bench.b), HAL_CAN_BUS_OFF); /* not without hal_can_restart() */
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 1}), HAL_OK);
    bus_bench_run_for(&bench, 20);
    sim_bus_fail_bus_off(bench.a); /* in the middle of its frame */
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(bus_bench_count_heard(bench.c), 0);
    assert_int_equal(sim_can_stats(bench.a).discarded, 1);
    assert_int_equal(sim_can_stats(bench.a).bus_offs, 1);
    sim_bus_destroy(bench.bus);
}

static void test_unplugged_controller_keeps_its_frames_and_turns_passive(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail_unplug(bench.a);
    assert_int_equal(hal_can_send(bench.b, &(hal_can_frame_t){.id = 1}), HAL_OK);
    bus_bench_run_for(&bench, 100000);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_ACTIVE); /* it has nothing to send */
    bus_bench_send_numbers(&bench, 10);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_PASSIVE);
    assert_int_equal(sim_can_stats(bench.a).pending, 10);
    assert_int_equal(bus_bench_count_heard(bench.a), 0);
    assert_int_equal(bus_bench_count_heard(bench.b), 0);
    sim_bus_replug(bench.a);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(bus_bench_count_heard(bench.b), 10);
    assert_int_equal(hal_can_state(bench.a), HAL_CAN_ERROR_ACTIVE);
    sim_bus_destroy(bench.bus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error_frames_are_counted_and_the_frame_is_sent_again),
        cmocka_unit_test(test_errors_lead_to_passive_and_bus_off_and_back),
        cmocka_unit_test(test_passive_sender_suspends_transmission),
        cmocka_unit_test(test_forced_bus_off_silences_one_controller),
        cmocka_unit_test(test_unplugged_controller_keeps_its_frames_and_turns_passive),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
