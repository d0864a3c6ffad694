// SPDX-License-Identifier: Apache-2.0
// The window loop against the float definition of the kernels, on the worst pictures.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/support/float_methods.h"
#include "tests/support/rng.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/prefilter.h"

enum { WIDTH = 160, HEIGHT = 150 };

static const struct {
    warp_resampler_t resampler;
    bool of_coefficients;
    int32_t sides;
    int levels; /* that the loop may be away from its float definition */
} loops[] = {
    {WARP_LINEAR, false, 1, 1},
    {WARP_LINEAR, true, 1, 1},
    {WARP_CUBIC, false, 1, 4},
    {WARP_CUBIC, true, 1, 1},
    {WARP_SPLINE, true, 1, 1},
    {WARP_AREA, false, WINDOW_SIDES, 2},
    {WARP_MEAN_CUBIC, false, WINDOW_SIDES, 4},
    {WARP_MEAN_SPLINE, true, WINDOW_SIDES, 1},
};
enum { LOOPS = sizeof loops / sizeof *loops };

static window_weights_t weights;
static uint8_t gray[WIDTH * HEIGHT], color[WIDTH * HEIGHT * 4];
static double surface[WIDTH * HEIGHT]; /* what the kernel weighs: gray, or its spline coefficients */
static int16_t gray_coefficients[WIDTH * HEIGHT], color_coefficients[WIDTH * HEIGHT * 4];
static prefilter_t prefilter;

static double float_definition(warp_resampler_t resampler, const double point[2], const double side[2])
{
    double sum = 0, wx[WIDTH + 400], wy[HEIGHT + 400];
    const int margin = 200;
    for (int i = -margin; i < WIDTH + margin; i++)
        wx[i + margin] = float_weight(resampler, point[0] - i - 0.5, side[0]);
    for (int j = -margin; j < HEIGHT + margin; j++)
        wy[j + margin] = float_weight(resampler, point[1] - j - 0.5, side[1]);
    for (int j = -margin; j < HEIGHT + margin; j++) {
        if (wy[j + margin] == 0)
            continue;
        double row = 0;
        for (int i = -margin; i < WIDTH + margin; i++)
            if (wx[i + margin] != 0)
                row += wx[i + margin] * surface[mirror_index(j, HEIGHT) * WIDTH + mirror_index(i, WIDTH)];
        sum += wy[j + margin] * row;
    }
    return fmax(0, fmin(255, sum));
}

static void paint(int kind, rng_t *rng)
{
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const bool on = kind == 0   ? (x + y) % 2 == 1
                            : kind == 1 ? rng_int(rng, 0, 1) == 1
                            : kind == 2 ? x % 2 == 1
                            : kind == 3 ? y % 2 == 1
                                        : (x / 3 + y / 2) % 2 == 1;
            gray[y * WIDTH + x] = kind == 5 ? (uint8_t)rng_int(rng, 0, 255) : on ? 255 : 0;
        }
    }
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        memset(color + 4 * k, gray[k], 4);
}

static void make_surface(warp_resampler_t resampler)
{
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        surface[k] = gray[k];
    if (warp_splines(resampler))
        float_spline_coefficients(surface, WIDTH, HEIGHT);
}

/* From gray: those of the spline, or its own levels. */
static void make_coefficients(warp_resampler_t resampler)
{
    const image_t picture = {gray, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    const int16_t *spline = NULL;
    if (prefilter_begin(&prefilter, WARP_FILTER_NONE, 0, warp_splines(resampler))) {
        const level_t whole = {0, 0, 0};
        prefilter_make_coefficients(&prefilter, &warp_kernels_scalar, &picture, whole, only_worker);
        spline = prefilter_coefficients(&prefilter, &picture, whole).data;
    }
    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        gray_coefficients[k] = (int16_t)(spline != NULL ? spline[k] : (gray[k] - COEFFICIENT_MIDDLE) * 16);
        for (int channel = 0; channel < 4; channel++)
            color_coefficients[4 * k + channel] = gray_coefficients[k];
    }
}

static window_t window_of(int32_t side_x, int32_t side_y)
{
    return (window_t){.x = window_axis(&weights, (uint16_t)side_x),
                      .y = window_axis(&weights, (uint16_t)side_y),
                      .picture = {gray, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8},
                      .coefficients = {gray_coefficients, WIDTH, HEIGHT, 1},
                      .width = WIDTH,
                      .height = HEIGHT};
}

static uint8_t pixel_at(const window_t *window, int32_t x_q18, int32_t y_q18)
{
    uint8_t pixel;
    const patch_t patch = {&pixel, 0, &x_q18, &y_q18, 1, 1};
    (weights.of_coefficients ? resample_coefficients_gray_scalar : resample_window_gray_scalar)(&patch, window);
    return pixel;
}

/* Every method stays within `levels` of its float definition at the loop's own positions and sides. */
static void compare(int loop)
{
    const warp_resampler_t resampler = loops[loop].resampler;
    const int32_t sides = loops[loop].sides;
    int worst = 0;
    window_weights_init(&weights, resampler, loops[loop].of_coefficients);
    for (uint64_t seed = 1; seed <= 12000; seed++) {
        rng_t rng = {seed};
        if (seed % 2000 == 1) {
            paint((int)(seed / 2000), &rng);
            make_surface(resampler);
            make_coefficients(resampler);
        }
        const int32_t side[2] = {(int32_t)rng_int(&rng, 0, sides - 1), (int32_t)rng_int(&rng, 0, sides - 1)};
        const int32_t x = (int32_t)rng_int(&rng, 0, WIDTH * PHASES), y = (int32_t)rng_int(&rng, 0, HEIGHT * PHASES);
        const double point[2] = {(double)x / PHASES, (double)y / PHASES};
        const double sides_px[2] = {float_side(side[0]), float_side(side[1])};
        const window_t window = window_of(side[0], side[1]);
        const int32_t x_q18 = x << (18 - PHASE_BITS), y_q18 = y << (18 - PHASE_BITS);
        const uint8_t got = pixel_at(&window, x_q18, y_q18);
        const int expected = (int)floor(float_definition(resampler, point, sides_px) + 0.5);
        const int error = got > expected ? got - expected : expected - got;
        worst = error > worst ? error : worst;
        if (error > loops[loop].levels)
            fail_msg("seed %lu, method %d, point (%f, %f), sides (%f, %f): %d, expected %d", (unsigned long)seed,
                     resampler, point[0], point[1], sides_px[0], sides_px[1], got, expected);
    }
    printf("method %d%s: worst difference %d levels\n", resampler, loops[loop].of_coefficients ? ", coefficients" : "",
           worst);
}

static void methods_keep_their_definition(void **state)
{
    (void)state;
    for (int r = 0; r < LOOPS; r++)
        compare(r);
}

/* A constant picture comes out unchanged, whatever the level, and so does any picture at 1:1. */
static void constants_and_identity_are_exact(void **state)
{
    (void)state;
    rng_t rng = {7};
    for (int r = 0; r < LOOPS; r++) {
        window_weights_init(&weights, loops[r].resampler, loops[r].of_coefficients);
        for (int level = 0; level < 256; level++) {
            memset(gray, level, sizeof(gray));
            make_coefficients(loops[r].resampler);
            for (int n = 0; n < 20; n++) {
                const int32_t side_x = (int32_t)rng_int(&rng, 0, loops[r].sides - 1);
                const int32_t side_y = (int32_t)rng_int(&rng, 0, loops[r].sides - 1);
                const window_t window = window_of(side_x, side_y);
                const int32_t x = (int32_t)rng_int(&rng, -9, WIDTH << 18), y = (int32_t)rng_int(&rng, 0, HEIGHT << 18);
                assert_int_equal(pixel_at(&window, x, y), level);
            }
        }
        paint(5, &rng);
        make_coefficients(loops[r].resampler);
        const uint16_t one = window_side(loops[r].resampler, 1 << 16).side;
        const window_t window = window_of(one, one);
        for (int32_t k = 0; k < WIDTH * HEIGHT; k++)
            assert_int_equal(pixel_at(&window, (k % WIDTH << 18) + (1 << 17), (k / WIDTH << 18) + (1 << 17)), gray[k]);
    }
}

static void color_is_gray_four_times(warp_resampler_t resampler, bool of_coefficients, resample_window_fn *loop)
{
    rng_t rng = {11};
    paint(5, &rng);
    make_coefficients(resampler);
    window_weights_init(&weights, resampler, of_coefficients);
    for (int n = 0; n < 3000; n++) {
        const int32_t side_x = (int32_t)rng_int(&rng, 0, WINDOW_SIDES - 1);
        const int32_t side_y = (int32_t)rng_int(&rng, 0, WINDOW_SIDES - 1);
        const window_t in_gray = window_of(side_x, side_y);
        window_t in_color = in_gray;
        in_color.picture = (image_t){color, WIDTH, HEIGHT, 4 * WIDTH, IMAGE_XRGB8888};
        in_color.coefficients = (coefficients_t){color_coefficients, WIDTH, HEIGHT, 4};
        const int32_t x = (int32_t)rng_int(&rng, -(1 << 20), (WIDTH << 18) + (1 << 20));
        const int32_t y = (int32_t)rng_int(&rng, -(1 << 20), (HEIGHT << 18) + (1 << 20));
        uint8_t four[4];
        const patch_t patch = {four, 0, &x, &y, 1, 1};
        loop(&patch, &in_color);
        for (int c = 0; c < 4; c++)
            assert_int_equal(four[c], pixel_at(&in_gray, x, y));
    }
}

static void color_is_gray(void **state)
{
    (void)state;
    color_is_gray_four_times(WARP_MEAN_CUBIC, false, resample_window_xrgb_scalar);
    color_is_gray_four_times(WARP_MEAN_SPLINE, true, resample_coefficients_xrgb_scalar);
}

int main(void)
{
    prefilter_init(&prefilter);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(methods_keep_their_definition),
        cmocka_unit_test(constants_and_identity_are_exact),
        cmocka_unit_test(color_is_gray),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
