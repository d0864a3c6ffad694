// SPDX-License-Identifier: Apache-2.0
// The simulated display: flips at blanks and nowhere else.
#include "sim/devices/sim_display.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"
#include "tests/support/display_rig.h"

static void test_pictures_flip_at_blanks(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(display_rig_wall(&rig), -1);
    assert_int_equal(hal_display_next_vblank_us(rig.display), display_rig_blank_us(1));
    assert_int_equal(display_rig_draw(&rig, 10), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1) - 1);
    assert_int_equal(display_rig_wall(&rig), -1);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    assert_int_equal(display_rig_wall(&rig), 10);
    assert_int_equal(hal_display_next_vblank_us(rig.display), display_rig_blank_us(2));
    for (int n = 2; n < 30; n++) {
        assert_int_equal(display_rig_draw(&rig, 10 * n % 256), HAL_OK);
        assert_int_equal(display_rig_wall(&rig), 10 * (n - 1) % 256);
        assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
        assert_int_equal(hal_time_now_us(rig.clock), display_rig_blank_us(n - 1)); /* virtual: no time has passed */
        display_rig_go_to(&rig, display_rig_blank_us(n));
        assert_int_equal(display_rig_wall(&rig), 10 * n % 256);
    }
    assert_int_equal(sim_display_counts(rig.display).flips, 29);
    assert_int_equal(sim_display_counts(rig.display).missed, 0);
    display_rig_close(&rig);
}

static void test_missed_blanks_are_counted(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    display_rig_go_to(&rig, display_rig_blank_us(5));
    assert_int_equal(sim_display_counts(rig.display).missed, 0); /* nothing shown yet: nothing missed */
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(8)); /* flips at 6; 7 and 8 bring nothing */
    assert_int_equal(display_rig_wall(&rig), 1);
    assert_int_equal(sim_display_counts(rig.display).missed, 2);
    /* Without a word to the display, blank 9 passes: what is presented now is for blank 10. */
    sim_clock_set_us(rig.clock, display_rig_blank_us(9) + 1);
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK);
    assert_int_equal(hal_display_next_vblank_us(rig.display), display_rig_blank_us(10));
    sim_display_advance(rig.display, display_rig_blank_us(9) + 2);
    assert_int_equal(display_rig_wall(&rig), 1);
    display_rig_go_to(&rig, display_rig_blank_us(10));
    assert_int_equal(display_rig_wall(&rig), 2);
    assert_int_equal(sim_display_counts(rig.display).missed, 3);
    display_rig_close(&rig);
}

static void test_borrowing_rules(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(DISPLAY_RIG_EPOCH_US);
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    picture_t first, again;
    assert_int_equal(display_rig_borrow(&rig, &first), HAL_OK);
    assert_int_equal(display_rig_borrow(&rig, &again), HAL_OK);
    assert_ptr_equal(first.data[0], again.data[0]);
    assert_int_equal(display_rig_draw(&rig, 1), HAL_OK);
    assert_int_equal(display_rig_draw(&rig, 2), HAL_OK); /* replaces 1 */
    assert_int_equal(hal_display_present(rig.display), HAL_BAD_CALL);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    assert_int_equal(display_rig_wall(&rig), 2);
    /* While the wall shows 2 and 3 waits, what is drawn is neither. */
    assert_int_equal(display_rig_draw(&rig, 3), HAL_OK);
    assert_int_equal(display_rig_borrow(&rig, &first), HAL_OK);
    memset(first.data[0], 99, (size_t)first.stride[0] * DISPLAY_RIG_HEIGHT);
    assert_int_equal(display_rig_wall(&rig), 2);
    display_rig_go_to(&rig, display_rig_blank_us(2));
    assert_int_equal(display_rig_wall(&rig), 3);
    assert_int_equal(sim_display_counts(rig.display).replaced, 1);
    assert_int_equal(sim_display_counts(rig.display).flips, 2);
    display_rig_close(&rig);
}

static void test_blanks_before_the_first_one(void **state)
{
    (void)state;
    const display_rig_t rig = display_rig_open(display_rig_blank_us(-10));
    assert_int_equal(hal_display_next_vblank_us(rig.display), display_rig_blank_us(-9));
    assert_int_equal(display_rig_draw(&rig, 5), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(-9));
    assert_int_equal(display_rig_wall(&rig), 5);
    display_rig_close(&rig);
}

/* A whole panel of one colour, BT.601's red: what color.h makes of it is on the wall. */
static void check_format(picture_format_t format)
{
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = DISPLAY_RIG_EPOCH_US}, error);
    sim_display_settings_t settings = display_rig_settings(clock);
    settings.width = 6;
    settings.height = 4;
    settings.format = format;
    const display_rig_t rig = {clock, sim_display_create(&settings, error)};
    for (picture_format_t f = PICTURE_XRGB8888; f < PICTURE_FORMATS; f++) {
        picture_t buffer = {.width = -1};
        const bool taken = f == PICTURE_XRGB8888 || f == format;
        assert_int_equal(hal_display_takes(rig.display, f), taken);
        if (!taken)
            assert_int_equal(hal_display_back_buffer(rig.display, f, PICTURE_BT601, &buffer), HAL_BAD_CALL);
        assert_int_equal(buffer.width, -1);
    }
    picture_t other, buffer;
    assert_int_equal(display_rig_borrow(&rig, &other), HAL_OK);
    assert_int_equal(hal_display_back_buffer(rig.display, format, PICTURE_BT601, &buffer), HAL_OK);
    assert_ptr_equal(other.data[0], buffer.data[0]); /* the same one, of the format asked for last */
    assert_true(buffer.format == format && buffer.matrix == PICTURE_BT601 && picture_is_valid(&buffer));
    for (int32_t y = 0; y < 4; y++)
        for (int32_t x = 0; x < 6; x++) {
            uint8_t *row = buffer.data[0] + (ptrdiff_t)y * buffer.stride[0];
            row[format == PICTURE_YUYV ? 2 * x : x] = 81;
            if (format == PICTURE_YUYV)
                row[2 * x + 1] = x % 2 ? 240 : 90;
            else
                buffer.data[1][y / 2 * buffer.stride[1] + x] = x % 2 ? 240 : 90;
        }
    assert_int_equal(hal_display_present(rig.display), HAL_OK);
    display_rig_go_to(&rig, display_rig_blank_us(1));
    const image_t *shown = sim_display_shown(rig.display);
    assert_non_null(shown);
    assert_true(shown->width == 6 && shown->height == 4 && shown->format == IMAGE_XRGB8888);
    for (int32_t y = 0; y < 4; y++)
        for (int32_t x = 0; x < 6; x++)
            assert_memory_equal(image_row(shown, y) + 4 * x, ((const uint8_t[]){0, 0, 254, 0}), 4);
    display_rig_close(&rig);
}

static void test_other_formats(void **state)
{
    (void)state;
    check_format(PICTURE_NV12);
    check_format(PICTURE_YUYV);
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
    sim_display_settings_t settings = display_rig_settings(clock);
    settings.while_waiting = count_call;
    settings.context = &calls;
    const display_rig_t rig = {clock, sim_display_create(&settings, error)};
    for (int n = 1; n <= 3; n++) {
        const int64_t next_us = hal_display_next_vblank_us(rig.display);
        assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
        assert_true(hal_time_now_us(clock) >= next_us);
        assert_int_equal(calls, n);
    }
    assert_int_equal(display_rig_draw(&rig, 7), HAL_OK);
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_OK);
    assert_int_equal(display_rig_wall(&rig), 7); /* with nobody but the wait to flip it */
    const int64_t dark_us = hal_display_next_vblank_us(rig.display);
    sim_display_faults(rig.display)->unplugged_until_us = INT64_MAX;
    assert_int_equal(hal_display_wait_vblank(rig.display), HAL_IO);
    assert_true(hal_time_now_us(clock) >= dark_us);
    display_rig_close(&rig);
}

/* The blanks of all displays are at the same moments; each board is told them on its own clock. */
static void test_blanks_are_told_on_the_boards_clock(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    const sim_clock_settings_t fast = {.offset_us = 7000000, .drift_ppb = 1000000};
    hal_time_t *clock = sim_clock_create(&fast, error);
    sim_display_settings_t settings = display_rig_settings(clock);
    const display_rig_t rig = {clock, sim_display_create(&settings, error)};
    sim_clock_set_us(clock, display_rig_blank_us(59) + 1);
    const int64_t expected_us = display_rig_blank_us(60) + 7000000 + display_rig_blank_us(60) / 1000;
    assert_int_equal(hal_display_next_vblank_us(rig.display), expected_us);
    assert_int_equal(display_rig_draw(&rig, 3), HAL_OK);
    sim_display_advance(rig.display, display_rig_blank_us(60) - 1);
    assert_int_equal(display_rig_wall(&rig), -1);
    sim_display_advance(rig.display, display_rig_blank_us(60));
    assert_int_equal(display_rig_wall(&rig), 3);
    display_rig_close(&rig);
}

static void test_bad_settings(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    hal_time_t *clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = 0}, error);
    sim_display_settings_t settings = display_rig_settings(clock);
    settings.height = 0;
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: panel 5x0, expected at most 4096x2160");
    settings = (sim_display_settings_t){
        .width = DISPLAY_RIG_WIDTH, .height = DISPLAY_RIG_HEIGHT, .clock = clock, .blanks = {0, 0, 1}};
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: 0 blanks in 1 s, expected up to 1000000 a second");
    settings = display_rig_settings(clock);
    settings.format = PICTURE_NV12;
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: panel 5x3, expected an even size for nv12");
    settings.format = PICTURE_BGR888;
    assert_null(sim_display_create(&settings, error));
    assert_string_equal(error, "display: format bgr888, expected xrgb8888, nv12 or yuyv");
    sim_clock_destroy(clock);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pictures_flip_at_blanks),
        cmocka_unit_test(test_missed_blanks_are_counted),
        cmocka_unit_test(test_borrowing_rules),
        cmocka_unit_test(test_blanks_before_the_first_one),
        cmocka_unit_test(test_other_formats),
        cmocka_unit_test(test_blanks_are_told_on_the_boards_clock),
        cmocka_unit_test(test_bad_settings),
        cmocka_unit_test(test_a_real_clock_is_waited_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
