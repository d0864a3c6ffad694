// SPDX-License-Identifier: Apache-2.0
// The least-squares loops, with the rotations and solutions of real axes.
#include <string.h>

#include "tests/kernels/check.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/ls_axis.h"

enum { STRIP = LS_TAPS * LS_LANES, MAX_DATA = 255 << 17, MAX_STATE = 1 << 29 };

static ls_axis_t axes[2];
static outputs_t outputs;

/* Both tables begin from the same strip, which is written in place. */
static void fill_strip(int32_t limit, rng_t *rng)
{
    outputs_begin(&outputs, STRIP * sizeof(int32_t));
    const int extreme = (int)rng_int(rng, 0, 3) == 0;
    int32_t *strip = outputs.expected;
    for (int i = 0; i < STRIP; i++)
        strip[i] = extreme ? (rng_int(rng, 0, 1) ? limit : -limit) : (int32_t)rng_int(rng, -limit, limit);
    memcpy(outputs.found, outputs.expected, STRIP * sizeof(int32_t));
}

static void check_axis(const warp_kernels_t *tested, const ls_axis_t *axis, rng_t *rng)
{
    int32_t data[LS_LANES];
    for (int32_t i = 0; i < axis->equations; i++) {
        check_case("ls_forward, %d equations, number %d", axis->equations, i);
        fill_strip(MAX_STATE, rng);
        for (int lane = 0; lane < LS_LANES; lane++)
            data[lane] = (int32_t)rng_int(rng, -1, 1) * (int32_t)rng_int(rng, 0, MAX_DATA);
        warp_kernels_scalar.ls_forward(outputs.expected, data, &axis->equation[i]);
        tested->ls_forward(outputs.found, data, &axis->equation[i]);
        outputs_compare(&outputs);
    }
    for (int32_t j = 0; j < axis->coefficients; j++) {
        check_case("ls_backward, %d coefficients, number %d", axis->coefficients, j);
        fill_strip(rng_int(rng, 0, 1) ? INT32_MAX : MAX_STATE, rng);
        warp_kernels_scalar.ls_backward(outputs.expected, &axis->solution[j]);
        tested->ls_backward(outputs.found, &axis->solution[j]);
        outputs_compare(&outputs);
    }
}

static ls_pixels_fn *pixels_loop(const warp_kernels_t *kernels, int32_t channels)
{
    return channels == 1   ? kernels->ls_pixels_gray
           : channels == 2 ? kernels->ls_pixels_chroma
                           : kernels->ls_pixels_xrgb;
}

static void check_pixels(const warp_kernels_t *tested, rng_t *rng)
{
    enum { MAX_WIDTH = 9 };
    static fenced_t memory[LS_LANES];
    const uint8_t *rows[LS_LANES];
    const int32_t width = (int32_t)rng_int(rng, 1, MAX_WIDTH), channels = 1 << rng_int(rng, 0, 2);
    for (int i = 0; i < LS_LANES; i++) {
        if (memory[i].begin == NULL)
            memory[i] = fenced_new(MAX_WIDTH * 4);
        uint8_t *row = fenced_place(&memory[i], (size_t)(width * channels), (int)rng_int(rng, 0, 1));
        check_fill(row, (size_t)(width * channels), (int)rng_int(rng, 0, CHECK_FILLS - 1), rng);
        rows[i] = row;
    }
    for (int32_t x = 0; x < width; x++) {
        check_case("ls_pixels of %d channels, %d of %d", channels, x, width);
        outputs_begin(&outputs, LS_LANES * sizeof(int32_t));
        pixels_loop(&warp_kernels_scalar, channels)(outputs.expected, rows, x);
        pixels_loop(tested, channels)(outputs.found, rows, x);
        outputs_compare(&outputs);
    }
}

static void check_scale(const warp_kernels_t *tested, rng_t *rng)
{
    int32_t from[LS_LANES], shift[LS_LANES];
    for (int lane = 0; lane < LS_LANES; lane++) {
        const int bits = (int)rng_int(rng, 0, 31);
        const int32_t limit = (int32_t)(((int64_t)1 << bits) - 1);
        from[lane] = rng_int(rng, 0, 3) ? (int32_t)rng_int(rng, -limit, limit) : limit;
        shift[lane] = (int32_t)rng_int(rng, -31, 31);
    }
    check_case("ls_scale, rng %#llx", (unsigned long long)rng->state);
    outputs_begin(&outputs, LS_LANES * sizeof(int32_t));
    warp_kernels_scalar.ls_scale(outputs.expected, from, shift);
    tested->ls_scale(outputs.found, from, shift);
    outputs_compare(&outputs);
}

/* As a grid makes them, in and around an axis of so many pixels. */
static void fill_points(int32_t *point_q18, int32_t size, rng_t *rng)
{
    const int32_t one = 1 << 18, at = (int32_t)rng_int(rng, -3 * one, (size + 3) * one);
    const int32_t by_column = (int32_t)rng_int(rng, -one, one), by_row = (int32_t)rng_int(rng, -one, one);
    for (int32_t r = 0; r < PATCH_MAX_HEIGHT; r++)
        for (int32_t k = 0; k < PATCH_MAX_WIDTH; k++)
            point_q18[r * PATCH_MAX_WIDTH + k] = at + k * by_column + r * by_row;
}

static resample_ls_fn *surface_loop(const warp_kernels_t *kernels, image_format_t format)
{
    return format == IMAGE_GRAY8 ? kernels->ls_gray : format == IMAGE_UV88 ? kernels->ls_chroma : kernels->ls_xrgb;
}

static void check_surface(const warp_kernels_t *tested, image_format_t format, rng_t *rng)
{
    static fenced_t memory;
    int32_t x[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
    const size_t count = (size_t)axes[0].coefficients * (size_t)axes[1].coefficients * format;
    if (memory.begin == NULL)
        memory = fenced_new(200 * 200 * 4 * sizeof(int32_t));
    int32_t *coefficients = fenced_place(&memory, count * sizeof *coefficients, (int)rng_int(rng, 0, 1));
    for (size_t i = 0; i < count; i++)
        coefficients[i] = (int32_t)rng_int(rng, -300 * 16, 600 * 16);
    const ls_surface_t surface = {&axes[0], &axes[1], coefficients, (int32_t)rng_int(rng, 0, 4)};
    for (int32_t width = 0; width <= PATCH_MAX_WIDTH; width++) {
        const int32_t height = (int32_t)rng_int(rng, 1, 3);
        fill_points(x, axes[0].knots.size, rng);
        fill_points(y, axes[1].knots.size, rng);
        check_case("ls surface of %d x %d coefficients of %d channels, patch %d x %d", axes[0].coefficients,
                   axes[1].coefficients, (int)format, width, height);
        outputs_begin(&outputs, (size_t)(width * height) * format);
        const patch_t expected = {outputs.expected, width * (ptrdiff_t)format, x, y, width, height};
        const patch_t found = {outputs.found, width * (ptrdiff_t)format, x, y, width, height};
        surface_loop(&warp_kernels_scalar, format)(&expected, &surface);
        surface_loop(tested, format)(&found, &surface);
        outputs_compare(&outputs);
    }
}

void check_ls(const warp_kernels_t *tested)
{
    static uint16_t weight[LS_MAX_SIZE];
    for (uint64_t seed = 1; seed <= 90; seed++) {
        rng_t rng = {seed};
        const int uniform = (int)rng_int(&rng, 0, 1);
        for (int i = 0; i < LS_MAX_SIZE; i++)
            weight[i] = uniform ? LS_WEIGHT_ONE : (uint16_t)rng_int(&rng, 0, LS_WEIGHT_ONE);
        for (int axis = 0; axis < 2; axis++) {
            ls_axis_init(&axes[axis]);
            ls_axis_update(&axes[axis], (int32_t)rng_int(&rng, 1, 90), (int32_t)rng_int(&rng, 1 << 15, 5 << 16),
                           weight);
            check_axis(tested, &axes[axis], &rng);
        }
        for (int n = 0; n < 20; n++) {
            check_pixels(tested, &rng);
            check_scale(tested, &rng);
        }
        check_surface(tested, (image_format_t)(1 << seed % 3), &rng);
    }
}
