// SPDX-License-Identifier: Apache-2.0
// The window loop and its weights against the float definition of the kernels, on the worst pictures.
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
#include "warp_fixed/spline.h"

enum { WIDTH = 160, HEIGHT = 150 };

static const struct {
    warp_resampler_t resampler;
    int32_t sides;
    int levels; /* that the loop may be away from its float definition */
} loops[] = {
    {WARP_LINEAR, 1, 1},
    {WARP_CUBIC, 1, 4},
    {WARP_SPLINE, 1, 1},
    {WARP_AREA, WINDOW_SIDES, 2},
    {WARP_MEAN_CUBIC, WINDOW_SIDES, 4},
    {WARP_MEAN_SPLINE, WINDOW_SIDES, 1},
};
enum { LOOPS = sizeof loops / sizeof *loops };

static window_weights_t weights;
static uint8_t gray[WIDTH * HEIGHT], color[WIDTH * HEIGHT * 4];
static double surface[WIDTH * HEIGHT]; /* what the kernel weighs: gray, or its spline coefficients */
static spline_t spline;

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

/* After a change of the pixels, spline_begin() must have been called. */
static window_t window_of(int32_t side_x, int32_t side_y, uint8_t *pixels, image_format_t format)
{
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH * (int32_t)format, format};
    window_t window = {.x = window_axis(&weights, (uint16_t)side_x),
                       .y = window_axis(&weights, (uint16_t)side_y),
                       .picture = picture,
                       .width = WIDTH,
                       .height = HEIGHT};
    if (weights.spline)
        window.coefficients = spline_coefficients(&spline, &warp_kernels_scalar, &picture, 0, 0);
    return window;
}

static uint8_t pixel_at(const window_t *window, int32_t x_q18, int32_t y_q18)
{
    uint8_t pixel;
    (weights.spline ? resample_spline_gray_scalar : resample_window_gray_scalar)(&pixel, window, &x_q18, &y_q18, 1);
    return pixel;
}

/* Every method stays within `levels` of its float definition at the loop's own positions and sides. */
static void compare(warp_resampler_t resampler, int32_t sides, int levels)
{
    int worst = 0;
    window_weights_init(&weights, resampler);
    for (uint64_t seed = 1; seed <= 12000; seed++) {
        rng_t rng = {seed};
        if (seed % 2000 == 1) {
            paint((int)(seed / 2000), &rng);
            make_surface(resampler);
            spline_begin(&spline);
        }
        const int32_t side[2] = {(int32_t)rng_int(&rng, 0, sides - 1), (int32_t)rng_int(&rng, 0, sides - 1)};
        const int32_t x = (int32_t)rng_int(&rng, 0, WIDTH * PHASES), y = (int32_t)rng_int(&rng, 0, HEIGHT * PHASES);
        const double point[2] = {(double)x / PHASES, (double)y / PHASES};
        const double sides_px[2] = {float_side(side[0]), float_side(side[1])};
        const window_t window = window_of(side[0], side[1], gray, IMAGE_GRAY8);
        const int32_t x_q18 = x << (18 - PHASE_BITS), y_q18 = y << (18 - PHASE_BITS);
        const uint8_t got = pixel_at(&window, x_q18, y_q18);
        const int expected = (int)floor(float_definition(resampler, point, sides_px) + 0.5);
        const int error = got > expected ? got - expected : expected - got;
        worst = error > worst ? error : worst;
        if (error > levels)
            fail_msg("seed %lu, method %d, point (%f, %f), sides (%f, %f): %d, expected %d", (unsigned long)seed,
                     resampler, point[0], point[1], sides_px[0], sides_px[1], got, expected);
    }
    printf("method %d: worst difference %d levels\n", resampler, worst);
}

static void methods_keep_their_definition(void **state)
{
    (void)state;
    for (int r = 0; r < LOOPS; r++)
        compare(loops[r].resampler, loops[r].sides, loops[r].levels);
}

static void weights_sum_exactly_and_fit(void **state)
{
    (void)state;
    for (int r = 0; r < LOOPS; r++) {
        const bool is_spline = warp_splines(loops[r].resampler), positive = loops[r].resampler == WARP_AREA;
        const int32_t first_sum = is_spline ? 1 : positive ? FIRST_SUM_POSITIVE : FIRST_SUM;
        const int32_t second_sum = is_spline ? 1 << SPLINE_SUM_LOG2 : positive ? SECOND_SUM_POSITIVE : SECOND_SUM;
        window_weights_init(&weights, loops[r].resampler);
        for (int32_t side = 0; side < loops[r].sides; side++) {
            const window_axis_t axis = window_axis(&weights, (uint16_t)side);
            assert_in_range(axis.taps, 1, WINDOW_MAX_TAPS);
            assert_true(weights.at[side] + (uint32_t)axis.taps * PHASES <= WINDOW_POOL);
            for (int32_t phase = 0; phase < PHASES; phase++) {
                int32_t first = 0, second = 0;
                for (int32_t t = 0; t < axis.taps; t++) {
                    const int32_t w = axis.first[phase * axis.taps + t];
                    first += w;
                    second += axis.second[phase * axis.taps + t];
                    if (axis.first_shift == 0) /* 8-bit: unsigned, or negated and signed */
                        assert_true(positive ? w >= 0 && w <= 255 : -w >= -128 && -w <= 127);
                    assert_true(w >= 0 || !(is_spline || positive));
                }
                assert_int_equal(first, first_sum << axis.first_shift);
                assert_int_equal(second, second_sum);
            }
        }
    }
}

/* A constant picture comes out unchanged, whatever the level, and so does any picture at 1:1. */
static void constants_and_identity_are_exact(void **state)
{
    (void)state;
    rng_t rng = {7};
    for (int r = 0; r < LOOPS; r++) {
        window_weights_init(&weights, loops[r].resampler);
        for (int level = 0; level < 256; level++) {
            memset(gray, level, sizeof(gray));
            spline_begin(&spline);
            for (int n = 0; n < 20; n++) {
                const int32_t side_x = (int32_t)rng_int(&rng, 0, loops[r].sides - 1);
                const int32_t side_y = (int32_t)rng_int(&rng, 0, loops[r].sides - 1);
                const window_t window = window_of(side_x, side_y, gray, IMAGE_GRAY8);
                const int32_t x = (int32_t)rng_int(&rng, -9, WIDTH << 18), y = (int32_t)rng_int(&rng, 0, HEIGHT << 18);
                assert_int_equal(pixel_at(&window, x, y), level);
            }
        }
        paint(5, &rng);
        spline_begin(&spline);
        const uint16_t one = window_side(loops[r].resampler, 1 << 16).side;
        const window_t window = window_of(one, one, gray, IMAGE_GRAY8);
        for (int32_t k = 0; k < WIDTH * HEIGHT; k++)
            assert_int_equal(pixel_at(&window, (k % WIDTH << 18) + (1 << 17), (k / WIDTH << 18) + (1 << 17)), gray[k]);
    }
}

static void color_is_gray_four_times(warp_resampler_t resampler, resample_window_fn *loop)
{
    static spline_t color_spline;
    rng_t rng = {11};
    paint(5, &rng);
    window_weights_init(&weights, resampler);
    spline_begin(&spline);
    spline_begin(&color_spline);
    const image_t picture = {color, WIDTH, HEIGHT, 4 * WIDTH, IMAGE_XRGB8888};
    for (int n = 0; n < 3000; n++) {
        const int32_t side_x = (int32_t)rng_int(&rng, 0, WINDOW_SIDES - 1);
        const int32_t side_y = (int32_t)rng_int(&rng, 0, WINDOW_SIDES - 1);
        const window_t in_gray = window_of(side_x, side_y, gray, IMAGE_GRAY8);
        window_t in_color = in_gray;
        in_color.picture = picture;
        in_color.coefficients = spline_coefficients(&color_spline, &warp_kernels_scalar, &picture, 0, 0);
        const int32_t x = (int32_t)rng_int(&rng, -(1 << 20), (WIDTH << 18) + (1 << 20));
        const int32_t y = (int32_t)rng_int(&rng, -(1 << 20), (HEIGHT << 18) + (1 << 20));
        uint8_t four[4];
        loop(four, &in_color, &x, &y, 1);
        for (int c = 0; c < 4; c++)
            assert_int_equal(four[c], pixel_at(&in_gray, x, y));
    }
}

static void color_is_gray(void **state)
{
    (void)state;
    color_is_gray_four_times(WARP_MEAN_CUBIC, resample_window_xrgb_scalar);
    color_is_gray_four_times(WARP_MEAN_SPLINE, resample_spline_xrgb_scalar);
}

/* The side chosen for a footprint is the table's nearest; mean+cubic takes sqrt(w^2 - 1); large ones use levels. */
static void sides_follow_footprints(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20000; seed++) {
        rng_t rng = {seed};
        const double width = exp(rng_double(&rng, log(0.01), log(4000)));
        const int level = width > 512 ? 2 : width > 64 ? 1 : 0;
        const double reduced = width / (1 << 3 * level);
        const double cubic = reduced > 1 ? sqrt(reduced * reduced - 1) : 0;
        const window_side_t area = window_side(WARP_AREA, (uint32_t)lround(width * 65536));
        const window_side_t mean = window_side(WARP_MEAN_CUBIC, (uint32_t)lround(width * 65536));
        if (area.level != level || mean.level != level ||
            fabs(float_side(area.side) - reduced) > fmax(reduced, 0.5) / 60 ||
            fabs(float_side(mean.side) - cubic) > fmax(cubic, 0.5) / 60)
            fail_msg("seed %lu: width %f, level %d: sides %f and %f", (unsigned long)seed, width, area.level,
                     float_side(area.side), float_side(mean.side));
        const window_side_t mean_spline = window_side(WARP_MEAN_SPLINE, (uint32_t)lround(width * 65536));
        assert_int_equal(mean_spline.side, mean.side);
        assert_int_equal(mean_spline.level, mean.level);
        assert_int_equal(window_side(WARP_CUBIC, (uint32_t)lround(width * 65536)).side, 0);
        assert_int_equal(window_side(WARP_SPLINE, (uint32_t)lround(width * 65536)).side, 0);
    }
    assert_int_equal(window_side(WARP_AREA, UINT32_MAX).side, WINDOW_SIDES - 1);
    assert_int_equal(window_side(WARP_AREA, 0).side, 0);
    const window_side_t largest = window_side(WARP_AREA, WINDOW_MAX_SIDE << 16);
    assert_int_equal(largest.side, WINDOW_SIDES - 1);
    assert_int_equal(largest.level, 0);
    assert_int_equal(window_side(WARP_AREA, (WINDOW_MAX_SIDE << 16) + 1).level, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_sum_exactly_and_fit),      cmocka_unit_test(methods_keep_their_definition),
        cmocka_unit_test(constants_and_identity_are_exact), cmocka_unit_test(color_is_gray),
        cmocka_unit_test(sides_follow_footprints),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
