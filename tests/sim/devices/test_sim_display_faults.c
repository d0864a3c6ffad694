// SPDX-License-Identifier: Apache-2.0
// The simulated display on demand: refused and late flips, and the plug pulled.
#include "sim/devices/sim_display.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/display_rig.h"

static void test_refused_flips(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    sim_display_faults(rig.display)->refuse_next = 2;
    for (int n = 2; n < 4; n++) {
        assert_int_equal(display_rig_draw(&rig, 50), HAL_IO);
        assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL); /* it counts as given back */
        display_rig_go_to(&rig, display_rig_blank_us(n));
        assert_int_equal(display_rig_wall(&rig), 1);
    }
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(4));
    assert_int_equal(display_rig_wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).refused, 2);
    display_rig_close(&rig);
}

static void test_late_flips(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    sim_display_faults(rig.display)->late_next = 1;
    sim_display_faults(rig.display)->late_blanks = 2;
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(2));
    assert_int_equal(display_rig_wall(&rig), 1);
    assert_int_equal(display_rig_draw(&rig, 3), HAL_OK);
    picture_t buffer = {.width = -1};
    assert_int_equal(display_rig_borrow(&rig, &buffer), HAL_FULL); /* 1 shown, 2 late, 3 waits */
    assert_int_equal(buffer.width, -1);
    display_rig_go_to(&rig, display_rig_blank_us(3));
    assert_int_equal(display_rig_wall(&rig), 1);
    display_rig_go_to(&rig, display_rig_blank_us(4));
    assert_int_equal(display_rig_wall(&rig), 2);
    display_rig_go_to(&rig, display_rig_blank_us(5));
    assert_int_equal(display_rig_wall(&rig), 3);
    assert_int_equal(sim_display_counts(rig.display).missed, 2);
    sim_display_faults(rig.display)->late_next = 1;
    sim_display_faults(rig.display)->late_blanks = 0;
    assert_int_equal(display_rig_draw(&rig, 4), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(6));
    assert_int_equal(display_rig_wall(&rig), 3);
    display_rig_go_to(&rig, display_rig_blank_us(7));
    assert_int_equal(display_rig_wall(&rig), 4);
    display_rig_close(&rig);
}

static void test_a_slow_board_draws_for_so_long_and_misses_blanks(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    sim_display_faults(rig.display)->drawing_us = 25000; /* blanks are 10000 apart */
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK);
    assert_int_equal(hal_time_now_us(rig.clock), display_rig_blank_us(3) + 5000);
    assert_int_equal(sim_display_counts(rig.display).missed, 2);
    assert_int_equal(display_rig_wall(&rig), 1);
    display_rig_go_to(&rig, display_rig_blank_us(4));
    assert_int_equal(display_rig_wall(&rig), 2);
    display_rig_close(&rig);
}

static void test_unplugged(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK);
    picture_t buffer = {.width = -1}, borrowed;
    assert_int_equal(display_rig_borrow(&rig, &borrowed), HAL_OK);
    sim_display_faults(rig.display)->unplugged_until_us = display_rig_blank_us(4) + 5;
    assert_int_equal(display_rig_wall(&rig), -1);
    assert_int_equal(display_rig_borrow(&rig, &buffer), HAL_IO);
    assert_int_equal(buffer.width, -1);
    assert_int_equal(hal_display_present(rig.display), HAL_IO);
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_IO);
    display_rig_go_to(&rig, display_rig_blank_us(4));
    assert_int_equal(display_rig_wall(&rig), -1);
    assert_int_equal(hal_display_next_vblank_us(rig.display), display_rig_blank_us(5));
    display_rig_go_to(&rig, display_rig_blank_us(4) + 5);
    assert_int_equal(display_rig_wall(&rig), 1);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(5));
    assert_int_equal(display_rig_wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).missed, 3);
    display_rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refused_flips),
        cmocka_unit_test(test_late_flips),
        cmocka_unit_test(test_a_slow_board_draws_for_so_long_and_misses_blanks),
        cmocka_unit_test(test_unplugged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
