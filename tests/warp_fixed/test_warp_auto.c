// SPDX-License-Identifier: Apache-2.0
// Tests of the method `auto`: which one it takes for a step k, and that the frame is that one's.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/rng.h"
#include "warp_fixed/warp.h"

enum { WIDTH = 60, HEIGHT = 44 };

static warp_t warp, other;
static uint8_t pixels[WIDTH * HEIGHT], shown[WIDTH * HEIGHT], expected[WIDTH * HEIGHT];

static image_t image(uint8_t *bytes)
{
    return (image_t){bytes, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
}

static void auto_chooses_by_k_and_stays(void **state)
{
    (void)state;
    assert_int_equal(warp_resampler_for_step(WARP_AUTO, 65536), WARP_MEAN_SPLINE);
    assert_int_equal(warp_resampler_for_step(WARP_AUTO, 65537), WARP_MEAN_CUBIC);
    assert_int_equal(warp_resampler_for_step(WARP_MEAN_SPLINE, 73728), WARP_MEAN_SPLINE);
    assert_int_equal(warp_resampler_for_step(WARP_MEAN_SPLINE, 73729), WARP_MEAN_CUBIC);
    assert_int_equal(warp_resampler_for_step(WARP_MEAN_CUBIC, 65537), WARP_MEAN_CUBIC);
    assert_int_equal(warp_resampler_for_step(WARP_MEAN_SPLINE, 0), WARP_MEAN_SPLINE);
    assert_int_equal(warp_resampler_for_step(WARP_AUTO, 0), WARP_MEAN_CUBIC);
}

/* A viewer walks away and back: each frame is, byte for byte, that of the method which the report names. */
static void auto_shows_what_it_names(void **state)
{
    (void)state;
    static const uint8_t border[3] = {10, 20, 30};
    static const double zooms[] = {0.7, 0.95, 1.05, 1.12, 1.2, 1.1, 1.02, 0.99, 1.1};
    static const char *const named[] = {"mean+spline", "mean+spline", "mean+spline", "mean+spline", "mean+cubic",
                                        "mean+cubic",  "mean+cubic",  "mean+spline", "mean+spline"};
    const int32_t size[2] = {WIDTH, HEIGHT};
    const image_t picture = image(pixels), panel = image(shown), of_other = image(expected);
    rng_t rng = {3};
    for (int32_t k = 0; k < WIDTH * HEIGHT; k++)
        pixels[k] = (uint8_t)rng_next(&rng);
    memset(warp.table, 0xA5, sizeof warp.table); /* of other methods */
    warp_init(&warp, *warp_method_from_name("auto"), false, border);
    for (size_t n = 0; n < sizeof zooms / sizeof *zooms; n++) {
        const int64_t scale = (int64_t)(zooms[n] * 1099511627776.0), one = (int64_t)1 << 40;
        const int64_t rows[3][3] = {{scale, 0, one * 3}, {0, scale, one * 2}, {0, 0, one}};
        homography_t h;
        homography_from_indices(&h, rows, size, size);
        const warp_method_t *method = warp_method_from_name(named[n]);
        warp_report_t report;
        assert_true(warp_frame(&warp, &warp_kernels_scalar, &report, &h, &panel, &picture));
        assert_int_equal(report.resampler, method->resampler);
        warp_init(&other, *method, false, border);
        assert_true(warp_frame(&other, &warp_kernels_scalar, NULL, &h, &of_other, &picture));
        assert_memory_equal(shown, expected, sizeof shown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(auto_chooses_by_k_and_stays),
        cmocka_unit_test(auto_shows_what_it_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
