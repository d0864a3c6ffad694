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

static void check_taps(warp_filter_t filter, int32_t k_q16)
{
    double taps[PREFILTER_MAX_RADIUS + 1];
    fir_t fir;
    fir_design(&fir, filter, k_q16);
    const int radius = float_taps(taps, filter, k_q16 / 65536.0);
    assert_int_equal(fir.radius, radius);
    assert_int_equal(fir.first_shift, radius > PREFILTER_SHORT_RADIUS ? LONG_FIRST_SHIFT : 0);
    int32_t first = fir.first[0], second = fir.second[0], first_size = abs(first), second_size = abs(second);
    for (int n = 1; n <= radius; n++) {
        first += 2 * fir.first[n];
        second += 2 * fir.second[n];
        first_size += 2 * abs(fir.first[n]);
        second_size += 2 * abs(fir.second[n]);
        if (fabs(fir.second[n] - taps[n] * SECOND_SUM) > 0.52 ||
            fabs(fir.first[n] - taps[n] * (FIRST_SUM << fir.first_shift)) > 0.51)
            fail_msg("filter %d, k %f, weight %d: %d and %d, expected %f and %f", filter, k_q16 / 65536.0, n,
                     fir.first[n], fir.second[n], taps[n] * (FIRST_SUM << fir.first_shift), taps[n] * SECOND_SUM);
    }
    assert_int_equal(first, FIRST_SUM << fir.first_shift);
    assert_int_equal(second, SECOND_SUM);
    /* Neither the first pass's 16 bits nor the second's 32 can overflow, whatever the picture. */
    const int64_t largest = (int64_t)128 * first_size / (1 << fir.first_shift) + 1;
    assert_true(largest <= INT16_MAX);
    assert_true(largest * second_size <= INT32_MAX);
}

static void taps_are_the_filters(void **state)
{
    (void)state;
    const int32_t step[4] = {0, 997, 40009, 300007};
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        for (int32_t k_q16 = (1 << 16) + 1; k_q16 <= FIR_MAX_K_Q16; k_q16 += step[filter])
            check_taps(filter, k_q16);
        check_taps(filter, FIR_MAX_K_Q16);
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
    return fmax(0, fmin(255, sum));
}

/* The worst difference on a picture of noise without grey levels. */
static int worst_difference(warp_filter_t filter, int32_t k_q16, int channels, int samples)
{
    static uint8_t pixels[WIDTH * HEIGHT * 4];
    static float_fir_t fir;
    rng_t rng = {(uint64_t)(k_q16 + channels)};
    int worst = 0;
    for (int i = 0; i < WIDTH * HEIGHT * channels; i++)
        pixels[i] = (uint8_t)(rng_int(&rng, 0, 1) * 255);
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH * channels, (image_format_t)channels};
    const image_t out = prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, filter, k_q16);
    fir.radius = float_taps(fir.taps, filter, k_q16 / 65536.0);
    for (int c = 0; c < samples; c++) {
        const int at[3] = {(int)rng_int(&rng, 0, WIDTH - 1), (int)rng_int(&rng, 0, HEIGHT - 1),
                           (int)rng_int(&rng, 0, channels - 1)};
        const int expected = (int)floor(float_filtered(&fir, pixels, channels, at) + 0.5);
        const int error = abs(image_row(&out, at[1])[at[0] * channels + at[2]] - expected);
        worst = error > worst ? error : worst;
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
            const int gray = worst_difference(filter, k_q16, 1, 300), color = worst_difference(filter, k_q16, 4, 300);
            printf("filter %d, k %.2f: worst difference %d levels in gray, %d in colour\n", filter, ks[n], gray, color);
            assert_in_range(gray, 0, 3);
            assert_in_range(color, 0, 3);
        }
    }
    assert_in_range(worst_difference(WARP_FILTER_GAUSS, 60 << 16, 4, 20), 0, 1);
}

/* Black and white where the filter's weights are negative and positive: as far as any picture can overshoot. */
static void overshoot_saturates(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT];
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    for (int32_t k_q16 = 70000; k_q16 < 200000; k_q16 += 9999) {
        fir_t fir;
        fir_design(&fir, WARP_FILTER_KAISER, k_q16);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const int dx = abs(x - WIDTH / 2), dy = abs(y - HEIGHT / 2);
                const int wx = dx <= fir.radius ? fir.second[dx] : 0, wy = dy <= fir.radius ? fir.second[dy] : 0;
                pixels[y * WIDTH + x] = (int64_t)wx * wy >= 0 ? 255 : 0;
            }
        }
        prefilter_init(&prefilter);
        const image_t out = prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_KAISER, k_q16);
        assert_int_equal(image_row(&out, HEIGHT / 2)[WIDTH / 2], 255);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            pixels[i] = (uint8_t)(255 - pixels[i]);
        (void)prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_KAISER, k_q16);
        assert_int_equal(image_row(&out, HEIGHT / 2)[WIDTH / 2], 0);
    }
}

static void small_k_and_constants_pass(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT];
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    prefilter_init(&prefilter);
    assert_ptr_equal(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_GAUSS, 1 << 16).data,
                     pixels);
    assert_ptr_equal(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_BUTTER, 0).data, pixels);
    for (int level = 0; level < 256; level += 5) {
        memset(pixels, level, sizeof(pixels));
        const warp_filter_t filter = (warp_filter_t)(1 + level % 3);
        const image_t out =
            prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, filter, (1 << 16) + 1 + level * 999);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            assert_int_equal(out.data[i], level);
    }
    /* Beyond the largest k the filter stays what it is there. */
    assert_non_null(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_GAUSS, INT32_MAX).data);
    assert_int_equal(prefilter.k_q16, FIR_MAX_K_Q16);
    assert_ptr_equal(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, WARP_FILTER_NONE, 9 << 16).data,
                     pixels);
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
        fir_design(&before, filter, 65537);
        for (double k = 1.01; k < 30; k *= 1.01) {
            fir_design(&after, filter, (int32_t)(k * 65536));
            double change = 0;
            for (int32_t n = 0; n <= after.radius || n <= before.radius; n++)
                change += (n == 0 ? 1 : 2) *
                          abs((n <= after.radius ? after.second[n] : 0) - (n <= before.radius ? before.second[n] : 0));
            worst = fmax(worst, change / SECOND_SUM);
            before = after;
        }
        printf("filter %d: weights change by %.4f at most when k grows by 1 %%\n", filter, worst);
        assert_true(worst < (filter == WARP_FILTER_KAISER ? 0.1 : 0.03));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taps_are_the_filters),  cmocka_unit_test(overshoot_saturates),
        cmocka_unit_test(pictures_are_filtered), cmocka_unit_test(small_k_and_constants_pass),
        cmocka_unit_test(weights_follow_k),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
