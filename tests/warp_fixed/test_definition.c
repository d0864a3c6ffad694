// SPDX-License-Identifier: Apache-2.0
// Whole frames of a photograph against the methods' float definitions, at the frame's own points, sides and k.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/files/png_file.h"
#include "tests/support/float_methods.h"
#include "tests/support/homography_of.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/warp.h"

enum { WIDTH = 480, HEIGHT = 270, TAPS = 24 };

/* A wall from near to far, one rolled and small in the picture, one that magnifies. */
static const double views[3][9] = {
    {0.62, 0.06, -12, -0.03, 0.55, 9, -0.0011, 0.00004, 1},
    {1.7, -0.9, 60, 0.8, 1.6, -150, 0.0003, 0.0002, 1},
    {0.42, 0.02, 80, 0.01, 0.4, 60, 0.0001, -0.0001, 1},
};

static warp_t warp;
static image_t picture;
static uint8_t shown[WIDTH * HEIGHT], defined[WIDTH * HEIGHT];
static double surface[WIDTH * HEIGHT], columns[WIDTH * HEIGHT];

static void low_pass(warp_filter_t filter, double k)
{
    double taps[PREFILTER_MAX_RADIUS + 1];
    const int radius = float_taps(taps, filter, k);
    for (int n = 0; n < WIDTH * HEIGHT; n++) {
        columns[n] = 0;
        for (int d = -radius; d <= radius; d++)
            columns[n] += taps[abs(d)] * surface[mirror_index(n / WIDTH + d, HEIGHT) * WIDTH + n % WIDTH];
    }
    for (int n = 0; n < WIDTH * HEIGHT; n++) {
        surface[n] = 0;
        for (int d = -radius; d <= radius; d++)
            surface[n] += taps[abs(d)] * columns[n / WIDTH * WIDTH + mirror_index(n % WIDTH + d, WIDTH)];
    }
}

/* What the kernel weighs: the picture, filtered, as coefficients. */
static void make_surface(const warp_method_t *method, const warp_report_t *report)
{
    for (int n = 0; n < WIDTH * HEIGHT; n++)
        surface[n] = picture.data[n];
    if (method->filter != WARP_FILTER_NONE)
        low_pass(method->filter, report->k_in_q16 / 65536.0);
    if (warp_splines(report->resampler))
        float_spline_coefficients(surface, WIDTH, HEIGHT);
}

static uint8_t float_pixel(warp_resampler_t resampler, const int32_t point_q18[2], const footprint_sides_t *sides)
{
    double weight[2][TAPS];
    int begin[2];
    for (int axis = 0; axis < 2; axis++) {
        const int size = axis == 0 ? WIDTH : HEIGHT;
        const int32_t clamped = clamp_i32(point_q18[axis], 0, size << 18);
        if (resampler == WARP_NEAREST) {
            begin[axis] = clamp_i32(clamped >> 18, 0, size - 1);
            continue;
        }
        const double point = (double)((clamped + (1 << 10)) >> 11) / PHASES;
        const uint32_t footprint_q16 = axis == 0 ? sides->width_q16 : sides->height_q16;
        const double side = float_side(window_side(resampler, footprint_q16).side);
        begin[axis] = (int)floor(point) - TAPS / 2;
        assert_true(side + 5 < TAPS);
        for (int t = 0; t < TAPS; t++)
            weight[axis][t] = float_weight(resampler, point - (begin[axis] + t) - 0.5, side);
    }
    double value = 0;
    if (resampler == WARP_NEAREST)
        value = surface[begin[1] * WIDTH + begin[0]];
    else
        for (int v = 0; v < TAPS; v++)
            for (int u = 0; u < TAPS; u++)
                if (weight[1][v] != 0 && weight[0][u] != 0) /* few are not */
                    value += weight[1][v] * weight[0][u] *
                             surface[mirror_index(begin[1] + v, HEIGHT) * WIDTH + mirror_index(begin[0] + u, WIDTH)];
    return (uint8_t)floor(fmax(0, fmin(255, value)) + 0.5);
}

/* The frame by definition; unlit pixels are 0 as in the frame. */
static void draw_defined(warp_resampler_t resampler)
{
    static footprint_blocks_t blocks;
    int log2 = 0;
    for (int32_t n = 0; n < WIDTH * HEIGHT; n++) {
        const int32_t i = n % WIDTH, j = n / WIDTH;
        if (i == 0 && j % FOOTPRINT_BAND == 0)
            log2 = footprint_block_log2(&warp.plane[0].grid, j);
        if (i == 0 && j % (1 << log2) == 0)
            footprint_blocks(&blocks, &warp.plane[0].grid, j, log2);
        int32_t point[2];
        const bool lit = grid_point(&warp.plane[0].grid, i, j, &point[0], &point[1]);
        defined[n] = lit ? float_pixel(resampler, point, &blocks.block[i >> log2]) : 0;
    }
}

/* Grey levels that the frame may be away from its definition. */
static int allowed(const warp_method_t *method)
{
    if (method->filter == WARP_FILTER_NONE && method->resampler == WARP_NEAREST)
        return 0;
    return method->filter == WARP_FILTER_NONE && (method->resampler == WARP_LINEAR || method->resampler == WARP_AREA)
               ? 2
               : 4;
}

static void check(const warp_method_t *method, const homography_t *homography, const mesh_t *mesh)
{
    static const uint8_t black[3] = {0, 0, 0};
    const image_t panel = {shown, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    const image_t by_definition = {defined, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8};
    warp_report_t report;
    warp_init(&warp, *method, false, black);
    assert_true(warp_frame(&warp, &warp_kernels_scalar, &report, homography, &panel, &picture));
    if (method->filter != WARP_FILTER_NONE && report.k_in_q16 <= 65536)
        return; /* bypassed: a method of filter none is that */
    make_surface(method, &report);
    draw_defined(report.resampler);
    int worst = 0;
    for (int n = 0; n < WIDTH * HEIGHT; n++)
        worst = abs(shown[n] - defined[n]) > worst ? abs(shown[n] - defined[n]) : worst;
    const double change_db = mesh_psnr_db(mesh, &panel) - mesh_psnr_db(mesh, &by_definition);
    printf("%-14s k %.3f: at most %d levels, %+.4f dB\n", method->name, report.k_in_q16 / 65536.0, worst, change_db);
    if (worst > allowed(method) || fabs(change_db) > 0.02)
        fail_msg("%s: %d levels, expected at most %d; %f dB, expected 0.02", method->name, worst, allowed(method),
                 change_db);
}

static void photographs_keep_the_definition(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    if (!png_file_load("tests/images/studio_480x270.png", IMAGE_GRAY8, &picture, error))
        fail_msg("%s", error);
    for (int v = 0; v < 3; v++) {
        const homography_t homography = homography_of(views[v], (homography_sizes_t){WIDTH, HEIGHT, WIDTH, HEIGHT});
        double_homography_t exact;
        mesh_t mesh;
        double_homography_from_fixed(&exact, &homography);
        assert_true(mesh_sample(&mesh, &exact, &picture, 4, error));
        assert_true(mesh_coverage(&mesh) > 0.15);
        for (int m = 0; m < WARP_METHODS; m++)
            if (warp_methods[m].resampler != WARP_LS) /* test_ls_fit.c and test_ls_warp.c do */
                check(&warp_methods[m], &homography, &mesh);
        mesh_free(&mesh);
    }
    free(picture.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(photographs_keep_the_definition)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
