// SPDX-License-Identifier: Apache-2.0
// Tests of the pictures for setting up: whole planes of one level, and the grid's lines where they must be.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/pattern_picture.h"

enum { WIDTH = 480, HEIGHT = 270, EDGE = 4, STRIDE = WIDTH * 4 + EDGE, GUARD = 0xA5 };

static uint8_t memory[HEIGHT * STRIDE];

static picture_t gray_panel(int32_t width, int32_t height)
{
    memset(memory, GUARD, sizeof memory);
    return (picture_t){.format = PICTURE_GRAY8, .width = width, .height = height, .data = {memory}, .stride = {STRIDE}};
}

static uint8_t level_at(int32_t x, int32_t y)
{
    return memory[y * STRIDE + x];
}

static void test_one_level(void **state)
{
    (void)state;
    for (int white = 0; white < 2; white++) {
        const picture_t panel = gray_panel(WIDTH, HEIGHT);
        pattern_picture_draw(&panel, white == 1 ? COMMAND_PATTERN_WHITE : COMMAND_PATTERN_BLACK);
        for (int32_t y = 0; y < HEIGHT; y++) {
            for (int32_t x = 0; x < WIDTH; x++)
                assert_int_equal(level_at(x, y), white == 1 ? 255 : 0);
            assert_int_equal(level_at(WIDTH, y), GUARD);
        }
    }
}

/* Squares of 33 pixels about (240, 135); the middle lines are 2 wide, the others 1. */
static void test_grid(void **state)
{
    (void)state;
    const picture_t panel = gray_panel(WIDTH, HEIGHT);
    pattern_picture_draw(&panel, COMMAND_PATTERN_GRID);
    for (int32_t y = 0; y < HEIGHT; y++) {
        for (int32_t x = 0; x < WIDTH; x++) {
            const bool upright = (x - 240) % 33 == 0 || x == 239 || x == 0 || x == WIDTH - 1;
            const bool level = (y - 135) % 33 == 0 || y == 134 || y == 0 || y == HEIGHT - 1;
            if (level_at(x, y) != (upright || level ? 255 : 0))
                fail_msg("(%d, %d) is %d", x, y, level_at(x, y));
        }
        assert_int_equal(level_at(WIDTH, y), GUARD);
    }
}

/* Panels as small as they may be: nothing beside them is touched. */
static void test_small_panels(void **state)
{
    (void)state;
    for (int32_t size = 1; size <= 20; size++) {
        const picture_t panel = gray_panel(size, size);
        pattern_picture_draw(&panel, COMMAND_PATTERN_GRID);
        assert_int_equal(level_at(0, 0), 255);
        for (int32_t y = 0; y < size; y++)
            assert_int_equal(level_at(size, y), GUARD);
        assert_int_equal(level_at(0, size), GUARD);
    }
}

static void test_luma_and_chroma(void **state)
{
    (void)state;
    static uint8_t chroma[HEIGHT / 2 * WIDTH];
    picture_t panel = gray_panel(WIDTH, HEIGHT);
    panel.format = PICTURE_NV12;
    panel.data[1] = chroma;
    panel.stride[1] = WIDTH;
    pattern_picture_draw(&panel, COMMAND_PATTERN_GRID);
    assert_int_equal(level_at(0, 0), 235);
    assert_int_equal(level_at(2, 2), 16);
    for (size_t i = 0; i < sizeof chroma; i++)
        assert_int_equal(chroma[i], 128);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_level),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_small_panels),
        cmocka_unit_test(test_luma_and_chroma),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
