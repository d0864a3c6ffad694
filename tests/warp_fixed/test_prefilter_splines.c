// SPDX-License-Identifier: Apache-2.0
// Spline coefficients against the spline's definition: they bring back the pixels, whatever the picture.
#include "warp_fixed/prefilter.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"

enum { MAX_WIDTH = 90, MAX_HEIGHT = 70 };

static prefilter_t prefilter;

static coefficients_t coefficients_of(const image_t *picture, level_t level)
{
    prefilter_make_coefficients(&prefilter, &warp_kernels_scalar, picture, level, only_worker);
    return prefilter_coefficients(&prefilter, picture, level);
}
static uint8_t pixels[MAX_WIDTH * MAX_HEIGHT * 4];

static image_t picture_of(int32_t width, int32_t height, image_format_t format)
{
    return (image_t){pixels, width, height, width * (int32_t)format, format};
}

static double coefficient(const coefficients_t *c, int32_t x, int32_t y, int32_t channel)
{
    const int32_t at = mirror_index(y, c->height) * c->width + mirror_index(x, c->width);
    return COEFFICIENT_MIDDLE + c->data[at * c->channels + channel] / 16.0;
}

/* The spline at a pixel's centre: (1, 4, 1) / 6 along both axes. */
static double value_at(const coefficients_t *c, int32_t x, int32_t y, int32_t channel)
{
    double sum = 0;
    for (int32_t v = -1; v <= 1; v++)
        for (int32_t u = -1; u <= 1; u++)
            sum += (u == 0 ? 4 : 1) * (v == 0 ? 4 : 1) * coefficient(c, x + u, y + v, channel);
    return sum / 36;
}

/* Off by 0.032 from the rounding of coefficients, 0.026 for each axis from that of the filter's weights. */
static void the_spline_goes_through_the_pixels(void **state)
{
    (void)state;
    double worst = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        rng_t rng = {seed};
        const int32_t width = (int32_t)rng_int(&rng, 1, seed % 5 == 0 ? 3 : MAX_WIDTH);
        const int32_t height = (int32_t)rng_int(&rng, 1, seed % 7 == 0 ? 3 : MAX_HEIGHT);
        const image_t picture = picture_of(width, height, seed % 2 == 0 ? IMAGE_GRAY8 : IMAGE_XRGB8888);
        const int32_t channels = (int32_t)picture.format;
        for (int32_t k = 0; k < width * height * channels; k++)
            pixels[k] = (uint8_t)(seed % 3 == 0   ? rng_int(&rng, 0, 1) * 255
                                  : seed % 3 == 1 ? rng_int(&rng, 0, 255)
                                                  : (k / channels + k / channels / width) % 2 * 255);
        (void)prefilter_begin(&prefilter, WARP_FILTER_NONE, 0, true);
        const coefficients_t made = coefficients_of(&picture, (level_t){0, 0, 0});
        for (int32_t k = 0; k < width * height * channels; k++) {
            const int32_t x = k / channels % width, y = k / channels / width, channel = k % channels;
            const double error = fabs(value_at(&made, x, y, channel) - pixels[k]);
            worst = error > worst ? error : worst;
            if (error > 0.09)
                fail_msg("seed %lu, %d x %d, pixel (%d, %d): %f, expected %d", (unsigned long)seed, width, height, x, y,
                         value_at(&made, x, y, channel), pixels[k]);
        }
    }
    printf("worst distance from a pixel: %.3f levels\n", worst);
}

/* The picture that drives a coefficient farthest out: the signs of the filter's weights. It just fits. */
static void the_worst_picture_fits(void **state)
{
    (void)state;
    const image_t picture = picture_of(41, 41, IMAGE_GRAY8);
    for (int sign = 0; sign < 2; sign++) {
        for (int32_t k = 0; k < 41 * 41; k++)
            pixels[k] = (k % 41 + k / 41) % 2 == sign ? 255 : 0;
        (void)prefilter_begin(&prefilter, WARP_FILTER_NONE, 0, true);
        const coefficients_t made = coefficients_of(&picture, (level_t){0, 0, 0});
        const double expected = 127.5 + (sign == 0 ? 9 : -9) * 127.5;
        assert_true(fabs(coefficient(&made, 20, 20, 0) - expected) < 0.2);
    }
}

/* Each level has a place of its own: all of them, made one after the other, are there at the end. */
static void levels_have_their_own(void **state)
{
    (void)state;
    (void)prefilter_begin(&prefilter, WARP_FILTER_NONE, 0, true);
    for (int n = 0; n < LEVELS * LEVELS; n++) {
        const level_t level = {n / LEVELS, n % LEVELS, 0};
        const image_t picture = picture_of(MAX_WIDTH >> 3 * level.x, MAX_HEIGHT >> 3 * level.y, IMAGE_GRAY8);
        memset(pixels, 50 + 20 * n, sizeof pixels);
        (void)coefficients_of(&picture, level);
    }
    for (int n = 0; n < LEVELS * LEVELS; n++) {
        const level_t level = {n / LEVELS, n % LEVELS, 0};
        const image_t picture = picture_of(MAX_WIDTH >> 3 * level.x, MAX_HEIGHT >> 3 * level.y, IMAGE_GRAY8);
        const coefficients_t made = prefilter_coefficients(&prefilter, &picture, level);
        for (int32_t k = 0; k < made.width * made.height; k++)
            if (made.data[k] != (50 + 20 * n - COEFFICIENT_MIDDLE) * 16)
                fail_msg("level %d, %d: %d at %d", level.x, level.y, made.data[k], k);
    }
}

int main(void)
{
    prefilter_init(&prefilter);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spline_goes_through_the_pixels),
        cmocka_unit_test(the_worst_picture_fits),
        cmocka_unit_test(levels_have_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
