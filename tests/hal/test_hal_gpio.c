// SPDX-License-Identifier: Apache-2.0
// What hal_gpio.h promises, of any HAL; the build decides whose lines these are.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/gpio_rig.h"

enum { KEPT = 16, PATIENCE = 1000000 };

static const hal_gpio_line_t outputs[] = {HAL_GPIO_LED, HAL_GPIO_STROBE, HAL_GPIO_LAMP};

static int set_up(void **state)
{
    *state = gpio_rig_open();
    return 0;
}

static int tear_down(void **state)
{
    gpio_rig_close(*state);
    return 0;
}

static void outputs_are_driven_one_by_one(void **state)
{
    hal_gpio_t *gpio = gpio_rig_lines(*state);
    for (int high = 0; high < 8; high++) {
        for (int i = 0; i < 3; i++)
            assert_int_equal(hal_gpio_set(gpio, outputs[i], (high >> i & 1) != 0), HAL_OK);
        for (int i = 0; i < 3; i++)
            assert_int_equal(gpio_rig_level(*state, outputs[i]), high >> i & 1);
    }
}

static void outputs_are_low_at_first(void **state)
{
    for (int i = 0; i < 3; i++)
        assert_false(gpio_rig_level(*state, outputs[i]));
}

static void lines_are_used_as_what_they_are(void **state)
{
    hal_gpio_t *gpio = gpio_rig_lines(*state);
    int64_t time_us = 42;
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_GENLOCK, true), HAL_BAD_CALL);
    for (int i = 0; i < 3; i++)
        assert_int_equal(hal_gpio_take_edge(gpio, outputs[i], &time_us), HAL_BAD_CALL);
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    assert_int_equal(time_us, 42);
}

/* As soon as it is there. */
static int64_t take_edge(void **state)
{
    int64_t time_us = 0;
    hal_status_t status = HAL_EMPTY;
    for (int i = 0; i < PATIENCE && status == HAL_EMPTY; i++)
        status = hal_gpio_take_edge(gpio_rig_lines(*state), HAL_GPIO_GENLOCK, &time_us);
    assert_int_equal(status, HAL_OK);
    return time_us;
}

static void edges_are_stamped(void **state)
{
    for (int i = 0; i < 100; i++) {
        int64_t time_us = 42;
        const int64_t before_us = gpio_rig_now_us(*state);
        gpio_rig_pulse(*state);
        const int64_t edge_us = take_edge(state);
        assert_true(before_us <= edge_us && edge_us <= gpio_rig_now_us(*state));
        assert_int_equal(hal_gpio_take_edge(gpio_rig_lines(*state), HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
        assert_int_equal(time_us, 42);
    }
}

static void sixteen_edges_are_kept(void **state)
{
    int64_t last_us = gpio_rig_now_us(*state);
    for (int i = 0; i < KEPT; i++)
        gpio_rig_pulse(*state);
    for (int i = 0; i < KEPT; i++) {
        const int64_t edge_us = take_edge(state);
        assert_true(edge_us >= last_us);
        last_us = edge_us;
    }
    assert_true(last_us <= gpio_rig_now_us(*state));
}

static void too_many_edges_do_no_harm(void **state)
{
    int64_t time_us;
    int kept = 0;
    for (int i = 0; i < 10 * KEPT; i++)
        gpio_rig_pulse(*state);
    while (hal_gpio_take_edge(gpio_rig_lines(*state), HAL_GPIO_GENLOCK, &time_us) == HAL_OK)
        kept++;
    assert_true(kept >= KEPT && kept <= 10 * KEPT);
    const int64_t before_us = gpio_rig_now_us(*state);
    gpio_rig_pulse(*state);
    assert_true(take_edge(state) >= before_us);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(outputs_are_driven_one_by_one, set_up, tear_down),
        cmocka_unit_test_setup_teardown(outputs_are_low_at_first, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lines_are_used_as_what_they_are, set_up, tear_down),
        cmocka_unit_test_setup_teardown(edges_are_stamped, set_up, tear_down),
        cmocka_unit_test_setup_teardown(sixteen_edges_are_kept, set_up, tear_down),
        cmocka_unit_test_setup_teardown(too_many_edges_do_no_harm, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
