// SPDX-License-Identifier: Apache-2.0
// Rows of one format -> rows of another: every count, any bytes.
#include "tests/kernels/check.h"

enum { SEEDS = 40 };

static outputs_t outputs;
static fenced_t source[2];

static const uint8_t *filled(int n, size_t size, rng_t *rng)
{
    if (source[n].begin == NULL)
        source[n] = fenced_new(4 * CHECK_MAX_COUNT);
    uint8_t *bytes = fenced_place(&source[n], size, 0);
    check_fill(bytes, size, (int)rng_int(rng, 0, CHECK_FILLS - 1), rng);
    return bytes;
}

static void check_take(const warp_kernels_t *tested, int32_t pairs, rng_t *rng)
{
    const size_t half = 2 * (size_t)pairs;
    for (int uyvy = 0; uyvy < 2; uyvy++) {
        const uint8_t *from = filled(0, 2 * half, rng);
        check_case("planes from %s, %d pairs", uyvy ? "uyvy" : "yuyv", pairs);
        outputs_begin(&outputs, 2 * half); /* chroma at the fence, luma before it */
        uint8_t *expected = outputs.expected, *found = outputs.found;
        (uyvy ? warp_kernels_scalar.planes_from_uyvy : warp_kernels_scalar.planes_from_yuyv)(expected, expected + half,
                                                                                             from, pairs);
        (uyvy ? tested->planes_from_uyvy : tested->planes_from_yuyv)(found, found + half, from, pairs);
        outputs_compare(&outputs);
    }
}

static void check_join(const warp_kernels_t *tested, int32_t pairs, rng_t *rng)
{
    const size_t half = 2 * (size_t)pairs;
    const uint8_t *luma = filled(0, half, rng), *chroma = filled(1, half, rng);
    check_case("yuyv from planes, %d pairs", pairs);
    outputs_begin(&outputs, 2 * half);
    warp_kernels_scalar.yuyv_from_planes(outputs.expected, luma, chroma, pairs);
    tested->yuyv_from_planes(outputs.found, luma, chroma, pairs);
    outputs_compare(&outputs);
    for (picture_matrix_t m = PICTURE_BT709; m <= PICTURE_BT601; m++) {
        const color_matrix_t matrix = color_matrix(m);
        check_case("xrgb from yuv, matrix %d, %d pairs", (int)m, pairs);
        outputs_begin(&outputs, 4 * half);
        warp_kernels_scalar.xrgb_from_yuv(outputs.expected, luma, chroma, &matrix, pairs);
        tested->xrgb_from_yuv(outputs.found, luma, chroma, &matrix, pairs);
        outputs_compare(&outputs);
    }
}

static void check_expand(const warp_kernels_t *tested, int32_t count, rng_t *rng)
{
    for (int bgr = 0; bgr < 2; bgr++) {
        const uint8_t *from = filled(0, 3 * (size_t)count, rng);
        check_case("xrgb from %s, %d pixels", bgr ? "bgr888" : "rgb888", count);
        outputs_begin(&outputs, 4 * (size_t)count);
        (bgr ? warp_kernels_scalar.xrgb_from_bgr888 : warp_kernels_scalar.xrgb_from_rgb888)(outputs.expected, from,
                                                                                            count);
        (bgr ? tested->xrgb_from_bgr888 : tested->xrgb_from_rgb888)(outputs.found, from, count);
        outputs_compare(&outputs);
    }
}

void check_conversions(const warp_kernels_t *tested)
{
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        rng_t rng = {seed};
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            check_take(tested, count, &rng);
            check_join(tested, count, &rng);
            check_expand(tested, count, &rng);
        }
    }
}
