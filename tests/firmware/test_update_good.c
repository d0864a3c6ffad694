// SPDX-License-Identifier: Apache-2.0
// Tests of a version on trial: healthy frames make it good, faults keep it on trial.
#include "tests/firmware/update_bench.h"

static void switch_now(void)
{
    install();
    (void)switch_in(1000000);
    room_bench_run(&bench, 1400 + ROOM_BENCH_REBOOT_US / 1000);
    assert_int_equal(projector()->update.told_good, false);
    assert_string_equal(sim_update_said(devices()->update)->running, "0.6");
}

static bool on_trial(void)
{
    return sim_update_said(devices()->update)->trial;
}

static void test_healthy_frames_make_it_good(void **state)
{
    (void)state;
    switch_now();
    while (projector()->update.healthy < UPDATE_GOOD_FRAMES - 1)
        operator_step();
    assert_in_range(report()->frame_number, UPDATE_GOOD_FRAMES - 1, UPDATE_GOOD_FRAMES + 1);
    assert_false(projector()->update.told_good);
    room_bench_run(&bench, 1100);
    assert_true(projector()->update.told_good);
    room_bench_run(&bench, 1500);
    assert_false(on_trial());
    assert_false(status().trial);
    assert_well_again();
}

static void test_the_safe_picture_is_healthy_too(void **state)
{
    (void)state;
    bench.tracking = false;
    switch_now();
    room_bench_run(&bench, 12500);
    assert_int_equal(report()->state, CAN_BOARD_WAITING);
    assert_false(on_trial());
}

/* Runs for 15 s with a fault that strikes again and again. */
static void check_stays_on_trial(void (*strike)(void))
{
    switch_now();
    for (int i = 0; i < 3; i++) {
        room_bench_run(&bench, 5000);
        strike();
    }
    assert_true(projector()->update.healthy < UPDATE_GOOD_FRAMES);
    assert_false(projector()->update.told_good);
    assert_true(on_trial());
    room_bench_run(&bench, 12500);
    assert_false(on_trial());
}

static void fail_display(void)
{
    sim_display_faults(devices()->display)->refuse_next = 1;
}

static void fail_line(void)
{
    sim_gpio_faults(devices()->gpio)->io = true;
    room_bench_run(&bench, 20);
    sim_gpio_faults(devices()->gpio)->io = false;
}

static void fail_camera(void)
{
    sim_camera_faults(devices()->camera)->unplugged_until_us = room_bench_now_us(&bench) + 100000;
}

static void fail_bus(void)
{
    sim_bus_fail_bus_off(devices()->can);
    room_bench_run(&bench, 20);
}

static void test_display_that_fails_keeps_it_on_trial(void **state)
{
    (void)state;
    check_stays_on_trial(fail_display);
}

static void test_line_that_fails_keeps_it_on_trial(void **state)
{
    (void)state;
    check_stays_on_trial(fail_line);
}

static void test_camera_that_fails_keeps_it_on_trial(void **state)
{
    (void)state;
    check_stays_on_trial(fail_camera);
}

static void test_bus_that_is_off_keeps_it_on_trial(void **state)
{
    (void)state;
    check_stays_on_trial(fail_bus);
}

static void test_frozen_frames_count_for_nothing(void **state)
{
    (void)state;
    switch_now();
    room_bench_run(&bench, 1000);
    ask_command((command_t){.kind = COMMAND_FREEZE, .freeze = true}, COMMAND_OK);
    operator_step();
    const int32_t healthy = projector()->update.healthy;
    assert_true(healthy > 0);
    room_bench_run(&bench, 12000);
    assert_int_equal(projector()->update.healthy, healthy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_healthy_frames_make_it_good, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_the_safe_picture_is_healthy_too, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_display_that_fails_keeps_it_on_trial, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_line_that_fails_keeps_it_on_trial, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_camera_that_fails_keeps_it_on_trial, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_bus_that_is_off_keeps_it_on_trial, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_frozen_frames_count_for_nothing, open_operator, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
