// SPDX-License-Identifier: Apache-2.0
// The Gaussian prefilter: its taps against exp(), its pictures against the float filter.
#include "warp_fixed/prefilter.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"

enum { WIDTH = 61, HEIGHT = 47 };

static prefilter_t prefilter;

/* exp(-n^2 / (2 sigma^2)) normalised, sigma = k sqrt(ln 2) / pi, cut at 4 sigma. @return the radius. */
static int float_taps(double taps[PREFILTER_MAX_RADIUS + 1], double k)
{
    const double sigma = k * sqrt(log(2)) / M_PI;
    const int radius = (int)floor(4 * sigma);
    double total = 0;
    for (int n = 0; n <= radius; n++) {
        taps[n] = exp(-n * n / (2 * sigma * sigma));
        total += n == 0 ? taps[n] : 2 * taps[n];
    }
    for (int n = 0; n <= radius; n++)
        taps[n] /= total;
    return radius;
}

static void taps_are_the_gaussian(void **state)
{
    (void)state;
    for (int32_t k_q16 = (1 << 16) + 1; k_q16 <= PREFILTER_MAX_K_Q16; k_q16 += 997) {
        double taps[PREFILTER_MAX_RADIUS + 1];
        fir_t fir;
        prefilter_gauss(&fir, k_q16);
        const int radius = float_taps(taps, k_q16 / 65536.0);
        assert_int_equal(fir.radius, radius);
        int32_t first = fir.first[0], second = fir.second[0];
        for (int n = 1; n <= radius; n++) {
            first += 2 * fir.first[n];
            second += 2 * fir.second[n];
            assert_true(fabs(fir.second[n] - taps[n] * SECOND_SUM) < 0.51);
            assert_true(fabs(fir.first[n] - taps[n] * (FIRST_SUM << fir.first_shift)) < 0.51);
        }
        assert_int_equal(first, FIRST_SUM << fir.first_shift);
        assert_int_equal(second, SECOND_SUM);
        assert_true(fir.first[0] >= 0 && fir.second[0] >= 0);
        assert_int_equal(fir.first_shift, radius > PREFILTER_SHORT_RADIUS ? LONG_FIRST_SHIFT : 0);
    }
}

static double float_filtered(const uint8_t *pixels, int channels, int x, int y, int channel, double k)
{
    double taps[PREFILTER_MAX_RADIUS + 1], sum = 0;
    const int radius = float_taps(taps, k);
    for (int dy = -radius; dy <= radius; dy++)
        for (int dx = -radius; dx <= radius; dx++)
            sum += taps[abs(dy)] * taps[abs(dx)] *
                   pixels[(mirror_index(y + dy, HEIGHT) * WIDTH + mirror_index(x + dx, WIDTH)) * channels + channel];
    return sum;
}

static void pictures_are_filtered(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT * 4];
    const double ks[5] = {1.05, 1.9, 2.9, 4.2, 60};
    prefilter_init(&prefilter);
    for (int format = 1; format <= 4; format += 3) {
        for (int n = 0; n < 5; n++) {
            rng_t rng = {(uint64_t)(100 * format + n)};
            int worst = 0;
            for (int i = 0; i < WIDTH * HEIGHT * format; i++)
                pixels[i] = (uint8_t)(rng_int(&rng, 0, 1) * 255);
            const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH * format, (image_format_t)format};
            const int32_t k_q16 = (int32_t)lround(ks[n] * 65536);
            const image_t out = prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, k_q16);
            for (int c = 0; c < 400; c++) {
                const int x = (int)rng_int(&rng, 0, WIDTH - 1), y = (int)rng_int(&rng, 0, HEIGHT - 1);
                const int channel = (int)rng_int(&rng, 0, format - 1);
                const int expected = (int)floor(float_filtered(pixels, format, x, y, channel, k_q16 / 65536.0) + 0.5);
                const int error = abs(image_row(&out, y)[x * format + channel] - expected);
                worst = error > worst ? error : worst;
            }
            printf("k %.2f, %d channels: worst difference %d levels\n", ks[n], format, worst);
            assert_in_range(worst, 0, 3);
        }
    }
}

static void small_k_and_constants_pass(void **state)
{
    (void)state;
    static uint8_t pixels[WIDTH * HEIGHT];
    const image_t picture = {pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    prefilter_init(&prefilter);
    assert_ptr_equal(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, 1 << 16).data, pixels);
    assert_ptr_equal(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, 0).data, pixels);
    for (int level = 0; level < 256; level += 5) {
        memset(pixels, level, sizeof(pixels));
        const image_t out = prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, (1 << 16) + level * 9999);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            assert_int_equal(out.data[i], level);
    }
    /* Beyond the largest k the filter stays what it is there. */
    assert_non_null(prefilter_picture(&prefilter, &warp_kernels_scalar, &picture, INT32_MAX).data);
    assert_int_equal(prefilter.k_q16, PREFILTER_MAX_K_Q16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taps_are_the_gaussian),
        cmocka_unit_test(pictures_are_filtered),
        cmocka_unit_test(small_k_and_constants_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
