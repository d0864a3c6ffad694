// SPDX-License-Identifier: Apache-2.0
// A board that can't do its work: its wall, its heartbeats, what it does for operators, and its signs of life.
#include "tests/firmware/notice_bench.h"

#include "sim/devices/sim_update.h"

static bool shows(const safe_picture_t *what)
{
    static uint8_t bytes[WIDTH * HEIGHT * 4];
    const image_t expected = {bytes, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = picture_from_image(&expected);
    safe_picture_draw(&panel, what);
    const image_t *shown = sim_display_shown(bench.devices.display);
    return shown != NULL && memcmp(shown->data, bytes, sizeof bytes) == 0;
}

static void the_wall_says_why(void **state)
{
    (void)state;
    begin(NULL);
    run(1000);
    assert_true(shows(&(safe_picture_t){"front", NODE, reason}));
    assert_false(shows(&(safe_picture_t){"front", NODE, "no pose"}));
    assert_true(sim_gpio_level(bench.devices.gpio, HAL_GPIO_LAMP));
    assert_in_range(bench.led_edges, 14, 18); /* of 60 ms */
}

static void heartbeats_say_so_and_nothing_else_is_sent(void **state)
{
    (void)state;
    begin(NULL);
    run(3000);
    assert_in_range(bench.heartbeats, 6, 7);
    assert_int_equal(bench.strangers, 0);
    assert_int_equal(bench.heartbeat.state, CAN_BOARD_FAULT);
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG);
    assert_in_range(bench.heartbeat.uptime_s, 2, 3);
    assert_in_range(bench.heartbeat.frame_number, 140, 180);
}

static void it_lives(void **state)
{
    (void)state;
    begin(NULL);
    run(5000);
    const sim_service_heard_t *heard = sim_service_heard(bench.devices.service);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_true(heard->ready_us > INT64_MIN);
    assert_true(heard->last.healthy);
    assert_int_equal(heard->states, 1);
    assert_string_equal(heard->last.state, reason);
    assert_int_equal(projector->events.log.entry[1].kind, EVENT_STATE);
}

static void operators_are_served(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_HELLO}), COMMAND_OK);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_LOG}), COMMAND_OK);
    assert_true(ask_command((command_t){.kind = COMMAND_LATENCY, .latency_us = 200000}) >= 0);
    for (int i = 0; i < WARP_METHODS; i++)
        assert_true(ask_command((command_t){.kind = COMMAND_METHOD, .method = &warp_methods[i]}) >= 0);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_WHITE}), COMMAND_OK);
    run(100);
    assert_int_equal(sim_display_shown(bench.devices.display)->data[4 * (WIDTH * 20 + 20)], 255);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_PATTERN}), COMMAND_OK);
    run(100);
    assert_true(shows(&(safe_picture_t){"front", NODE, reason}));
}

static void a_reboot_is_one(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), COMMAND_OK);
    run(2500);
    assert_true(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_false(sim_service_heard(bench.devices.service)->last.healthy);
}

static void without_a_key_that_there_may_be_nobody_is_served(void **state)
{
    (void)state;
    bench.notice.deaf = true;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), -1);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
}

static void with_a_key_a_code_is_needed(void **state)
{
    (void)state;
    const hal_key_t secret = {.bytes = {1, 2, 3}};
    can_auth_t *key = can_auth_open(&secret);
    assert_non_null(key);
    begin(key);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), COMMAND_REFUSED);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_NONCE}), COMMAND_OK);
    run(2500);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_int_equal(bench.strangers, 0);
    can_auth_close(key);
}

/* One that mends what is wrong may be on its way; but this one is not good. */
static void updates_are_installed_and_none_is_good(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    const sim_update_settings_t settings = {.running = "1", .install_us = 60000000, .reboot_us = 1000000};
    bench.devices.update = sim_update_create(&settings, bench.now_us, error);
    assert_string_equal(error, "");
    begin(NULL);
    run(1000);
    assert_int_equal(
        ask_command((command_t){.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_INSTALL, .text = "/wallwarp-2.raucb"}),
        COMMAND_OK);
    (void)sim_update_advance(bench.devices.update, bench.now_us + SIM_UPDATE_TAKE_US);
    assert_int_equal(sim_update_said(bench.devices.update)->doing, HAL_UPDATE_INSTALLING);
    run(15000);
    assert_int_equal(projector->update.healthy, 0);
    sim_update_destroy(bench.devices.update);
}

static void a_display_that_hangs_is_no_life(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    sim_display_faults(bench.devices.display)->late_blanks = 1000000;
    sim_display_faults(bench.devices.display)->late_next = 1;
    run(3000);
    assert_true(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG | CAN_FAULT_DISPLAY);
}

static void what_is_missing_is_done_without(void **state)
{
    (void)state;
    hal_can_t *const can = bench.devices.can;
    bench.notice.node = 0;
    bench.devices.can = NULL;
    begin(NULL);
    run(1000);
    assert_true(shows(&(safe_picture_t){"front", 0, reason}));
    assert_int_equal(bench.heartbeats + bench.strangers, 0);

    hal_display_t *const display = bench.devices.display;
    bench.notice.node = NODE;
    bench.devices.can = can;
    bench.devices.display = NULL;
    begin(NULL);
    for (int i = 0; i < 3 * HZ; i++) {
        bench.now_us += 1000000 / HZ;
        sim_clock_set_us(bench.devices.clock, bench.now_us);
        sim_bus_advance(bench.bus, bench.now_us);
        notice_step(projector, &bench.notice);
        hear();
    }
    bench.devices.display = display;
    assert_in_range(bench.heartbeats, 6, 7);
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_false(sim_gpio_level(bench.devices.gpio, HAL_GPIO_LAMP) && projector->report.frame_number == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_wall_says_why, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(heartbeats_say_so_and_nothing_else_is_sent, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(it_lives, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(operators_are_served, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(a_reboot_is_one, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(without_a_key_that_there_may_be_nobody_is_served, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(with_a_key_a_code_is_needed, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(updates_are_installed_and_none_is_good, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(a_display_that_hangs_is_no_life, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(what_is_missing_is_done_without, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
