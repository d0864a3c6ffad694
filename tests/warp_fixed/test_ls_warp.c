// SPDX-License-Identifier: Apache-2.0
// Whole frames of method ls: the surface fitted for the frame's own k, with the board's weights, at the grid's points.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/warp.h"

enum { WIDTH = 96, HEIGHT = 54 };

/* Minified and from the side, magnified, and nearly 1:1. */
static const double views[3][9] = {
    {2.2, 0.2, -60, -0.1, 2, -25, 0.004, 0.0002, 1},
    {0.42, 0.02, 16, 0.01, 0.4, 12, 0.0003, -0.0003, 1},
    {1.1, 0, -5, 0, 1.1, -2, 0, 0, 1},
};

static const uint8_t black[3] = {0, 0, 0};

static warp_t warp;
static ls_t ls;
static ls_weights_t weights;
static uint8_t pixels[WIDTH * HEIGHT * 4], shown[WIDTH * HEIGHT * 4];

static image_t noise(image_format_t format)
{
    rng_t rng = {11};
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)rng_next(&rng);
    return (image_t){pixels, WIDTH, HEIGHT, WIDTH * (int32_t)format, format};
}

static void check_frame(int view, image_format_t format, int32_t k_of(const warp_report_t *report))
{
    const homography_t homography = homography_of(views[view], (homography_sizes_t){WIDTH, HEIGHT, WIDTH, HEIGHT});
    const image_t picture = noise(format), panel = {shown, WIDTH, HEIGHT, WIDTH * (int32_t)format, format};
    warp_report_t report;
    assert_true(warp_frame(&warp, &warp_kernels_scalar, &report, &homography, &panel, &picture));
    assert_true(report.lit_pixels > 500);
    const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, &picture, k_of(&report));
    for (int32_t n = 0; n < WIDTH * HEIGHT; n++) {
        int32_t x, y;
        uint8_t expected[4] = {0};
        if (grid_point(&warp.plane[0].grid, n % WIDTH, n / WIDTH, &x, &y)) {
            const bool gray = format == IMAGE_GRAY8;
            resample_ls_fn *evaluate = gray ? warp_kernels_scalar.ls_gray : warp_kernels_scalar.ls_xrgb;
            const patch_t patch = {expected, 0, &x, &y, 1, 1};
            evaluate(&patch, &surface);
        }
        if (memcmp(shown + n * (int32_t)format, expected, format) != 0)
            fail_msg("view %d, format %d, pixel (%d, %d) differs", view, format, n % WIDTH, n / WIDTH);
    }
}

static int32_t k_in(const warp_report_t *report)
{
    return report->k_in_q16;
}

static int32_t k_all(const warp_report_t *report)
{
    assert_true(report->k_all_q16 >= report->k_in_q16);
    return report->k_all_q16;
}

static void frames_are_fitted_for_their_step(void **state)
{
    (void)state;
    for (int step_all = 0; step_all < 2; step_all++) {
        warp_init(&warp, *warp_method_from_name("ls"), step_all == 1, black);
        ls_init(&ls);
        for (int n = 0; n < 9; n++)
            check_frame(n % 3, n % 2 == 0 ? IMAGE_GRAY8 : IMAGE_XRGB8888, step_all == 1 ? k_all : k_in);
    }
}

static void frames_have_the_boards_weights(void **state)
{
    (void)state;
    warp_init(&warp, *warp_method_from_name("ls"), false, black);
    ls_init(&ls);
    check_frame(0, IMAGE_GRAY8, k_in);
    uint8_t uniform[sizeof shown];
    memcpy(uniform, shown, sizeof shown);
    ls_weights_init(&weights);
    for (int x = 0; x < WIDTH; x += 3)
        weights.x[x] = 0;
    weights.y[HEIGHT / 2] = 100;
    warp_set_ls_weights(&warp, &weights);
    ls_set_weights(&ls, &weights);
    check_frame(0, IMAGE_GRAY8, k_in);
    assert_memory_not_equal(uniform, shown, WIDTH * HEIGHT);

    warp_init(&warp, *warp_method_from_name("ls"), false, black);
    ls_init(&ls);
    check_frame(0, IMAGE_GRAY8, k_in);
    assert_memory_equal(uniform, shown, WIDTH * HEIGHT);
}

/* Weights and splines share memory: weights of a method that has none are not stored. */
static void other_methods_ignore_weights(void **state)
{
    (void)state;
    const homography_t homography = homography_of(views[0], (homography_sizes_t){WIDTH, HEIGHT, WIDTH, HEIGHT});
    const image_t picture = noise(IMAGE_GRAY8), panel = {shown, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    static uint8_t without[WIDTH * HEIGHT];
    ls_weights_init(&weights);
    weights.x[1] = 0;
    for (int m = 0; m < WARP_METHODS; m++) {
        warp_init(&warp, warp_methods[m], false, black);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
        memcpy(without, shown, sizeof without);
        warp_set_ls_weights(&warp, &weights);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
        assert_int_equal(memcmp(without, shown, sizeof without) != 0, warp_methods[m].resampler == WARP_LS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_fitted_for_their_step),
        cmocka_unit_test(frames_have_the_boards_weights),
        cmocka_unit_test(other_methods_ignore_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
