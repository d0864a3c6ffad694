// SPDX-License-Identifier: Apache-2.0
// The prefilters: their weights and their pictures against the float definitions, and the worst overshoot.
#include "warp_fixed/prefilter.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/float_methods.h"
#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"

enum { WIDTH = 61, HEIGHT = 47 };

static prefilter_t prefilter;

static coefficients_t coefficients_of(const image_t *picture)
{
    const level_t whole = {0, 0, 0};
    prefilter_make_coefficients(&prefilter, &warp_kernels_scalar, picture, whole, only_worker);
    return prefilter_coefficients(&prefilter, picture, whole);
}

static image_t pixels_of(const image_t *picture)
{
    prefilter_make_pixels(&prefilter, &warp_kernels_scalar, picture, 0, only_worker);
    return prefilter_pixels(&prefilter, picture, 0);
}

/* The weights that make spline coefficients, in place. @return the new radius. */
static int with_splines(double taps[PREFILTER_MAX_RADIUS + 1], int radius)
{
    double before[PREFILTER_MAX_RADIUS + 1], total = 0;
    memcpy(before, taps, sizeof before);
    for (int d = 0; d <= radius + 8; d++) {
        taps[d] = 0;
        for (int n = -8; n <= 8; n++)
            if (abs(d - n) <= radius)
                taps[d] += before[abs(d - n)] * sqrt(3) * pow(2 - sqrt(3), abs(n)) * (n % 2 == 0 ? 1 : -1);
        total += (d == 0 ? 1 : 2) * taps[d];
    }
    for (int d = 0; d <= radius + 8; d++)
        taps[d] /= total;
    return radius + 8;
}

/* @return the sum of absolute weights, 1 being that of the weights. */
static double check_taps(warp_filter_t filter, int32_t k_q16, bool splines)
{
    double taps[PREFILTER_MAX_RADIUS + 1];
    fir_t fir;
    fir_design(&fir, filter, k_q16, splines);
    int radius = float_taps(taps, filter, k_q16 / 65536.0);
    if (splines)
        radius = with_splines(taps, radius);
    assert_int_equal(fir.radius, radius);
    int32_t sum = fir.weight[0], size = abs(fir.weight[0]);
    for (int n = 1; n <= radius; n++) {
        sum += 2 * fir.weight[n];
        size += 2 * abs(fir.weight[n]);
        if (fabs(fir.weight[n] - taps[n] * 16384) > 0.51)
            fail_msg("filter %d, k %f, weight %d: %d, expected %f", filter, k_q16 / 65536.0, n, fir.weight[n],
                     taps[n] * 16384);
    }
    assert_int_equal(sum, 1 << FILTER_SUM_LOG2);
    return size / 16384.0;
}

static void taps_are_the_filters(void **state)
{
    (void)state;
    const int32_t step[4] = {0, 997, 40009, 300007};
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        double largest[2] = {0, 0};
        for (int32_t k_q16 = (1 << 16) + 1; k_q16 <= FIR_MAX_K_Q16; k_q16 += step[filter])
            for (int splines = 0; splines < 2; splines++)
                largest[splines] = fmax(largest[splines], check_taps(filter, k_q16, splines == 1));
        check_taps(filter, FIR_MAX_K_Q16, true);
        printf("filter %d: absolute weights sum to %.4f at most, %.4f with splines\n", filter, largest[0], largest[1]);
        assert_true(largest[0] <= 1.701); /* what fixed.h builds on */
        assert_true(largest[1] <= 3.002);
    }
}

typedef struct {
    int radius;
    double taps[PREFILTER_MAX_RADIUS + 1];
} float_fir_t;

static double float_filtered(const float_fir_t *fir, const uint8_t *pixels, int channels, const int at[3])
{
    double sum = 0;
    for (int dy = -fir->radius; dy <= fir->radius; dy++)
        for (int dx = -fir->radius; dx <= fir->radius; dx++)
            sum +=
                fir->taps[abs(dy)] * fir->taps[abs(dx)] *
                pixels[(mirror_index(at[1] + dy, HEIGHT) * WIDTH + mirror_index(at[0] + dx, WIDTH)) * channels + at[2]];
    return sum;
}

/* The worst difference on a picture of noise without grey levels, of coefficients and of bytes. */
static double worst_difference(warp_filter_t filter, int32_t k_q16, int channels, int samples)
{
    static uint8_t pixels[WIDTH * HEIGHT * 4];
    static float_fir_t fir;
    rng_t rng = {(uint64_t)(k_q16 + channels)};
    double worst = 0;
    for (int i = 0; i < WIDTH * HEIGHT * channels; i++)
        pixels[i] = (uint8_t)(rng_int(&rng, 0, 1) * 255);
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH * channels, (image_format_t)channels};
    fir.radius = float_taps(fir.taps, filter, k_q16 / 65536.0);
    for (int c = 0; c < samples; c++) {
        const int at[3] = {(int)rng_int(&rng, 0, WIDTH - 1), (int)rng_int(&rng, 0, HEIGHT - 1),
                           (int)rng_int(&rng, 0, channels - 1)};
        const int32_t place = (at[1] * WIDTH + at[0]) * channels + at[2];
        const double expected = float_filtered(&fir, pixels, channels, at);
        assert_true(prefilter_begin(&prefilter, filter, k_q16, false));
        if (c % 2 == 0) {
            const coefficients_t out = coefficients_of(&picture);
            worst = fmax(worst, fabs(COEFFICIENT_MIDDLE + out.data[place] / 16.0 - expected));
        } else {
            const image_t out = pixels_of(&picture);
            worst = fmax(worst, fabs(out.data[place] - fmax(0, fmin(255, expected))) - 0.5);
        }
    }
    return worst;
}

static void pictures_are_filtered(void **state)
{
    (void)state;
    const double ks[5] = {2.9, 1.05, 4.2, 1.9, 2.9}; /* up, down, and the same for the next filter */
    prefilter_init(&prefilter);
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        for (int n = 0; n < 5; n++) {
            const int32_t k_q16 = (int32_t)lround(ks[n] * 65536);
            const double gray = worst_difference(filter, k_q16, 1, 40), color = worst_difference(filter, k_q16, 4, 40);
            printf("filter %d, k %.2f: worst difference %.3f levels in gray, %.3f in colour\n", filter, ks[n], gray,
                   color);
            assert_true(gray < 0.3 && color < 0.3);
        }
    }
    assert_true(worst_difference(WARP_FILTER_GAUSS, 60 << 16, 4, 4) < 0.5);
}

/* Black and white where the filter's weights are negative and positive: as far as any picture can overshoot. */
static void overshoot_saturates(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT];
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    for (int32_t k_q16 = 70000; k_q16 < 200000; k_q16 += 9999) {
        fir_t fir;
        fir_design(&fir, WARP_FILTER_KAISER, k_q16, false);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const int dx = abs(x - WIDTH / 2), dy = abs(y - HEIGHT / 2);
                const int wx = dx <= fir.radius ? fir.weight[dx] : 0, wy = dy <= fir.radius ? fir.weight[dy] : 0;
                pixels[y * WIDTH + x] = (int64_t)wx * wy >= 0 ? 255 : 0;
            }
        }
        prefilter_init(&prefilter);
        assert_true(prefilter_begin(&prefilter, WARP_FILTER_KAISER, k_q16, false));
        const image_t out = pixels_of(&picture);
        assert_int_equal(image_row(&out, HEIGHT / 2)[WIDTH / 2], 255);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            pixels[i] = (uint8_t)(255 - pixels[i]);
        (void)pixels_of(&picture);
        assert_int_equal(image_row(&out, HEIGHT / 2)[WIDTH / 2], 0);
    }
}

static void small_k_and_constants_pass(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT];
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    prefilter_init(&prefilter);
    assert_false(prefilter_begin(&prefilter, WARP_FILTER_GAUSS, 1 << 16, false));
    assert_false(prefilter_begin(&prefilter, WARP_FILTER_BUTTER, 0, false));
    assert_false(prefilter_begin(&prefilter, WARP_FILTER_NONE, 9 << 16, false));
    assert_true(prefilter_begin(&prefilter, WARP_FILTER_NONE, 9 << 16, true));
    assert_true(prefilter_begin(&prefilter, WARP_FILTER_GAUSS, 1 << 15, true));
    for (int level = 0; level < 256; level += 5) {
        memset(pixels, level, sizeof(pixels));
        const int32_t k_q16 = (1 << 16) + 1 + level * 999;
        assert_true(prefilter_begin(&prefilter, (warp_filter_t)(1 + level % 3), k_q16, level % 2 == 0));
        const coefficients_t out = coefficients_of(&picture);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            assert_int_equal(out.data[i], (level - COEFFICIENT_MIDDLE) * 16);
        const image_t bytes = pixels_of(&picture);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            assert_int_equal(bytes.data[i], level);
    }
    /* Beyond the largest k the filter stays what it is there. */
    assert_true(prefilter_begin(&prefilter, WARP_FILTER_GAUSS, INT32_MAX, false));
    assert_int_equal(prefilter.design[0].kind.k_q16, FIR_MAX_K_Q16);
}

/*
 * A walking viewer changes k by a percent or so per frame: the weights follow in proportion. Kaiser's length alone
 * grows by whole pixels, ceil(6 k).
 */
static void weights_follow_k(void **state)
{
    (void)state;
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        double worst = 0;
        static fir_t before, after;
        fir_design(&before, filter, 65537, false);
        for (double k = 1.01; k < 30; k *= 1.01) {
            fir_design(&after, filter, (int32_t)(k * 65536), false);
            double change = 0;
            for (int32_t n = 0; n <= after.radius || n <= before.radius; n++)
                change += (n == 0 ? 1 : 2) *
                          abs((n <= after.radius ? after.weight[n] : 0) - (n <= before.radius ? before.weight[n] : 0));
            worst = fmax(worst, change / (1 << FILTER_SUM_LOG2));
            before = after;
        }
        printf("filter %d: weights change by %.4f at most when k grows by 1 %%\n", filter, worst);
        assert_true(worst < (filter == WARP_FILTER_KAISER ? 0.1 : 0.03));
    }
}

/* A picture that varies along one axis is filtered by that axis' step alone, whatever the other one. */
static void test_steps_of_both_axes_of_chroma(void **state)
{
    (void)state;
    static uint8_t bytes[WIDTH * HEIGHT * 2], expected[WIDTH * HEIGHT * 2];
    const image_t picture = {bytes, WIDTH, HEIGHT, WIDTH * 2, IMAGE_UV88};
    const chroma_step_t steps[] = {{3 << 16, 5 << 15}, {1 << 16, 4 << 16}, {70000, 1 << 16}, {2 << 16, 2 << 16}};
    for (int n = 0; n < 24; n++) {
        const warp_filter_t filter = (warp_filter_t)(1 + n % 3);
        const chroma_step_t step = steps[n / 3 % 4];
        const bool along_y = n / 12 != 0;
        const int32_t k_q16 = along_y ? step.y_q16 : step.x_q16;
        rng_t rng = {(uint64_t)n + 1};
        for (int32_t k = 0; k < (along_y ? HEIGHT : WIDTH) * 2; k++) {
            const uint8_t value = (uint8_t)rng_int(&rng, 0, 255);
            for (int32_t i = 0; i < (along_y ? WIDTH : HEIGHT); i++)
                bytes[along_y ? (k / 2 * WIDTH + i) * 2 + k % 2 : i * WIDTH * 2 + k] = value;
        }
        prefilter_init(&prefilter);
        memcpy(expected, bytes, sizeof bytes);
        if (prefilter_begin(&prefilter, filter, k_q16, false))
            memcpy(expected, pixels_of(&picture).data, sizeof expected);
        assert_true(prefilter_begin_chroma(&prefilter, filter, step, false));
        prefilter_make_pixels(&prefilter, &warp_kernels_scalar, &picture, 1, only_worker);
        assert_memory_equal(prefilter_pixels(&prefilter, &picture, 1).data, expected, sizeof expected);
    }
    assert_false(prefilter_begin_chroma(&prefilter, WARP_FILTER_GAUSS, (chroma_step_t){1 << 16, 1 << 15}, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taps_are_the_filters),  cmocka_unit_test(overshoot_saturates),
        cmocka_unit_test(pictures_are_filtered), cmocka_unit_test(small_k_and_constants_pass),
        cmocka_unit_test(weights_follow_k),      cmocka_unit_test(test_steps_of_both_axes_of_chroma),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
