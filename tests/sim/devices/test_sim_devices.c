// SPDX-License-Identifier: Apache-2.0
// The simulated clock, digital lines and watchdog.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_gpio.h"
#include "sim/devices/sim_watchdog.h"

static hal_time_t *create_clock(sim_clock_settings_t settings)
{
    char error[FILE_ERROR_LENGTH] = "";
    hal_time_t *clock = sim_clock_create(&settings, error);
    if (clock == NULL)
        fail_msg("%s", error);
    return clock;
}

static void test_virtual_time(void **state)
{
    (void)state;
    hal_time_t *clock = create_clock((sim_clock_settings_t){.epoch_us = 1000});
    assert_false(sim_clock_is_real(clock));
    assert_int_equal(hal_time_now_us(clock), 1000);
    sim_clock_set_us(clock, 2500);
    assert_int_equal(hal_time_now_us(clock), 2500);
    sim_clock_sleep_until_us(clock, INT64_MAX); /* returns at once */
    assert_int_equal(hal_time_now_us(clock), 2500);
    sim_clock_destroy(clock);
}

static void test_offset_and_drift(void **state)
{
    (void)state;
    hal_time_t *clock =
        create_clock((sim_clock_settings_t){.epoch_us = 5000000, .offset_us = -300, .drift_ppb = 40000});
    assert_int_equal(hal_time_now_us(clock), 5000000 - 300);
    sim_clock_set_us(clock, 5000000 + 1000000);
    assert_int_equal(hal_time_now_us(clock), 6000000 - 300 + 40);
    const int64_t year_us = 365LL * 86400 * 1000000;
    assert_int_equal(sim_clock_shows_us(clock, 5000000 + year_us), 5000000 + year_us - 300 + year_us / 25000);
    sim_clock_destroy(clock);
    clock = create_clock((sim_clock_settings_t){.drift_ppb = -SIM_CLOCK_MAX_DRIFT_PPB});
    int64_t before_us = 0;
    for (int64_t t_us = 999990000; t_us < 1000010000; t_us++) {
        const int64_t now_us = sim_clock_shows_us(clock, t_us);
        assert_true(t_us == 999990000 || (now_us >= before_us && now_us <= before_us + 1));
        before_us = now_us;
    }
    assert_int_equal(sim_clock_shows_us(clock, 1000000000), 990000000);
    assert_int_equal(sim_clock_shows_us(clock, year_us), year_us - year_us / 100);
    sim_clock_destroy(clock);
}

static void test_real_time_runs(void **state)
{
    (void)state;
    hal_time_t *clock = create_clock((sim_clock_settings_t){.real = true, .offset_us = 1000000000000000});
    assert_true(sim_clock_is_real(clock));
    const int64_t begin_us = hal_time_now_us(clock);
    assert_true(begin_us >= 1000000000000000);
    sim_clock_sleep_until_us(clock, begin_us + 2000);
    assert_true(hal_time_now_us(clock) >= begin_us + 2000);
    sim_clock_sleep_until_us(clock, begin_us);
    sim_clock_destroy(clock);
}

static void test_bad_clock_settings(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    assert_null(sim_clock_create(&(sim_clock_settings_t){.drift_ppb = SIM_CLOCK_MAX_DRIFT_PPB + 1}, error));
    assert_string_equal(error, "clock: drift 10000001 ppb, expected at most 10000000 either way");
    assert_null(sim_clock_create(&(sim_clock_settings_t){.offset_us = INT64_MIN}, error));
    assert_non_null(strstr(error, "clock: offset -9223372036854775808 us, expected at most"));
}

static void assert_edge(const hal_gpio_t *gpio, uint64_t n, int64_t time_us, hal_gpio_line_t line, bool high)
{
    sim_gpio_edge_t edge;
    assert_true(sim_gpio_edge(gpio, n, &edge));
    assert_int_equal(edge.time_us, time_us);
    assert_int_equal(edge.line, line);
    assert_int_equal(edge.high, high);
}

static void test_outputs_and_their_log(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = create_clock((sim_clock_settings_t){.epoch_us = 0});
    hal_gpio_t *gpio = sim_gpio_create(clock, error);
    sim_gpio_edge_t edge = {.time_us = 77};
    assert_false(sim_gpio_level(gpio, HAL_GPIO_LED));
    assert_false(sim_gpio_edge(gpio, 0, &edge));
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, false), HAL_OK); /* no edge */
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, true), HAL_OK);
    sim_clock_set_us(clock, 10);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, true), HAL_OK);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, true), HAL_OK); /* no edge */
    assert_true(sim_gpio_level(gpio, HAL_GPIO_LED));
    assert_true(sim_gpio_level(gpio, HAL_GPIO_STROBE));
    assert_int_equal(sim_gpio_edge_count(gpio), 2);
    assert_edge(gpio, 0, 0, HAL_GPIO_LED, true);
    assert_edge(gpio, 1, 10, HAL_GPIO_STROBE, true);
    assert_false(sim_gpio_edge(gpio, 2, &edge));
    for (int i = 1; i <= SIM_GPIO_LOG_EDGES; i++) {
        sim_clock_set_us(clock, 10 + i);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, i % 2 == 0), HAL_OK);
    }
    assert_int_equal(sim_gpio_edge_count(gpio), SIM_GPIO_LOG_EDGES + 2);
    assert_false(sim_gpio_edge(gpio, 1, &edge));
    assert_edge(gpio, 2, 11, HAL_GPIO_STROBE, false);
    assert_edge(gpio, SIM_GPIO_LOG_EDGES + 1, 10 + SIM_GPIO_LOG_EDGES, HAL_GPIO_STROBE, true);
    assert_int_equal(edge.time_us, 77);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_GENLOCK, true), HAL_BAD_CALL);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LINES, true), HAL_BAD_CALL);
    sim_gpio_destroy(gpio);
    sim_clock_destroy(clock);
}

static void test_genlock(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = create_clock((sim_clock_settings_t){.epoch_us = 0});
    hal_gpio_t *gpio = sim_gpio_create(clock, error);
    int64_t time_us = 77;
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_LED, &time_us), HAL_BAD_CALL);
    assert_int_equal(time_us, 77);
    for (int i = 1; i <= SIM_GPIO_INPUT_EDGES + 3; i++)
        sim_gpio_genlock(gpio, 1000 * i);
    for (int i = 4; i <= SIM_GPIO_INPUT_EDGES + 3; i++) {
        assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_OK);
        assert_int_equal(time_us, 1000 * i);
    }
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    sim_gpio_destroy(gpio);
    sim_clock_destroy(clock);
}

static void test_gpio_faults(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = create_clock((sim_clock_settings_t){.epoch_us = 0});
    hal_gpio_t *gpio = sim_gpio_create(clock, error);
    int64_t time_us = 77;
    sim_gpio_faults(gpio)->stuck[HAL_GPIO_LED] = true;
    sim_gpio_faults(gpio)->stuck[HAL_GPIO_GENLOCK] = true;
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, true), HAL_OK);
    assert_false(sim_gpio_level(gpio, HAL_GPIO_LED));
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, true), HAL_OK);
    assert_true(sim_gpio_level(gpio, HAL_GPIO_STROBE));
    sim_gpio_genlock(gpio, 5);
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    *sim_gpio_faults(gpio) = (sim_gpio_faults_t){.io = true};
    sim_gpio_genlock(gpio, 6);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, false), HAL_IO);
    assert_true(sim_gpio_level(gpio, HAL_GPIO_STROBE));
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_IO);
    assert_int_equal(time_us, 77);
    sim_gpio_faults(gpio)->io = false;
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_OK);
    assert_int_equal(time_us, 6);
    sim_gpio_destroy(gpio);
    sim_clock_destroy(clock);
}

static void test_watchdog(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = create_clock((sim_clock_settings_t){.epoch_us = 500});
    assert_null(sim_watchdog_create(clock, 0, error));
    assert_string_equal(error, "watchdog: period 0 us, expected 1 or more");
    hal_watchdog_t *watchdog = sim_watchdog_create(clock, 2000, error);
    assert_false(sim_watchdog_expired(watchdog, 2499));
    assert_true(sim_watchdog_expired(watchdog, 2500));
    sim_clock_set_us(clock, 2499);
    assert_int_equal(hal_watchdog_feed(watchdog), HAL_OK);
    assert_false(sim_watchdog_expired(watchdog, 4498));
    sim_watchdog_faults(watchdog)->io = true;
    sim_clock_set_us(clock, 4000);
    assert_int_equal(hal_watchdog_feed(watchdog), HAL_IO);
    assert_int_equal(sim_watchdog_feeds(watchdog), 1);
    assert_true(sim_watchdog_expired(watchdog, 4499));
    sim_watchdog_faults(watchdog)->io = false;
    assert_int_equal(hal_watchdog_feed(watchdog), HAL_OK);
    assert_false(sim_watchdog_expired(watchdog, 4499));
    sim_clock_set_us(clock, 6000); /* too late: feeding does not undo the reset */
    assert_int_equal(hal_watchdog_feed(watchdog), HAL_OK);
    assert_true(sim_watchdog_expired(watchdog, 6000));
    assert_int_equal(sim_watchdog_feeds(watchdog), 3);
    sim_watchdog_destroy(watchdog);
    sim_clock_destroy(clock);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_virtual_time),          cmocka_unit_test(test_offset_and_drift),
        cmocka_unit_test(test_real_time_runs),        cmocka_unit_test(test_bad_clock_settings),
        cmocka_unit_test(test_outputs_and_their_log), cmocka_unit_test(test_genlock),
        cmocka_unit_test(test_gpio_faults),           cmocka_unit_test(test_watchdog),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
