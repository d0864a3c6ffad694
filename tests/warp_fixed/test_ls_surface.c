// SPDX-License-Identifier: Apache-2.0
// What a least-squares surface must show exactly: constants, polynomials, the pixels when it interpolates; each channel
// by itself; the same whatever was fitted before; no byte too many.
#include "warp_fixed/ls_fit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"

enum { LARGEST = 130, HALF_PIXEL = 1 << (GRID_FRACTION_BITS - 1) };

static const int32_t k_q16s[10] = {3277, 65536, 65537, 78643, 81920, 85197, 98304, 131072, 327680, 6553600};

static ls_t ls, other;
static uint8_t pixels[LARGEST * LARGEST * 4];

static image_t random_picture(rng_t *rng, image_format_t format)
{
    const int32_t width = (int32_t)rng_int(rng, 1, LARGEST), height = (int32_t)rng_int(rng, 1, LARGEST);
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)rng_next(rng);
    return (image_t){pixels, width, height, width * (int32_t)format, format};
}

static uint8_t gray_at(const ls_surface_t *surface, int32_t x_q18, int32_t y_q18)
{
    uint8_t pixel;
    const patch_t patch = {&pixel, 0, &x_q18, &y_q18, 1, 1};
    warp_kernels_scalar.ls_gray(&patch, surface);
    return pixel;
}

static int32_t random_point(rng_t *rng, int32_t size)
{
    return (int32_t)rng_int(rng, -(1 << GRID_FRACTION_BITS), (int64_t)(size + 1) << GRID_FRACTION_BITS);
}

static void constants_are_kept(void **state)
{
    (void)state;
    ls_init(&ls);
    for (uint64_t seed = 1; seed <= 600; seed++) {
        rng_t rng = {seed};
        const int most = seed % 3 == 0 ? LARGEST : 24;
        const int32_t width = (int32_t)rng_int(&rng, 1, most), height = (int32_t)rng_int(&rng, 1, most);
        const int32_t k_q16 = k_q16s[rng_int(&rng, 0, 9)];
        const int level = seed < 3 ? (int)(seed - 1) * 255 : (int)rng_int(&rng, 0, 255);
        memset(pixels, level, sizeof pixels);
        const image_t picture = {pixels, width, height, width, IMAGE_GRAY8};
        const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
        for (int n = 0; n < 200; n++) {
            const int32_t x = n == 0 ? 0 : random_point(&rng, width), y = n == 0 ? 0 : random_point(&rng, height);
            const int pixel = gray_at(&surface, x, y);
            if (pixel != level)
                fail_msg("seed %lu, %d x %d, k %f: %d at (%f, %f), expected %d", (unsigned long)seed, width, height,
                         k_q16 / 65536.0, pixel, ldexp(x, -18), ldexp(y, -18), level);
        }
    }
}

/* Value at pixel i, whose centre is at i + 1/2: i (i - 1) (i - 2) / 6, at most 220 for i < 13. */
static double cubic(double i)
{
    return i * (i - 1) * (i - 2) / 6;
}

/* Whatever the step: splines contain the cubics, and phases are where the surface is compared. */
static void cubics_are_kept(void **state)
{
    (void)state;
    const int32_t width = 12, height = 7;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            pixels[y * width + x] = (uint8_t)(cubic(x) + 5 * y);
    const image_t picture = {pixels, width, height, width, IMAGE_GRAY8};
    ls_init(&ls);
    for (int n = 0; n < 10; n++) {
        const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16s[n]);
        for (int32_t i = 0; i <= surface.x->phases; i++) {
            const int32_t j = i % (surface.y->phases + 1);
            const double x = (double)i * width / surface.x->phases, y = (double)j * height / surface.y->phases;
            const double expected = fmin(255, fmax(0, cubic(x - 0.5) + 5 * (y - 0.5)));
            const int pixel = gray_at(&surface, (int32_t)lround(ldexp(x, 18)), (int32_t)lround(ldexp(y, 18)));
            if (fabs(pixel - expected) > 0.55)
                fail_msg("k %f: %d at (%f, %f), expected %f", k_q16s[n] / 65536.0, pixel, x, y, expected);
        }
    }
}

static void one_and_two_pixels_are_a_line(void **state)
{
    (void)state;
    const uint8_t pair[2] = {80, 160};
    uint8_t copy[2] = {pair[0], pair[1]};
    const image_t wide = {copy, 2, 1, 2, IMAGE_GRAY8}, single = {copy, 1, 1, 1, IMAGE_GRAY8};
    ls_init(&ls);
    for (int n = 0; n < 10; n++) {
        const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &wide, k_q16s[n]);
        for (int32_t eighth = 0; eighth <= 16; eighth++)
            assert_in_range(gray_at(&surface, eighth << (GRID_FRACTION_BITS - 3), 0), 40 + 10 * eighth - 1,
                            40 + 10 * eighth + 1);
        const ls_surface_t point = ls_fit(&ls, &warp_kernels_scalar, &single, k_q16s[n]);
        assert_int_equal(gray_at(&point, 0, HALF_PIXEL), 80);
        assert_int_equal(gray_at(&point, 2 * HALF_PIXEL, 0), 80);
    }
}

static void interpolation_shows_the_pixels(void **state)
{
    (void)state;
    ls_init(&ls);
    for (uint64_t seed = 1; seed <= 60; seed++) {
        rng_t rng = {seed};
        const image_t picture = random_picture(&rng, IMAGE_GRAY8);
        const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &picture, seed % 2 == 0 ? 1 << 16 : 3000);
        for (int32_t y = 0; y < picture.height; y++)
            for (int32_t x = 0; x < picture.width; x++)
                if (gray_at(&surface, (2 * x + 1) * HALF_PIXEL, (2 * y + 1) * HALF_PIXEL) != image_row(&picture, y)[x])
                    fail_msg("seed %lu, %d x %d: pixel (%d, %d) differs", (unsigned long)seed, picture.width,
                             picture.height, x, y);
    }
}

static void channels_are_fitted_alike(void **state)
{
    (void)state;
    static uint8_t plane[LARGEST * LARGEST];
    ls_init(&ls);
    ls_init(&other);
    for (uint64_t seed = 1; seed <= 40; seed++) {
        rng_t rng = {seed};
        const image_t picture = random_picture(&rng, IMAGE_XRGB8888);
        const int32_t k_q16 = k_q16s[rng_int(&rng, 5, 9)];
        const ls_surface_t color = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
        for (int channel = 0; channel < 4; channel++) {
            const image_t gray = {plane, picture.width, picture.height, picture.width, IMAGE_GRAY8};
            for (int32_t y = 0; y < gray.height; y++)
                for (int32_t x = 0; x < gray.width; x++)
                    image_row(&gray, y)[x] = image_row(&picture, y)[4 * x + channel];
            const ls_surface_t surface = ls_fit(&other, &warp_kernels_scalar, &gray, k_q16);
            for (int n = 0; n < 300; n++) {
                const int32_t x = random_point(&rng, gray.width), y = random_point(&rng, gray.height);
                uint8_t pixel[4];
                const patch_t patch = {pixel, 0, &x, &y, 1, 1};
                warp_kernels_scalar.ls_xrgb(&patch, &color);
                assert_int_equal(pixel[channel], gray_at(&surface, x, y));
            }
        }
    }
}

/* Back and forth between steps, sizes and formats: as if each were the first. */
static void fits_do_not_depend_on_earlier_ones(void **state)
{
    (void)state;
    ls_init(&ls);
    for (uint64_t seed = 1; seed <= 60; seed++) {
        rng_t rng = {seed};
        const image_t picture = random_picture(&rng, seed % 2 == 0 ? IMAGE_GRAY8 : IMAGE_XRGB8888);
        const int32_t k_q16 = k_q16s[rng_int(&rng, 0, 9)];
        (void)ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16s[rng_int(&rng, 0, 9)]);
        const ls_surface_t kept = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
        memset(&other, (int)seed, sizeof(int32_t) * 1000000);
        ls_init(&other);
        const ls_surface_t fresh = ls_fit(&other, &warp_kernels_scalar, &picture, k_q16);
        const size_t count =
            (size_t)fresh.x->coefficients * (size_t)fresh.y->coefficients * (size_t)picture.format * sizeof(int32_t);
        assert_int_equal(kept.fraction_bits, fresh.fraction_bits);
        assert_memory_equal(kept.coefficients, fresh.coefficients, count);
    }
}

/* A column that weighs nothing bends the surface no more than 1/4096 allows; given weight back, it does. */
static void other_weights_take_effect(void **state)
{
    (void)state;
    static ls_weights_t weights;
    memset(pixels, 100, sizeof pixels);
    for (int y = 0; y < 40; y++)
        pixels[y * 60 + 30] = 200;
    const image_t picture = {pixels, 60, 40, 60, IMAGE_GRAY8};
    const int32_t x = 61 * HALF_PIXEL, y = 41 * HALF_PIXEL, k_q16 = 4 << 16;
    ls_init(&ls);
    const ls_surface_t even = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
    assert_in_range(gray_at(&even, x, y), 120, 200);
    ls_weights_init(&weights);
    weights.x[30] = 0;
    ls_set_weights(&ls, &weights);
    const ls_surface_t without = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
    assert_int_equal(gray_at(&without, x, y), 100);
    for (int i = 0; i < 60; i++)
        weights.x[i] = i == 30 ? LS_WEIGHT_ONE : LS_WEIGHT_ONE / 1000;
    ls_set_weights(&ls, &weights);
    const ls_surface_t only = ls_fit(&ls, &warp_kernels_scalar, &picture, k_q16);
    assert_in_range(gray_at(&only, x, y), 198, 200);
}

static void nothing_else_is_written(void **state)
{
    (void)state;
    rng_t rng = {3};
    const image_t picture = random_picture(&rng, IMAGE_XRGB8888);
    uint8_t out[4 * 9];
    const int32_t points[7] = {0, 1 << 18, 5 << 17, 99, INT32_MIN, INT32_MAX, 1 << 20};
    ls_init(&ls);
    const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &picture, 2 << 16);
    for (int32_t count = 0; count <= 7; count++) {
        memset(out, 0xa5, sizeof out);
        const patch_t patch = {out + 4, 0, points, points, count, 1};
        warp_kernels_scalar.ls_xrgb(&patch, &surface);
        for (int32_t i = 0; i < 4; i++)
            assert_true(out[i] == 0xa5 && out[4 + 4 * count + i] == 0xa5);
    }
}

/* Only weights far apart make coefficients so large; then they stay at the end of the range. */
static void coefficients_saturate(void **state)
{
    (void)state;
    const ls_solution_t steep = {.own = 1 << 28, .next = {-(1 << 28), 0, 1 << 28}, .shift = 28};
    int32_t rows[LS_TAPS][LS_LANES];
    for (int lane = 0; lane < LS_LANES; lane++) {
        rows[0][lane] = lane % 2 == 0 ? INT32_MAX : -INT32_MAX;
        rows[1][lane] = -rows[0][lane];
        rows[2][lane] = 5;
        rows[3][lane] = lane;
    }
    warp_kernels_scalar.ls_backward(rows[0], &steep);
    for (int lane = 0; lane < LS_LANES; lane++) {
        assert_int_equal(rows[0][lane], lane % 2 == 0 ? INT32_MAX : -INT32_MAX);
        assert_int_equal(rows[3][lane], lane);
    }
}

/* Rows as large as only weights make them: fraction bits give way, down to none. */
static void fraction_bits_give_way(void **state)
{
    (void)state;
    static ls_weights_t weights;
    const image_t line = {pixels, 41, 1, 41, IMAGE_GRAY8};
    ls_weights_init(&weights);
    for (int i = 0; i < 41; i++)
        weights.x[i] = i % 17 < 4 ? 0 : LS_WEIGHT_ONE;
    int32_t fewest = 4;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        rng_t rng = {seed};
        for (int i = 0; i < 41; i++)
            pixels[i] = (uint8_t)(rng_int(&rng, 0, 1) * 255);
        ls_init(&ls);
        assert_int_equal(ls_fit(&ls, &warp_kernels_scalar, &line, 2 << 16).fraction_bits, 4);
        ls_set_weights(&ls, &weights);
        const int32_t bits = ls_fit(&ls, &warp_kernels_scalar, &line, LS_GUARD_Q16).fraction_bits;
        fewest = bits < fewest ? bits : fewest;
    }
    assert_int_equal(fewest, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_are_kept),
        cmocka_unit_test(cubics_are_kept),
        cmocka_unit_test(one_and_two_pixels_are_a_line),
        cmocka_unit_test(interpolation_shows_the_pixels),
        cmocka_unit_test(channels_are_fitted_alike),
        cmocka_unit_test(fits_do_not_depend_on_earlier_ones),
        cmocka_unit_test(other_weights_take_effect),
        cmocka_unit_test(nothing_else_is_written),
        cmocka_unit_test(coefficients_saturate),
        cmocka_unit_test(fraction_bits_give_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
