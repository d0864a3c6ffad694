// SPDX-License-Identifier: Apache-2.0
// Tests of the loop body: every failing device is counted, told on the bus, and got over.
#include "tests/firmware/projector_bench.h"

static void test_a_refused_flip_is_a_fault_of_one_step(void **state)
{
    (void)state;
    start_running();
    const uint32_t frames = report()->frame_number;
    sim_display_faults(devices()->display)->refuse_next = 1;
    room_bench_step(&bench);
    assert_int_equal(report()->state, CAN_BOARD_FAULT);
    assert_int_equal(projector()->faults.display, 1);
    assert_int_equal(report()->frame_number, frames);
    room_bench_step(&bench);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_int_equal(report()->frame_number, frames + 1);
    room_bench_run(&bench, 600);
    assert_int_equal(bench.voice[0].flags_ever, CAN_FAULT_DISPLAY);
    assert_well_again();
}

static void test_a_display_without_cable_is_no_reason_for_a_reset(void **state)
{
    (void)state;
    start_running();
    sim_display_faults(devices()->display)->unplugged_until_us = room_bench_now_us(&bench) + 5000000;
    room_bench_run(&bench, 4900);
    assert_int_equal(report()->state, CAN_BOARD_FAULT);
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_DISPLAY);
    assert_false(expired());
    room_bench_run(&bench, 200);
    assert_well_again();
}

static void test_a_display_that_never_frees_a_buffer_is_not_fed_for(void **state)
{
    (void)state;
    start_running();
    sim_display_faults(devices()->display)->late_blanks = 1000000;
    sim_display_faults(devices()->display)->late_next = 1;
    room_bench_run(&bench, 1900);
    assert_false(expired());
    assert_int_equal(report()->state, CAN_BOARD_FAULT);
    room_bench_run(&bench, 300);
    assert_true(expired());
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_DISPLAY);
    assert_false(sim_watchdog_expired(sim_world_devices(bench.world, 1)->watchdog, room_bench_now_us(&bench)));
}

static void test_bus_off_is_left_again(void **state)
{
    (void)state;
    start_running();
    sim_bus_fail_bus_off(devices()->can);
    room_bench_step(&bench);
    assert_int_equal(projector()->can_faults.bus_off, 1);
    room_bench_run(&bench, 600);
    assert_int_equal(hal_can_state(devices()->can), HAL_CAN_ERROR_ACTIVE);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_BUS_OFF);
    assert_int_equal(bench.voice[1].flags_ever, 0);
    assert_well_again();
}

static void test_a_flooded_bus_is_survived(void **state)
{
    (void)state;
    start_running();
    const hal_can_frame_t flood = {.id = 0, .length = 8};
    assert_int_equal(sim_bus_fail_flood(sim_world_bus(bench.world), &flood), HAL_OK);
    room_bench_run(&bench, 500);
    assert_int_equal(report()->state, CAN_BOARD_HOLDING);
    room_bench_run(&bench, 7000);
    assert_int_equal(report()->state, CAN_BOARD_SAFE);
    assert_true(projector()->faults.can_send > 0);
    assert_false(expired());
    assert_int_equal(sim_bus_fail_flood(sim_world_bus(bench.world), NULL), HAL_OK);
    room_bench_run(&bench, 1000);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_BUS);
    assert_well_again();
}

static void test_corrupted_poses_are_counted_and_never_used(void **state)
{
    (void)state;
    start_running();
    const pose_t last = report()->pose;
    const sim_bus_fail_t all = {.ppm = 1000000, .only = devices()->can};
    const uint32_t before = projector()->can_faults.crc;
    sim_bus_fail(sim_world_bus(bench.world), SIM_BUS_CORRUPT, all);
    room_bench_run(&bench, 500);
    assert_int_equal(report()->state, CAN_BOARD_HOLDING);
    assert_memory_equal(&report()->pose, &last, sizeof last);
    assert_int_equal(projector()->can_faults.crc, before + 30);
    assert_int_equal(room_bench_report(&bench, 1)->state, CAN_BOARD_RUNNING);
    room_bench_run(&bench, 100);
    assert_true(bench.voice[0].status.can_faults >= 30);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_BUS);
    sim_bus_fail(sim_world_bus(bench.world), SIM_BUS_CORRUPT, (sim_bus_fail_t){.ppm = 0});
    assert_well_again();
}

static void test_a_stuck_can_driver_is_counted(void **state)
{
    (void)state;
    start_running();
    sim_bus_fail_driver(devices()->can, true);
    room_bench_run(&bench, 500);
    assert_true(projector()->can_faults.io >= 30);
    assert_int_equal(report()->state, CAN_BOARD_HOLDING);
    sim_bus_fail_driver(devices()->can, false);
    room_bench_run(&bench, 600);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_BUS);
    assert_well_again();
}

static void test_gpio_and_watchdog_failures_are_told(void **state)
{
    (void)state;
    start_running();
    sim_gpio_faults(devices()->gpio)->io = true;
    room_bench_run(&bench, 600);
    assert_true(projector()->faults.gpio >= 3 * 30);
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_GPIO);
    sim_gpio_faults(devices()->gpio)->io = false;
    assert_well_again();
    sim_watchdog_faults(devices()->watchdog)->io = true;
    room_bench_run(&bench, 2100);
    assert_true(projector()->faults.watchdog >= 120);
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_WATCHDOG);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(expired());
}

static void test_led_blinks_until_all_is_well_and_strobe_marks_every_step(void **state)
{
    (void)state;
    bool lit = false, dark = false;
    for (int i = 0; i < ROOM_BENCH_HZ; i++) {
        room_bench_step(&bench);
        lit |= sim_gpio_level(devices()->gpio, HAL_GPIO_LED);
        dark |= !sim_gpio_level(devices()->gpio, HAL_GPIO_LED);
    }
    assert_true(lit && dark);
    start_running();
    for (int i = 0; i < ROOM_BENCH_HZ; i++) {
        const uint64_t edges = sim_gpio_edge_count(devices()->gpio);
        room_bench_step(&bench);
        assert_true(sim_gpio_level(devices()->gpio, HAL_GPIO_LED));
        assert_int_equal(sim_gpio_edge_count(devices()->gpio) - edges, 2);
    }
}

static void test_lamp_stays_off_until_a_picture_is_presented(void **state)
{
    (void)state;
    sim_display_faults(devices()->display)->refuse_next = 1;
    room_bench_step(&bench);
    assert_false(sim_gpio_level(devices()->gpio, HAL_GPIO_LAMP));
    room_bench_step(&bench);
    assert_true(sim_gpio_level(devices()->gpio, HAL_GPIO_LAMP));
    sim_display_faults(devices()->display)->refuse_next = 1; /* the wall keeps its picture */
    room_bench_step(&bench);
    assert_true(sim_gpio_level(devices()->gpio, HAL_GPIO_LAMP));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_refused_flip_is_a_fault_of_one_step, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_display_without_cable_is_no_reason_for_a_reset, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_display_that_never_frees_a_buffer_is_not_fed_for, open_bench,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_bus_off_is_left_again, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_flooded_bus_is_survived, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_corrupted_poses_are_counted_and_never_used, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_stuck_can_driver_is_counted, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_gpio_and_watchdog_failures_are_told, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_led_blinks_until_all_is_well_and_strobe_marks_every_step, open_bench,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_lamp_stays_off_until_a_picture_is_presented, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
