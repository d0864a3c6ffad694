// SPDX-License-Identifier: Apache-2.0
// The resamplers: every side of every table, pictures that end at a fence, points in, at the edge of and beyond them.
#include <string.h>

#include "tests/kernels/check.h"
#include "warp_fixed/window_place.h"

enum { MAX_PICTURE = 200, SOURCE_BYTES = MAX_PICTURE * MAX_PICTURE * 4 * (int)sizeof(int16_t) };

static outputs_t outputs;
static fenced_t source, points[2];
static window_weights_t weights;

static void take_memory(void)
{
    if (source.begin != NULL)
        return;
    source = fenced_new(SOURCE_BYTES);
    for (int axis = 0; axis < 2; axis++)
        points[axis] = fenced_new(CHECK_MAX_COUNT * sizeof(int32_t));
}

/* A picture without a byte after its last row's last pixel. */
static image_t fenced_picture(int32_t width, int32_t height, image_format_t format, rng_t *rng)
{
    const int32_t stride = width * (int32_t)format + (int32_t)rng_int(rng, 0, 5);
    const size_t size = (size_t)(stride * (height - 1) + width * (int32_t)format);
    image_t picture = {fenced_place(&source, size, (int)rng_int(rng, 0, 1)), width, height, stride, format};
    check_fill(picture.data, size, (int)rng_int(rng, 0, CHECK_FILLS - 1), rng);
    return picture;
}

/* Points of one axis whose windows end at or near the last texel: there, reading one too many meets the fence. */
static const int32_t *fill_far_points(int axis, int32_t count, int32_t size, const window_axis_t *weighed, rng_t *rng)
{
    const int32_t one = 1 << GRID_FRACTION_BITS;
    int32_t *point = fenced_place(&points[axis], (size_t)count * sizeof *point, 0);
    const int64_t base = (int64_t)size * one - (int64_t)weighed->taps * one / 2 + rng_int(rng, -one, one / 2);
    for (int32_t k = 0; k < count; k++)
        point[k] = (int32_t)(base + rng_int(rng, -one / 4, one / 4));
    return point;
}

/* Points of one axis, `size` pixels long: along a line as in a frame, all over it, or anything. */
static const int32_t *fill_points(int axis, int32_t count, int32_t size, rng_t *rng)
{
    int32_t *point = fenced_place(&points[axis], (size_t)count * sizeof *point, 0);
    const int kind = (int)rng_int(rng, 0, 3);
    const int64_t whole = (int64_t)size << GRID_FRACTION_BITS, margin = whole / 8 + (1 << GRID_FRACTION_BITS);
    int64_t at = rng_int(rng, kind == 0 ? whole / 4 : -margin, kind == 0 ? whole / 2 : whole + margin);
    const int64_t step = kind < 2 ? rng_int(rng, -(1 << 18), 1 << 18) : 0;
    for (int32_t k = 0; k < count; k++) {
        if (kind == 2)
            at = rng_int(rng, -margin, whole + margin);
        else if (kind == 3)
            at = rng_int(rng, 0, 1) ? (int32_t)rng_next(rng) : rng_int(rng, 0, 1) * whole;
        point[k] = (int32_t)at;
        at += step;
    }
    return point;
}

void check_nearest(const warp_kernels_t *tested)
{
    take_memory();
    for (uint64_t seed = 1; seed <= 40; seed++) {
        rng_t rng = {seed};
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            const image_format_t format = rng_int(&rng, 0, 1) ? IMAGE_GRAY8 : IMAGE_XRGB8888;
            const int32_t width = (int32_t)rng_int(&rng, 1, 40), height = (int32_t)rng_int(&rng, 1, 40);
            const image_t picture = fenced_picture(width, height, format, &rng);
            const int32_t *x = fill_points(0, count, width, &rng), *y = fill_points(1, count, height, &rng);
            check_case("nearest, seed %d, %d x %d of %d channels, count %d", (int)seed, width, height, (int)format,
                       count);
            outputs_begin(&outputs, (size_t)count * format);
            const int gray = format == IMAGE_GRAY8;
            (gray ? warp_kernels_scalar.nearest_gray : warp_kernels_scalar.nearest_xrgb)(outputs.expected, &picture, x,
                                                                                         y, count);
            (gray ? tested->nearest_gray : tested->nearest_xrgb)(outputs.found, &picture, x, y, count);
            outputs_compare(&outputs);
        }
    }
}

/* Make the first point's value the largest (or smallest): 255 under weights of one sign, 0 under the others. */
static void fill_worst(const window_t *window, int32_t x_q18, int32_t y_q18, int smallest)
{
    const image_t *picture = &window->picture;
    const window_place_t x = window_place(&window->x, x_q18, window->width, window->level_x);
    const window_place_t y = window_place(&window->y, y_q18, window->height, window->level_y);
    for (int32_t v = 0; v < window->y.taps; v++) {
        uint8_t *row = image_row(picture, mirror_index(y.begin + v, picture->height));
        for (int32_t u = 0; u < window->x.taps; u++) {
            const int positive = (x.second[u] < 0) == (y.first[v] < 0);
            memset(row + mirror_index(x.begin + u, picture->width) * (int32_t)picture->format,
                   positive != smallest ? 255 : 0, picture->format);
        }
    }
}

/* Coefficients are as large as fixed.h says, of either sign. */
static coefficients_t fenced_coefficients(const image_t *picture, rng_t *rng)
{
    const size_t count = (size_t)(picture->width * picture->height) * picture->format;
    int16_t *data = fenced_place(&source, count * sizeof *data, (int)rng_int(rng, 0, 1));
    const int kind = (int)rng_int(rng, 0, 3);
    for (size_t i = 0; i < count; i++)
        data[i] = (int16_t)(kind == 0   ? 18432
                            : kind == 1 ? -18432
                            : kind == 2 ? (rng_int(rng, 0, 1) ? 18432 : -18432)
                                        : rng_int(rng, -18432, 18432));
    return (coefficients_t){data, picture->width, picture->height, (int32_t)picture->format};
}

static int32_t level_0_size(int32_t size, int level, rng_t *rng)
{
    return level == 0 ? size : (size << (3 * level)) - (int32_t)rng_int(rng, 0, 7);
}

static void check_window(const warp_kernels_t *tested, const char *name, uint16_t x_side, uint16_t y_side, rng_t *rng)
{
    const uint64_t seed = rng->state;
    const image_format_t format = rng_int(rng, 0, 1) ? IMAGE_GRAY8 : IMAGE_XRGB8888;
    const int is_large = (int)rng_int(rng, 0, 3);
    const int level_x = rng_int(rng, 0, 9) == 0, level_y = rng_int(rng, 0, 9) == 0;
    const int32_t width = (int32_t)rng_int(rng, 1, is_large ? 90 : 12), count = (int32_t)rng_next(rng) & 31;
    const int32_t height = (int32_t)rng_int(rng, 1, is_large ? 90 : 12), gray = format == IMAGE_GRAY8;
    window_t window = {.x = window_axis(&weights, x_side),
                       .y = window_axis(&weights, y_side),
                       .picture = fenced_picture(width, height, format, rng),
                       .width = level_0_size(width, level_x, rng),
                       .height = level_0_size(height, level_y, rng),
                       .level_x = level_x,
                       .level_y = level_y};
    const int far = (int)rng_int(rng, 0, 2) == 0;
    const int32_t *x =
        far ? fill_far_points(0, count, window.width, &window.x, rng) : fill_points(0, count, window.width, rng);
    const int32_t *y =
        far ? fill_far_points(1, count, window.height, &window.y, rng) : fill_points(1, count, window.height, rng);
    resample_window_fn *expected, *found;
    if (weights.of_coefficients) {
        window.coefficients = fenced_coefficients(&window.picture, rng);
        expected = gray ? warp_kernels_scalar.coefficients_gray : warp_kernels_scalar.coefficients_xrgb;
        found = gray ? tested->coefficients_gray : tested->coefficients_xrgb;
    } else {
        if (count > 0 && rng_int(rng, 0, 1))
            fill_worst(&window, x[0], y[0], (int)rng_int(rng, 0, 1));
        expected = gray ? warp_kernels_scalar.window_gray : warp_kernels_scalar.window_xrgb;
        found = gray ? tested->window_gray : tested->window_xrgb;
    }
    check_case("%s, sides %d and %d, rng %#llx, %d x %d of %d channels, count %d", name, x_side, y_side,
               (unsigned long long)seed, width, height, (int)format, count);
    outputs_begin(&outputs, (size_t)count * format);
    expected(outputs.expected, &window, x, y, count);
    found(outputs.found, &window, x, y, count);
    outputs_compare(&outputs);
}

/* Every side along either axis, small ones against one another; plain interpolators have but side 0. */
static void check_table(const warp_kernels_t *tested, const char *name, warp_resampler_t resampler,
                        bool of_coefficients)
{
    enum { PLAIN_CASES = 1500, CASES_PER_SIDE = 8, SMALL_SIDES = 200, SMALL_CASES = 1500 };
    rng_t rng = {(uint64_t)resampler};
    take_memory();
    window_weights_init(&weights, resampler, of_coefficients);
    for (int n = 0; n < PLAIN_CASES; n++)
        check_window(tested, name, 0, 0, &rng);
    if (!warp_averages(resampler))
        return;
    for (int n = 0; n < SMALL_CASES; n++)
        check_window(tested, name, (uint16_t)rng_int(&rng, 0, SMALL_SIDES), (uint16_t)rng_int(&rng, 0, SMALL_SIDES),
                     &rng);
    for (int n = 0; n < WINDOW_SIDES * CASES_PER_SIDE; n++) {
        const uint16_t side = (uint16_t)(n / CASES_PER_SIDE), other = (uint16_t)rng_int(&rng, 0, WINDOW_SIDES - 1);
        check_window(tested, name, n % 2 ? side : other, n % 2 ? other : side, &rng);
    }
}

void check_windows(const warp_kernels_t *tested)
{
    check_table(tested, "linear", WARP_LINEAR, false);
    check_table(tested, "cubic", WARP_CUBIC, false);
    check_table(tested, "area", WARP_AREA, false);
    check_table(tested, "mean+cubic", WARP_MEAN_CUBIC, false);
}

void check_coefficients(const warp_kernels_t *tested)
{
    check_table(tested, "filtered linear", WARP_LINEAR, true);
    check_table(tested, "filtered cubic", WARP_CUBIC, true);
    check_table(tested, "spline", WARP_SPLINE, true);
    check_table(tested, "mean+spline", WARP_MEAN_SPLINE, true);
}
