// SPDX-License-Identifier: Apache-2.0
// Letters and texts on a panel: every letter is one of its own, texts are as large as they fit, nothing is drawn off
// the box or the panel.
#include "firmware/panel_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/font_5x8.h"
#include "firmware/panel_draw.h"
#include "sim/devices/sim_picture.h"

enum { WIDTH = 120, HEIGHT = 80, GUARD = 256, UNTOUCHED = 0xa5, DARK = 10, LIGHT = 200, FIRST = ' ', LAST = '~' };

static uint8_t bytes[GUARD + WIDTH * HEIGHT + GUARD];

static picture_t blank(int32_t width, int32_t height)
{
    const picture_t panel = sim_picture(PICTURE_GRAY8, width, height, bytes + GUARD);
    memset(bytes, UNTOUCHED, sizeof bytes);
    panel_draw_ground(&panel, DARK);
    return panel;
}

static bool lit(const picture_t *panel, int32_t x, int32_t y)
{
    return panel->data[0][y * panel->stride[0] + x] == LIGHT;
}

static void expect_guards(const picture_t *panel)
{
    for (size_t i = 0; i < GUARD; i++) {
        assert_int_equal(bytes[i], UNTOUCHED);
        assert_int_equal(bytes[GUARD + sim_picture_bytes(panel) + i], UNTOUCHED);
    }
}

static uint64_t look_of(int c)
{
    uint64_t look = 0;
    for (int32_t y = 0; y < FONT_HEIGHT; y++)
        for (int32_t x = 0; x < FONT_WIDTH; x++)
            look = look << 1 | font_pixel((char)c, x, y);
    return look;
}

static void every_letter_is_one_of_its_own(void **state)
{
    (void)state;
    const uint64_t box = look_of(0x7f);
    assert_int_equal(look_of(' '), 0);
    assert_true(box != 0);
    for (int a = FIRST; a <= LAST; a++) {
        assert_true(a == ' ' || look_of(a) != 0);
        assert_true(look_of(a) != box);
        for (int b = FIRST; b < a; b++)
            if (look_of(a) == look_of(b))
                fail_msg("'%c' looks as '%c'", a, b);
    }
    for (int c = -128; c < FIRST; c++)
        assert_true(look_of(c) == box);
}

/* No letter has a pixel where the next line begins: of the gap, nothing is drawn. */
static void a_letter_is_drawn_as_it_looks(void **state)
{
    (void)state;
    for (int32_t scale = 1; scale <= 4; scale++) {
        const picture_t panel = blank(WIDTH, HEIGHT);
        panel_text_draw(&panel, &(panel_text_box_t){7, 5, 40, 40, scale}, "g", LIGHT);
        for (int32_t y = 0; y < HEIGHT; y++)
            for (int32_t x = 0; x < WIDTH; x++) {
                const int32_t column = (x - 7) / scale, row = (y - 5) / scale;
                const bool inside = x >= 7 && y >= 5 && column < FONT_WIDTH && row < FONT_HEIGHT;
                assert_int_equal(lit(&panel, x, y), inside && font_pixel('g', column, row));
            }
    }
}

static void lines_are_below_one_another(void **state)
{
    (void)state;
    const panel_text_box_t box = {0, 0, 2 * FONT_ADVANCE - 1, HEIGHT, 1};
    const picture_t panel = blank(WIDTH, HEIGHT);
    panel_text_draw(&panel, &box, "ab \xc3\xa4", LIGHT);
    for (int32_t y = 0; y < FONT_HEIGHT; y++)
        for (int32_t x = 0; x < FONT_WIDTH; x++) {
            assert_int_equal(lit(&panel, x, y), font_pixel('a', x, y));
            assert_int_equal(lit(&panel, x + FONT_ADVANCE, y), font_pixel('b', x, y));
            assert_int_equal(lit(&panel, x, y + FONT_LINE), font_pixel(0x7f, x, y));
            assert_false(lit(&panel, x + FONT_ADVANCE, y + FONT_LINE));
        }
    assert_int_equal(panel_text_height(&box, "ab \xc3\xa4"), FONT_LINE + FONT_HEIGHT);
    assert_int_equal(panel_text_height(&box, ""), 0);
}

static void texts_are_as_large_as_they_fit(void **state)
{
    (void)state;
    panel_text_box_t box = {0, 0, 29, 18, 1}; /* five letters, two lines */
    assert_int_equal(panel_text_scale(&box, "abcde fghij", 9), 1);
    assert_int_equal(panel_text_scale(&box, "abcde fghij klmno", 9), 1); /* does not fit at all */
    assert_int_equal(panel_text_scale(&box, "abcde", 9), 1);
    assert_int_equal(panel_text_scale(&box, "ab", 9), 2);
    box.width = 58;
    assert_int_equal(panel_text_scale(&box, "abcde", 9), 2);
    box.height = 36;
    assert_int_equal(panel_text_scale(&box, "abcde fghij", 9), 2);
    box.height = 35;
    assert_int_equal(panel_text_scale(&box, "abcde fghij", 9), 1);
    assert_int_equal(panel_text_scale(&box, "a", 9), 4);
    assert_int_equal(panel_text_scale(&box, "a", 3), 3);
}

static void nothing_is_drawn_off_the_box(void **state)
{
    (void)state;
    static const char text[] = "MMMMMMMMMMMMMMMMMMMM gggggggggggggggggggg MMMMMMMMMM";
    const picture_t panel = blank(WIDTH, HEIGHT);
    panel_text_draw(&panel, &(panel_text_box_t){20, 10, 50, 27, 1}, text, LIGHT);
    int32_t lowest = 0;
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++)
            if (lit(&panel, x, y)) {
                assert_true(x >= 20 && x < 70 && y >= 10 && y < 37);
                lowest = y;
            }
    assert_true(lowest < 10 + FONT_LINE + FONT_HEIGHT); /* a third line would not be whole */
    assert_true(lowest >= 10 + FONT_LINE);
}

static void nothing_is_drawn_off_the_panel(void **state)
{
    (void)state;
    for (int32_t at = -70; at < 70; at += 7)
        for (int32_t scale = 1; scale <= 9; scale += 4) {
            const picture_t panel = blank(64, 48);
            panel_text_draw(&panel, &(panel_text_box_t){at, at, 200, 200, scale}, "The quick brown fox", LIGHT);
            expect_guards(&panel);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_letter_is_one_of_its_own), cmocka_unit_test(a_letter_is_drawn_as_it_looks),
        cmocka_unit_test(lines_are_below_one_another),    cmocka_unit_test(texts_are_as_large_as_they_fit),
        cmocka_unit_test(nothing_is_drawn_off_the_box),   cmocka_unit_test(nothing_is_drawn_off_the_panel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
