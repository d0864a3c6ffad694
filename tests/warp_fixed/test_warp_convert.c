// SPDX-License-Identifier: Apache-2.0
// Pictures that are taken apart: what a panel shows of them is, and no more than is near it.
#include "warp_fixed/warp_convert.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"

enum { WIDTH = 400, HEIGHT = 320, PANEL = 64, FRAMES_EACH = 24, FRAMES = FRAMES_EACH * WARP_METHODS, LEFT_OVER = 0xa5 };

static warp_t warp;
static uint8_t picture_bytes[WIDTH * HEIGHT * 3], panel_bytes[2][PANEL * PANEL * 4];

/* Make a frame when all that was taken apart before is of one byte. */
static void make_frame(const homography_t *h, picture_format_t format, uint8_t *panel, int before)
{
    static const int32_t bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    const picture_t picture = {format, PICTURE_BT709, WIDTH, HEIGHT, {picture_bytes}, {WIDTH * bytes[format]}};
    const picture_t to = {PICTURE_XRGB8888, PICTURE_BT709, PANEL, PANEL, {panel}, {PANEL * 4}};
    memset(warp.converted, before, WIDTH * HEIGHT * 4);
    memset(warp.converted + (ptrdiff_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT, before, WIDTH * HEIGHT);
    assert_true(warp_plan(&warp, warp_kernels_best(), NULL, h, &to, &picture));
    warp_steps_run(&warp, NULL);
}

/* Turned, near and far, often with part of the panel behind the viewer: its middle or a corner is in the picture. */
static homography_t any_homography(rng_t *rng)
{
    const double zoom = exp2(rng_double(rng, -5, 10)), turn = rng_double(rng, -3.2, 3.2);
    const double a = zoom * cos(turn), b = zoom * sin(turn);
    const double g = rng_double(rng, -3, 3) / PANEL, k = rng_double(rng, -3, 3) / PANEL,
                 middle = (double)rng_int(rng, 0, 2) * PANEL / 2;
    const double x = rng_double(rng, -0.1, 1.1) * WIDTH, y = rng_double(rng, -0.1, 1.1) * HEIGHT;
    const double rows[9] = {a + g * x, -b + k * x, x - (a + g * x) * middle - (-b + k * x) * middle,
                            b + g * y, a + k * y,  y - (b + g * y) * middle - (a + k * y) * middle,
                            g,         k,          1 - (g + k) * middle};
    return homography_of(rows, (homography_sizes_t){PANEL, PANEL, WIDTH, HEIGHT});
}

static void nothing_else_is_read(void **state)
{
    (void)state;
    static const picture_format_t formats[] = {PICTURE_YUYV, PICTURE_RGB888, PICTURE_UYVY, PICTURE_BGR888};
    static const uint8_t border[3] = {1, 2, 3};
    rng_t noise = {1};
    int lit = 0;
    for (size_t i = 0; i < sizeof picture_bytes; i++)
        picture_bytes[i] = (uint8_t)rng_int(&noise, 0, 255);
    for (int n = 0; n < FRAMES; n++) {
        rng_t rng = {(uint64_t)n + 1};
        const picture_format_t format = formats[n % 4];
        const warp_method_t *method = &warp_methods[n / FRAMES_EACH];
        const homography_t h = any_homography(&rng);
        if (n % FRAMES_EACH == 0)
            warp_init(&warp, *method, false, border);
        make_frame(&h, format, panel_bytes[0], 0);
        make_frame(&h, format, panel_bytes[1], 255);
        lit += warp.any_lit;
        if (memcmp(panel_bytes[0], panel_bytes[1], sizeof panel_bytes[0]) != 0)
            fail_msg("frame %d, %s, format %d: something is read that was not taken apart", n, method->name,
                     (int)format);
    }
    assert_true(lit > FRAMES / 2);
}

static void what_is_far_is_left(void **state)
{
    (void)state;
    static const double rows[9] = {1, 0, 180, 0, 1, 150, 0, 0, 1};
    static const uint8_t border[3] = {1, 2, 3};
    const homography_t h = homography_of(rows, (homography_sizes_t){PANEL, PANEL, WIDTH, HEIGHT});
    warp_init(&warp, *warp_method_default(), false, border);
    make_frame(&h, PICTURE_RGB888, panel_bytes[0], LEFT_OVER);
    int taken = 0;
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        taken += memcmp(warp.converted + 4 * k, (const uint8_t[]){LEFT_OVER, LEFT_OVER, LEFT_OVER, LEFT_OVER}, 4) != 0;
    const int side = PANEL + 2 * (WINDOW_MAX_TAPS + 4);
    assert_in_range(taken, PANEL * PANEL, side * side);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_else_is_read),
        cmocka_unit_test(what_is_far_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
