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
        points[axis] = fenced_new(PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH * sizeof(int32_t));
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

static image_format_t any_format(rng_t *rng)
{
    static const image_format_t formats[] = {IMAGE_GRAY8, IMAGE_UV88, IMAGE_XRGB8888};
    return formats[rng_int(rng, 0, 2)];
}

static resample_nearest_fn *nearest_of(const warp_kernels_t *kernels, image_format_t format)
{
    return format == IMAGE_GRAY8  ? kernels->nearest_gray
           : format == IMAGE_UV88 ? kernels->nearest_chroma
                                  : kernels->nearest_xrgb;
}

static resample_window_fn *window_of(const warp_kernels_t *kernels, image_format_t format)
{
    return format == IMAGE_GRAY8  ? kernels->window_gray
           : format == IMAGE_UV88 ? kernels->window_chroma
                                  : kernels->window_xrgb;
}

static resample_window_fn *coefficients_of(const warp_kernels_t *kernels, image_format_t format)
{
    return format == IMAGE_GRAY8  ? kernels->coefficients_gray
           : format == IMAGE_UV88 ? kernels->coefficients_chroma
                                  : kernels->coefficients_xrgb;
}

/* Points of one axis as a grid makes them: steps from column to column and from row to row. */
static const int32_t *fill_points(int axis, const int32_t size[2], int64_t at, int64_t by_column, int64_t by_row)
{
    const int32_t count = size[0] == 0 ? 0 : (size[1] - 1) * PATCH_MAX_WIDTH + size[0];
    int32_t *point = fenced_place(&points[axis], (size_t)count * sizeof *point, 0);
    for (int32_t r = 0; r < size[1]; r++)
        for (int32_t k = 0; k < size[0]; k++)
            point[r * PATCH_MAX_WIDTH + k] = (int32_t)(at + k * by_column + r * by_row);
    return point;
}

/* Points whose windows end at or near the last texel: there, reading one too many meets the fence. */
static const int32_t *far_points(int axis, const int32_t size[2], int32_t texels, int32_t taps, rng_t *rng)
{
    const int32_t one = 1 << GRID_FRACTION_BITS;
    const int64_t at = (int64_t)texels * one - (int64_t)taps * one / 2 + rng_int(rng, -one, one / 2);
    return fill_points(axis, size, at, rng_int(rng, -one / 64, one / 64), rng_int(rng, -one / 16, one / 16));
}

/* Points in, across the edges of and beyond an axis of so many texels, of any step; or the same point everywhere. */
static const int32_t *any_points(int axis, const int32_t size[2], int32_t texels, rng_t *rng)
{
    const int kind = (int)rng_int(rng, 0, 3);
    const int64_t one = 1 << GRID_FRACTION_BITS, whole = texels * one, margin = whole / 8 + one;
    if (kind == 3) {
        const int64_t at = rng_int(rng, 0, 1) ? (int32_t)rng_next(rng) : rng_int(rng, 0, 1) * whole;
        return fill_points(axis, size, at, 0, 0);
    }
    const int64_t at = rng_int(rng, kind == 0 ? whole / 4 : -margin, kind == 0 ? whole / 2 : whole + margin);
    const int64_t most = kind == 2 ? 50 * one : one;
    return fill_points(axis, size, at, rng_int(rng, -most, most), rng_int(rng, -most, most));
}

/* Where a table writes, rows apart as far as it likes. */
static patch_t patch_into(void *out, const int32_t size[2], ptrdiff_t stride, const int32_t *x, const int32_t *y)
{
    return (patch_t){out, stride, x, y, size[0], size[1]};
}

static size_t patch_bytes(const int32_t size[2], ptrdiff_t stride, image_format_t format)
{
    return (size_t)((size[1] - 1) * stride) + (size_t)size[0] * format;
}

void check_nearest(const warp_kernels_t *tested)
{
    take_memory();
    for (uint64_t seed = 1; seed <= 60; seed++) {
        rng_t rng = {seed};
        for (int32_t count = 0; count <= PATCH_MAX_WIDTH; count++) {
            const image_format_t format = any_format(&rng);
            const int32_t width = (int32_t)rng_int(&rng, 1, 140), height = (int32_t)rng_int(&rng, 1, 140);
            const image_t picture = fenced_picture(width, height, format, &rng);
            const int32_t size[2] = {count, (int32_t)rng_int(&rng, 1, PATCH_MAX_HEIGHT)};
            const ptrdiff_t stride = count * (ptrdiff_t)format + rng_int(&rng, 0, 9);
            const int32_t *x = any_points(0, size, width, &rng), *y = any_points(1, size, height, &rng);
            check_case("nearest, seed %d, %d x %d of %d channels, patch %d x %d", (int)seed, width, height, (int)format,
                       size[0], size[1]);
            outputs_begin(&outputs, patch_bytes(size, stride, format));
            const patch_t expected = patch_into(outputs.expected, size, stride, x, y);
            const patch_t found = patch_into(outputs.found, size, stride, x, y);
            nearest_of(&warp_kernels_scalar, format)(&expected, &picture);
            nearest_of(tested, format)(&found, &picture);
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
    const image_format_t format = any_format(rng);
    const int is_large = (int)rng_int(rng, 0, 3);
    const window_axis_t x_axis = window_axis(&weights, x_side), y_axis = window_axis(&weights, y_side);
    const int level_x = x_axis.taps > WINDOW_SHORT_TAPS && rng_int(rng, 0, 9) == 0;
    const int level_y = y_axis.taps > WINDOW_SHORT_TAPS && rng_int(rng, 0, 9) == 0;
    const int32_t width = (int32_t)rng_int(rng, 1, is_large ? 90 : 12);
    const int32_t height = (int32_t)rng_int(rng, 1, is_large ? 90 : 12);
    const int32_t size[2] = {(int32_t)rng_next(rng) & 31, (int32_t)rng_int(rng, 1, 3)};
    const ptrdiff_t stride = size[0] * (ptrdiff_t)format + rng_int(rng, 0, 9);
    window_t window = {.x = x_axis,
                       .y = y_axis,
                       .picture = fenced_picture(width, height, format, rng),
                       .width = level_0_size(width, level_x, rng),
                       .height = level_0_size(height, level_y, rng),
                       .level_x = level_x,
                       .level_y = level_y};
    const int far = (int)rng_int(rng, 0, 2) == 0;
    const int32_t *x =
        far ? far_points(0, size, window.width, window.x.taps, rng) : any_points(0, size, window.width, rng);
    const int32_t *y =
        far ? far_points(1, size, window.height, window.y.taps, rng) : any_points(1, size, window.height, rng);
    resample_window_fn *expected, *found;
    if (weights.of_coefficients) {
        window.coefficients = fenced_coefficients(&window.picture, rng);
        expected = coefficients_of(&warp_kernels_scalar, format);
        found = coefficients_of(tested, format);
    } else {
        if (size[0] > 0 && rng_int(rng, 0, 1))
            fill_worst(&window, x[0], y[0], (int)rng_int(rng, 0, 1));
        expected = window_of(&warp_kernels_scalar, format);
        found = window_of(tested, format);
    }
    check_case("%s, sides %d and %d, rng %#llx, %d x %d of %d channels, patch %d x %d", name, x_side, y_side,
               (unsigned long long)seed, width, height, (int)format, size[0], size[1]);
    outputs_begin(&outputs, patch_bytes(size, stride, format));
    const patch_t patches[2] = {patch_into(outputs.expected, size, stride, x, y),
                                patch_into(outputs.found, size, stride, x, y)};
    expected(&patches[0], &window);
    found(&patches[1], &window);
    outputs_compare(&outputs);
}

/* Every side along either axis, small ones against one another; plain interpolators have but side 0. */
static void check_table(const warp_kernels_t *tested, const char *name, warp_resampler_t resampler,
                        bool of_coefficients)
{
    enum { PLAIN_CASES = 2000, CASES_PER_SIDE = 10, SMALL_SIDES = 200, SMALL_CASES = 2500 };
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
