// SPDX-License-Identifier: Apache-2.0
// The simulated display: flips at blanks and nowhere else, and every fault.
#include "sim/devices/sim_display.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"

/* 100 blanks a second: blank n is at 3000 + 10000 n; the clock starts at 4000, after blank 0. */
enum { W = 5, H = 3, EPOCH_US = 4000 };

typedef struct {
    hal_time_t *clock;
    hal_display_t *display;
} rig_t;

static int64_t blank_us(int64_t n)
{
    return 3000 + 10000 * n;
}

static sim_display_settings_t usual_settings(const hal_time_t *clock)
{
    return (sim_display_settings_t){.width = W, .height = H, .clock = clock, .blanks = {3000, 100, 1}};
}

static rig_t open_rig(int64_t epoch_us)
{
    char error[FILE_ERROR_LENGTH] = "";
    rig_t rig = {.clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = epoch_us}, error)};
    assert_non_null(rig.clock);
    const sim_display_settings_t settings = usual_settings(rig.clock);
    rig.display = sim_display_create(&settings, error);
    assert_non_null(rig.display);
    return rig;
}

static void close_rig(const rig_t *rig)
{
    sim_display_destroy(rig->display);
    sim_clock_destroy(rig->clock);
}

static void go_to(const rig_t *rig, int64_t time_us)
{
    sim_clock_set_us(rig->clock, time_us);
    sim_display_advance(rig->display, time_us);
}

/* Borrow, fill with one value, present. */
static hal_status_t draw(const rig_t *rig, int value)
{
    image_t buffer;
    const hal_status_t status = hal_display_back_buffer(rig->display, &buffer);
    if (status != HAL_OK)
        return status;
    assert_true(buffer.width == W && buffer.height == H && buffer.format == IMAGE_XRGB8888);
    memset(buffer.data, value, (size_t)buffer.stride * H);
    return hal_display_present(rig->display);
}

/* The value on the wall, -1 when dark. */
static int wall(const rig_t *rig)
{
    const image_t *shown = sim_display_shown(rig->display);
    if (shown == NULL)
        return -1;
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W * 4; x++)
            assert_int_equal(image_row(shown, y)[x], shown->data[0]);
    return shown->data[0];
}

static void test_pictures_flip_at_blanks(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    assert_int_equal(wall(&rig), -1);
    assert_int_equal(hal_display_next_vblank_us(rig.display), blank_us(1));
    assert_int_equal(draw(&rig, 10), HAL_OK);
    go_to(&rig, blank_us(1) - 1);
    assert_int_equal(wall(&rig), -1);
    go_to(&rig, blank_us(1));
    assert_int_equal(wall(&rig), 10);
    assert_int_equal(hal_display_next_vblank_us(rig.display), blank_us(2));
    for (int n = 2; n < 30; n++) {
        assert_int_equal(draw(&rig, 10 * n % 256), HAL_OK);
        assert_int_equal(wall(&rig), 10 * (n - 1) % 256);
        assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
        assert_int_equal(hal_time_now_us(rig.clock), blank_us(n - 1)); /* virtual: no time has passed */
        go_to(&rig, blank_us(n));
        assert_int_equal(wall(&rig), 10 * n % 256);
    }
    assert_int_equal(sim_display_counts(rig.display).flips, 29);
    assert_int_equal(sim_display_counts(rig.display).missed, 0);
    close_rig(&rig);
}

static void test_missed_blanks_are_counted(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    go_to(&rig, blank_us(5));
    assert_int_equal(sim_display_counts(rig.display).missed, 0); /* nothing shown yet: nothing missed */
    assert_int_equal(draw(&rig, 1), HAL_OK);
    go_to(&rig, blank_us(8)); /* flips at 6; 7 and 8 bring nothing */
    assert_int_equal(wall(&rig), 1);
    assert_int_equal(sim_display_counts(rig.display).missed, 2);
    /* Without a word to the display, blank 9 passes: what is presented now is for blank 10. */
    sim_clock_set_us(rig.clock, blank_us(9) + 1);
    assert_int_equal(draw(&rig, 2), HAL_OK);
    assert_int_equal(hal_display_next_vblank_us(rig.display), blank_us(10));
    sim_display_advance(rig.display, blank_us(9) + 2);
    assert_int_equal(wall(&rig), 1);
    go_to(&rig, blank_us(10));
    assert_int_equal(wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).missed, 3);
    close_rig(&rig);
}

static void test_borrowing_rules(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    image_t first, again;
    assert_int_equal(hal_display_back_buffer(rig.display, &first), HAL_OK);
    assert_int_equal(hal_display_back_buffer(rig.display, &again), HAL_OK);
    assert_ptr_equal(first.data, again.data);
    assert_int_equal(draw(&rig, 1), HAL_OK);
    assert_int_equal(draw(&rig, 2), HAL_OK); /* replaces 1 */
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    go_to(&rig, blank_us(1));
    assert_int_equal(wall(&rig), 2);
    /* While the wall shows 2 and 3 waits, what is drawn is neither. */
    assert_int_equal(draw(&rig, 3), HAL_OK);
    assert_int_equal(hal_display_back_buffer(rig.display, &first), HAL_OK);
    memset(first.data, 99, (size_t)first.stride * H);
    assert_int_equal(wall(&rig), 2);
    go_to(&rig, blank_us(2));
    assert_int_equal(wall(&rig), 3);
    assert_int_equal(sim_display_counts(rig.display).replaced, 1);
    assert_int_equal(sim_display_counts(rig.display).flips, 2);
    close_rig(&rig);
}

static void test_refused_flips(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    assert_int_equal(draw(&rig, 1), HAL_OK);
    go_to(&rig, blank_us(1));
    sim_display_faults(rig.display)->refuse_next = 2;
    for (int n = 2; n < 4; n++) {
        assert_int_equal(draw(&rig, 50), HAL_IO);
        assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL); /* it counts as given back */
        go_to(&rig, blank_us(n));
        assert_int_equal(wall(&rig), 1);
    }
    assert_int_equal(draw(&rig, 2), HAL_OK);
    go_to(&rig, blank_us(4));
    assert_int_equal(wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).refused, 2);
    close_rig(&rig);
}

static void test_late_flips(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    assert_int_equal(draw(&rig, 1), HAL_OK);
    go_to(&rig, blank_us(1));
    sim_display_faults(rig.display)->late_next = 1;
    sim_display_faults(rig.display)->late_blanks = 2;
    assert_int_equal(draw(&rig, 2), HAL_OK);
    go_to(&rig, blank_us(2));
    assert_int_equal(wall(&rig), 1);
    assert_int_equal(draw(&rig, 3), HAL_OK);
    image_t buffer = {.width = -1};
    assert_int_equal(hal_display_back_buffer(rig.display, &buffer), HAL_FULL); /* 1 shown, 2 late, 3 waits */
    assert_int_equal(buffer.width, -1);
    go_to(&rig, blank_us(3));
    assert_int_equal(wall(&rig), 1);
    go_to(&rig, blank_us(4));
    assert_int_equal(wall(&rig), 2);
    go_to(&rig, blank_us(5));
    assert_int_equal(wall(&rig), 3);
    assert_int_equal(sim_display_counts(rig.display).missed, 2);
    sim_display_faults(rig.display)->late_next = 1;
    sim_display_faults(rig.display)->late_blanks = 0;
    assert_int_equal(draw(&rig, 4), HAL_OK);
    go_to(&rig, blank_us(6));
    assert_int_equal(wall(&rig), 3);
    go_to(&rig, blank_us(7));
    assert_int_equal(wall(&rig), 4);
    close_rig(&rig);
}

static void test_unplugged(void **state)
{
    (void)state;
    const rig_t rig = open_rig(EPOCH_US);
    assert_int_equal(draw(&rig, 1), HAL_OK);
    go_to(&rig, blank_us(1));
    assert_int_equal(draw(&rig, 2), HAL_OK);
    image_t buffer = {.width = -1}, borrowed;
    assert_int_equal(hal_display_back_buffer(rig.display, &borrowed), HAL_OK);
    sim_display_faults(rig.display)->unplugged_until_us = blank_us(4) + 5;
    assert_int_equal(wall(&rig), -1);
    assert_int_equal(hal_display_back_buffer(rig.display, &buffer), HAL_IO);
    assert_int_equal(buffer.width, -1);
    assert_int_equal(hal_display_present(rig.display), HAL_IO);
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_IO);
    go_to(&rig, blank_us(4));
    assert_int_equal(wall(&rig), -1);
    assert_int_equal(hal_display_next_vblank_us(rig.display), blank_us(5));
    go_to(&rig, blank_us(4) + 5);
    assert_int_equal(wall(&rig), 1);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
    go_to(&rig, blank_us(5));
    assert_int_equal(wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).missed, 3);
    close_rig(&rig);
}

static void test_blanks_before_the_first_one(void **state)
{
    (void)state;
    const rig_t rig = open_rig(blank_us(-10));
    assert_int_equal(hal_display_next_vblank_us(rig.display), blank_us(-9));
    assert_int_equal(draw(&rig, 5), HAL_OK);
    go_to(&rig, blank_us(-9));
    assert_int_equal(wall(&rig), 5);
    close_rig(&rig);
}

static void count_call(void *context)
{
    int *calls = context;
    (*calls)++;
}

static void test_a_real_clock_is_waited_for(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    int calls = 0;
    hal_time_t *clock = sim_clock_create(&(sim_clock_settings_t){.real = true, .drift_ppb = -9000000}, error);
    sim_display_settings_t settings = usual_settings(clock);
    settings.while_waiting = count_call;
    settings.context = &calls;
    const rig_t rig = {clock, sim_display_create(&settings, error)};
    for (int n = 1; n <= 3; n++) {
        const int64_t next_us = hal_display_next_vblank_us(rig.display);
        assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
        assert_true(hal_time_now_us(clock) >= next_us);
        assert_int_equal(calls, n);
    }
    assert_int_equal(draw(&rig, 7), HAL_OK);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
    assert_int_equal(wall(&rig), 7); /* with nobody but the wait to flip it */
    const int64_t begin_us = hal_time_now_us(clock);
    sim_display_faults(rig.display)->unplugged_until_us = INT64_MAX;
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_IO);
    assert_true(hal_time_now_us(clock) >= begin_us + 100000);
    close_rig(&rig);
}

static void test_bad_settings(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = 0}, error);
    sim_display_settings_t settings = usual_settings(clock);
    settings.height = 0;
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: panel 5x0, expected at most 4096x2160");
    settings = (sim_display_settings_t){.width = W, .height = H, .clock = clock, .blanks = {0, 0, 1}};
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: 0 blanks in 1 s, expected up to 1000000 a second");
    sim_clock_destroy(clock);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pictures_flip_at_blanks),
        cmocka_unit_test(test_missed_blanks_are_counted),
        cmocka_unit_test(test_borrowing_rules),
        cmocka_unit_test(test_refused_flips),
        cmocka_unit_test(test_late_flips),
        cmocka_unit_test(test_unplugged),
        cmocka_unit_test(test_blanks_before_the_first_one),
        cmocka_unit_test(test_bad_settings),
        cmocka_unit_test(test_a_real_clock_is_waited_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
