// SPDX-License-Identifier: Apache-2.0
// Tests of the simulated update agent: installs, a board that goes into the other slot, and one that comes back.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_update.h"

static const sim_update_settings_t settings = {.running = "0.5", .install_us = 10000000, .reboot_us = 4000000};
static const char bundle[] = "http://10.0.0.1/wallwarp-host-0.6.raucb";

static hal_update_t *update;
static int64_t now_us;

static int open_agent(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    now_us = 5000000;
    update = sim_update_create(&settings, now_us, error);
    assert_string_equal(error, "");
    return 0;
}

static int close_agent(void **state)
{
    (void)state;
    sim_update_destroy(update);
    return 0;
}

static sim_update_board_t after_ms(int64_t milliseconds)
{
    now_us += 1000 * milliseconds;
    return sim_update_advance(update, now_us);
}

static hal_update_state_t said(void)
{
    hal_update_state_t state;
    assert_int_equal(hal_update_state(update, &state), HAL_OK);
    return state;
}

static void install(void)
{
    assert_int_equal(hal_update_install(update, bundle), HAL_OK);
    assert_int_equal(after_ms(300), SIM_UPDATE_RUNS);
    assert_int_equal(after_ms(10000), SIM_UPDATE_RUNS);
}

static void test_install(void **state)
{
    (void)state;
    assert_int_equal(said().doing, HAL_UPDATE_IDLE);
    assert_int_equal(said().slot, 'A');
    assert_int_equal(hal_update_install(update, bundle), HAL_OK);
    hal_update_state_t read;
    assert_int_equal(hal_update_state(update, &read), HAL_FULL);
    assert_int_equal(hal_update_switch(update), HAL_FULL);
    assert_int_equal(after_ms(299), SIM_UPDATE_RUNS);
    assert_int_equal(hal_update_state(update, &read), HAL_FULL);
    assert_int_equal(after_ms(1), SIM_UPDATE_RUNS);
    assert_int_equal(said().doing, HAL_UPDATE_INSTALLING);
    assert_int_equal(said().progress, 0);
    after_ms(5000);
    assert_int_equal(said().progress, 50);
    assert_string_equal(said().waiting, "");
    after_ms(4999);
    assert_int_equal(said().doing, HAL_UPDATE_INSTALLING);
    after_ms(1);
    assert_int_equal(said().doing, HAL_UPDATE_READY);
    assert_int_equal(said().progress, 100);
    assert_string_equal(said().waiting, "0.6");
    assert_string_equal(said().other, "0.6");
    assert_string_equal(said().running, "0.5");
}

static void test_install_that_fails(void **state)
{
    (void)state;
    sim_update_faults(update)->install = true;
    install();
    assert_int_equal(said().doing, HAL_UPDATE_FAILED);
    assert_non_null(strstr(said().message, "signature"));
    assert_string_equal(said().other, "");
    static const char *const bad[] = {"/a",  "/a-.raucb",        "/x-0.6",
                                      "usb", "/x-0.6.raucb.txt", "/x-123456789012345678901234567890123.raucb"};
    sim_update_faults(update)->install = false;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(hal_update_install(update, bad[i]), HAL_OK);
        after_ms(300);
        assert_int_equal(said().doing, HAL_UPDATE_FAILED);
        assert_non_null(strstr(said().message, "not a bundle"));
    }
}

static void test_switch_and_good(void **state)
{
    (void)state;
    install();
    const int64_t asked_us = now_us;
    assert_true(sim_update_switched_us(update) == INT64_MIN);
    assert_int_equal(hal_update_switch(update), HAL_OK);
    assert_true(sim_update_switched_us(update) == asked_us);
    assert_int_equal(after_ms(299), SIM_UPDATE_RUNS);
    assert_int_equal(after_ms(1), SIM_UPDATE_DOWN);
    assert_int_equal(after_ms(3999), SIM_UPDATE_DOWN);
    assert_int_equal(after_ms(1), SIM_UPDATE_STARTS);
    assert_int_equal(after_ms(1), SIM_UPDATE_RUNS);
    assert_string_equal(said().running, "0.6");
    assert_string_equal(said().other, "0.5");
    assert_string_equal(said().waiting, "");
    assert_int_equal(said().slot, 'B');
    assert_true(said().trial);
    assert_int_equal(hal_update_good(update), HAL_OK);
    after_ms(300);
    assert_false(said().trial);
}

static void test_version_that_does_not_start(void **state)
{
    (void)state;
    install();
    sim_update_faults(update)->start = true;
    assert_int_equal(hal_update_switch(update), HAL_OK);
    assert_int_equal(after_ms(300), SIM_UPDATE_DOWN);
    assert_int_equal(after_ms(4000), SIM_UPDATE_DOWN);
    assert_int_equal(after_ms(11999), SIM_UPDATE_DOWN);
    assert_int_equal(after_ms(1), SIM_UPDATE_STARTS);
    assert_string_equal(said().running, "0.5");
    assert_int_equal(said().slot, 'A');
    assert_int_equal(said().doing, HAL_UPDATE_FAILED);
    assert_non_null(strstr(said().message, "0.6: did not start"));
    assert_string_equal(said().other, "");
    assert_false(said().trial);
}

static void test_switch_to_nothing(void **state)
{
    (void)state;
    assert_int_equal(hal_update_switch(update), HAL_OK);
    assert_int_equal(after_ms(300), SIM_UPDATE_RUNS);
    assert_int_equal(said().doing, HAL_UPDATE_FAILED);
}

static void test_no_agent_and_bad_settings(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    hal_update_state_t read;
    assert_int_equal(hal_update_state(NULL, &read), HAL_EMPTY);
    assert_int_equal(hal_update_good(NULL), HAL_EMPTY);
    assert_int_equal(hal_update_install(NULL, bundle), HAL_EMPTY);
    assert_int_equal(hal_update_install(update, "no source"), HAL_BAD_CALL);
    assert_int_equal(sim_update_advance(NULL, 0), SIM_UPDATE_RUNS);
    assert_null(sim_update_create(&(sim_update_settings_t){.running = "", .install_us = 1, .reboot_us = 1}, 0, error));
    assert_null(sim_update_create(&(sim_update_settings_t){.running = "1", .install_us = 0, .reboot_us = 1}, 0, error));
    assert_null(sim_update_create(&(sim_update_settings_t){.running = "1", .install_us = 1, .reboot_us = 0}, 0, error));
    assert_non_null(strstr(error, "reboot 0 us"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_install, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_install_that_fails, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_switch_and_good, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_version_that_does_not_start, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_switch_to_nothing, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_no_agent_and_bad_settings, open_agent, close_agent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
