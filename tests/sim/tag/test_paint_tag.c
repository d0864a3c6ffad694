// SPDX-License-Identifier: Apache-2.0
// The engine's painters: nothing but the code is touched, and the shader, read as C, draws the same.
#include "sim/tag/paint_tag.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/support/rng.h"

typedef unsigned int uint;
int paint_tag_block(int x, int y, int width, int height);
uint paint_tag_crc(uint crc, uint word, int bytes);
int paint_tag_level(int block, uint viewer, uint capture_time_us, uint frame_number);
#include "sim/tag/paint_tag.glsl"

enum { MAX_WIDTH = 4096, MAX_HEIGHT = 64, AROUND = 100, GAP = 5 };

static uint8_t pixels[MAX_HEIGHT * (MAX_WIDTH * 4 + GAP)];

/* Every pixel of the upper part of a picture, by both. */
static void compare(const paint_tag_picture_t *picture, const paint_tag_t *tag)
{
    for (int y = 0; y < picture->height && y < MAX_HEIGHT; y++)
        for (int x = 0; x < picture->width; x++) {
            const uint8_t *pixel = picture->pixels + y * picture->row_bytes + (ptrdiff_t)x * picture->pixel_bytes;
            const int block = paint_tag_block(x, y, picture->width, picture->height);
            const int level =
                block < 0 ? AROUND : paint_tag_level(block, tag->viewer, tag->capture_time_us, tag->frame_number);
            for (int c = 0; c < picture->pixel_bytes; c++) {
                const int expected = c == 3 && block >= 0 ? 255 : level;
                if (pixel[c] != expected)
                    fail_msg("%d x %d, pixel %d, %d, byte %d: %d, and the shader has %d", picture->width,
                             picture->height, x, y, c, pixel[c], expected);
            }
        }
}

static void the_shader_draws_the_same(void **state)
{
    (void)state;
    static const int sizes[][2] = {{96, 44},  {96, 54},   {319, 52},  {320, 52},   {480, 60},   {487, 60},
                                   {959, 60}, {960, 540}, {963, 540}, {1280, 720}, {4096, 2160}};
    rng_t rng = {1};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (int bytes = 1; bytes <= 4; bytes += bytes == 1 ? 2 : 1) {
            const paint_tag_picture_t picture = {pixels, sizes[s][0], sizes[s][1], (ptrdiff_t)sizes[s][0] * bytes + GAP,
                                                 bytes};
            const paint_tag_t tag = {(uint32_t)rng_next(&rng), (uint32_t)rng_next(&rng), (unsigned)rng_int(&rng, 0, 3)};
            memset(pixels, AROUND, sizeof pixels);
            assert_true(paint_tag(&picture, &tag));
            compare(&picture, &tag);
            for (int y = 0; y < MAX_HEIGHT && y < picture.height; y++)
                for (int gap = 0; gap < GAP; gap++)
                    assert_int_equal(pixels[(y + 1) * picture.row_bytes - 1 - gap], AROUND);
        }
}

static void rows_may_be_stored_from_the_bottom_up(void **state)
{
    (void)state;
    enum { WIDTH = 480, HEIGHT = 60, ROW = WIDTH * 4 };
    static uint8_t down[HEIGHT * ROW], up[HEIGHT * ROW];
    const paint_tag_t tag = {1, 2, 3};
    const paint_tag_picture_t downward = {down, WIDTH, HEIGHT, ROW, 4};
    const paint_tag_picture_t upward = {up + (HEIGHT - 1) * ROW, WIDTH, HEIGHT, -ROW, 4};
    assert_true(paint_tag(&downward, &tag));
    assert_true(paint_tag(&upward, &tag));
    for (int y = 0; y < HEIGHT; y++)
        assert_memory_equal(up + (ptrdiff_t)(HEIGHT - 1 - y) * ROW, down + (ptrdiff_t)y * ROW, ROW);
}

static void what_has_no_room_stays_as_it_is(void **state)
{
    (void)state;
    static const struct {
        int width, height, pixel_bytes;
        unsigned viewer;
    } bad[] = {{96, 43, 4, 0}, {3, 4000, 1, 0}, {0, 0, 1, 0}, {480, 60, 2, 0}, {480, 60, 0, 0}, {480, 60, 4, 4}};
    memset(pixels, AROUND, sizeof pixels);
    for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++) {
        const paint_tag_picture_t picture = {pixels, bad[b].width, bad[b].height, 4 * 480, bad[b].pixel_bytes};
        assert_false(paint_tag(&picture, &(paint_tag_t){1, 2, bad[b].viewer}));
    }
    for (size_t n = 0; n < sizeof pixels; n++)
        assert_int_equal(pixels[n], AROUND);
    assert_int_equal(paint_tag_block(0, 0, 96, 43), -1);
    assert_int_equal(paint_tag_block(0, 0, 3, 4000), -1);
    assert_int_equal(paint_tag_block(0, -1, 480, 60), -1);
    assert_int_equal(paint_tag_block(-1, 0, 480, 60), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shader_draws_the_same),
        cmocka_unit_test(rows_may_be_stored_from_the_bottom_up),
        cmocka_unit_test(what_has_no_room_stays_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
