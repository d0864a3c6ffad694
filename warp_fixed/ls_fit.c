// SPDX-License-Identifier: Apache-2.0
// Picture -> least-squares spline surface (eq 6, 7 of the paper), in real time: along x, then along y.
//
// Range. The scaled data of an axis of N pixels, |pixel| <= P, have a norm of at most P sqrt(sum w_i / h) <= 64 P,
// since w_i <= 1 and N / h <= 4096 pieces. Rotations keep norms, so no right-hand side nor any value on its way exceeds
// 64 P. With P = 255 * 2^17 that is 2^31 * 255 / 256; the rest is room for the rounding of 8 products in each of 4096
// equations. (Without weights it is 2.3 P, since a right-hand side feels a few pieces only.) Bytes enter as Q17. Along
// y each lane, a column of coefficients, enters as Q17 too, or with as many bits less as it takes to stay below this P.
//
// Coefficients have LS_STATE_BITS fraction bits less than right-hand sides, so 32 bits hold 2^12 P. Without weights no
// coefficient exceeds 2600 P, at N = 17 and k = 1.25; 82 P from k = 1.5 on, 19 P from k = 2 on and 13 P when
// interpolating, at either end of a small N: the fit extrapolates over the last half pixel. Weights can multiply that
// by 64, and then coefficients saturate.
//
// Both axes together grow by at most 2600^2, so largest |row| * 2600 bounds the surface: its fraction bits follow from
// it.
//
// Error. A right-hand side takes part in 4 equations per pixel of a piece; each rounds it twice, to 2^-17 of a level.
// The back substitution rounds to 2^-11, the surface to 2^-4. All but the last are enlarged as coefficients are.
// Measured against the float definition at the same phases: for k <= 1 and k >= 1.5 at most 0.05 levels (0.008 rms)
// between the outermost pixel centres, noise and checkerboards included, and 0.1 beyond them. At k = 1.25: photographs
// 0.3 levels (0.02 rms), beyond the outermost centres 2, and 16 in the corner's quarter pixel; the worst pictures 1.5,
// 11 and 54, where the surface itself reaches 10^5 and 10^8 levels and is cut off; 6, 47 and 215 at N = 17.
#include "warp_fixed/ls_fit.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "warp_fixed/fixed.h"

enum {
    ROW_BITS = LS_PIXEL_BITS - LS_STATE_BITS,
    MOST_FRACTION_BITS = 4,
    LARGEST_GROWTH = 2600 /* of coefficients over data, along one axis */
};

static const int32_t largest_data = 255 << LS_PIXEL_BITS;

void ls_weights_init(ls_weights_t *weights)
{
    for (int32_t i = 0; i < IMAGE_MAX_WIDTH; i++)
        weights->x[i] = LS_WEIGHT_ONE;
    for (int32_t j = 0; j < IMAGE_MAX_HEIGHT; j++)
        weights->y[j] = LS_WEIGHT_ONE;
}

void ls_init(ls_t *ls)
{
    ls_weights_init(&ls->weights);
    for (int plane = 0; plane < LS_PLANES; plane++) {
        ls_axis_init(&ls->plane[plane].x);
        ls_axis_init(&ls->plane[plane].y);
    }
}

void ls_set_weights(ls_t *ls, const ls_weights_t *weights)
{
    ls->weights = *weights;
    for (int plane = 0; plane < LS_PLANES; plane++) {
        ls_axis_init(&ls->plane[plane].x);
        ls_axis_init(&ls->plane[plane].y);
    }
}

/* What the strips of one axis share, for one worker. */
typedef struct {
    const ls_axis_t *axis;
    ls_strip_t *strip;
    const warp_kernels_t *kernels;
    int32_t *coefficients;
} fit_t;

/* Where a plane begins: the second one has half of the channels at most. */
static ptrdiff_t plane_offset(int plane)
{
    return (ptrdiff_t)plane * IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888 / 2;
}

static void begin_strip(const fit_t *fit)
{
    memset(fit->strip->lane, 0, sizeof(int32_t) * LS_LANES * (size_t)(fit->axis->coefficients + LS_TAPS - 1));
}

static void take_equation(const fit_t *fit, int32_t number, const int32_t *data)
{
    const ls_equation_t *equation = &fit->axis->equation[number];
    fit->kernels->ls_forward(fit->strip->lane + equation->first * LS_LANES, data, equation);
}

/* Equations without data, of axes below 4 pixels, then the coefficients. */
static void end_strip(const fit_t *fit)
{
    const int32_t nothing[LS_LANES] = {0};
    for (int32_t i = fit->axis->knots.size; i < fit->axis->equations; i++)
        take_equation(fit, i, nothing);
    for (int32_t j = fit->axis->coefficients - 1; j >= 0; j--)
        fit->kernels->ls_backward(fit->strip->lane + j * LS_LANES, &fit->axis->solution[j]);
}

/* A solved strip -> coefficients of picture rows [y, end). Always inlined with a constant number of channels. */
static inline void store_rows(const fit_t *fit, int32_t y, int32_t end, int32_t channels)
{
    const ptrdiff_t stride = (ptrdiff_t)fit->axis->coefficients * channels;
    for (int32_t row = y; row < end; row++) {
        int32_t *to = fit->coefficients + row * stride;
        const int32_t *from = fit->strip->lane + (row - y) * channels;
        for (int32_t j = 0; j < fit->axis->coefficients; j++)
            memcpy(to + j * channels, from + j * LS_LANES, (size_t)channels * sizeof *to);
    }
}

static ls_pixels_fn *pixels_loop(const warp_kernels_t *kernels, image_format_t format)
{
    return format == IMAGE_GRAY8  ? kernels->ls_pixels_gray
           : format == IMAGE_UV88 ? kernels->ls_pixels_chroma
                                  : kernels->ls_pixels_xrgb;
}

/* Picture rows [y, end) -> rows of coefficients. Lanes are rows times channels; those to spare repeat the last row. */
static void fit_strip_of_rows(const fit_t *fit, const image_t *picture, int32_t y, int32_t end)
{
    ls_pixels_fn *const take_pixels = pixels_loop(fit->kernels, picture->format);
    const uint8_t *rows[LS_LANES];
    for (int32_t i = 0; i < LS_LANES; i++)
        rows[i] = image_row(picture, y + i < end ? y + i : end - 1);
    int32_t data[LS_LANES];
    begin_strip(fit);
    for (int32_t x = 0; x < picture->width; x++) {
        take_pixels(data, rows, x);
        take_equation(fit, x, data);
    }
    end_strip(fit);
    if (picture->format == IMAGE_GRAY8)
        store_rows(fit, y, end, IMAGE_GRAY8);
    else if (picture->format == IMAGE_UV88)
        store_rows(fit, y, end, IMAGE_UV88);
    else
        store_rows(fit, y, end, IMAGE_XRGB8888);
}

/* The largest magnitude of `count` coefficients. */
static int32_t largest_of(const int32_t *rows, ptrdiff_t count)
{
    int32_t largest = 0;
    for (ptrdiff_t i = 0; i < count; i++) {
        const int32_t magnitude = rows[i] < 0 ? -rows[i] : rows[i];
        largest = magnitude > largest ? magnitude : largest;
    }
    return largest;
}

/* Solve an axis of a plane that has `step` pixels of the whole picture to one of its own. */
static void update_axis(ls_axis_t *axis, int32_t size, int32_t step, const uint16_t *weight, int32_t k_q16)
{
    uint16_t own[LS_MAX_SIZE];
    if (step != 1)
        for (int32_t i = 0; i < size; i++)
            own[i] = weight[i * step];
    ls_axis_update(axis, size, k_q16, step != 1 ? own : weight);
}

void ls_begin(ls_t *ls, int plane, const image_t *picture, const image_t *whole, chroma_step_t step)
{
    update_axis(&ls->plane[plane].x, picture->width, whole->width / picture->width, ls->weights.x, step.x_q16);
    update_axis(&ls->plane[plane].y, picture->height, whole->height / picture->height, ls->weights.y, step.y_q16);
    for (int32_t w = 0; w < WORKERS_MAX; w++)
        ls->strip[w].largest[plane] = 0;
}

void ls_fit_rows(ls_t *ls, const warp_kernels_t *kernels, int plane, const image_t *picture, worker_t worker)
{
    const int32_t rows = LS_LANES / (int32_t)picture->format, height = picture->height;
    const share_t strips = share_of(worker, (height + rows - 1) / rows);
    const fit_t fit = {&ls->plane[plane].x, &ls->strip[worker.index], kernels, ls->coefficients + plane_offset(plane)};
    const int32_t begin = strips.begin * rows, end = strips.end * rows < height ? strips.end * rows : height;
    for (int32_t y = begin; y < end; y += rows)
        fit_strip_of_rows(&fit, picture, y, y + rows < height ? y + rows : height);
    const ptrdiff_t stride = (ptrdiff_t)fit.axis->coefficients * (int32_t)picture->format;
    fit.strip->largest[plane] = largest_of(fit.coefficients + begin * stride, (end - begin) * stride);
}

/* Bits that leave every coefficient of both axes below 2^31. */
static int32_t fraction_bits_for(const ls_t *ls, int plane)
{
    int32_t largest = 0;
    for (int32_t w = 0; w < WORKERS_MAX; w++)
        largest = ls->strip[w].largest[plane] > largest ? ls->strip[w].largest[plane] : largest;
    int32_t bits = MOST_FRACTION_BITS;
    while (bits > 0 && (int64_t)largest * LARGEST_GROWTH >= (int64_t)1 << (31 + ROW_BITS - bits))
        bits--;
    return bits;
}

/* Fewer lanes than a strip has are worked on in a copy. */
static void copy_lanes(int32_t *to, const int32_t *from, int32_t lanes)
{
    if (lanes == LS_LANES)
        memcpy(to, from, LS_LANES * sizeof *to);
    else
        memcpy(to, from, (size_t)lanes * sizeof *to);
}

/* How far each lane can be shifted up, or must be down, to be largest_data at most. */
static void choose_shifts(int32_t shift[LS_LANES], const warp_kernels_t *kernels, const int32_t largest[LS_LANES])
{
    for (int lane = 0; lane < LS_LANES; lane++)
        shift[lane] = LS_STATE_BITS;
    for (bool fits = false; !fits;) {
        int32_t scaled[LS_LANES];
        kernels->ls_scale(scaled, largest, shift);
        fits = true;
        for (int lane = 0; lane < LS_LANES; lane++) {
            if (scaled[lane] > largest_data) {
                shift[lane]--;
                fits = false;
            }
        }
    }
}

/* Of each column. */
static void find_largest(int32_t largest[LS_LANES], const int32_t *column, ptrdiff_t stride, int32_t size,
                         int32_t lanes)
{
    int32_t values[LS_LANES] = {0};
    for (int lane = 0; lane < LS_LANES; lane++)
        largest[lane] = 0;
    for (int32_t y = 0; y < size; y++) {
        copy_lanes(values, column + y * stride, lanes);
        for (int lane = 0; lane < LS_LANES; lane++) {
            const int32_t magnitude = values[lane] < 0 ? -values[lane] : values[lane];
            largest[lane] = magnitude > largest[lane] ? magnitude : largest[lane];
        }
    }
}

/* A strip of columns of coefficients along x, `stride` to a row -> of both axes, with fraction_bits, in place. */
static void fit_strip_of_columns(const fit_t *fit, int32_t first, int32_t stride, int32_t fraction_bits)
{
    const int32_t lanes = stride - first < LS_LANES ? stride - first : LS_LANES, size = fit->axis->knots.size;
    int32_t *column = fit->coefficients + first;
    int32_t largest[LS_LANES], shift[LS_LANES], back[LS_LANES], values[LS_LANES] = {0}, data[LS_LANES];
    find_largest(largest, column, stride, size, lanes);
    choose_shifts(shift, fit->kernels, largest);
    begin_strip(fit);
    for (int32_t y = 0; y < size; y++) {
        copy_lanes(values, column + (ptrdiff_t)y * stride, lanes);
        fit->kernels->ls_scale(data, values, shift);
        take_equation(fit, y, data);
    }
    end_strip(fit);
    const int32_t surplus = ROW_BITS - LS_STATE_BITS - fraction_bits;
    for (int lane = 0; lane < LS_LANES; lane++)
        back[lane] = -(surplus + shift[lane]);
    for (int32_t j = 0; j < fit->axis->coefficients; j++) {
        fit->kernels->ls_scale(data, fit->strip->lane + j * LS_LANES, back);
        copy_lanes(column + (ptrdiff_t)j * stride, data, lanes);
    }
}

void ls_fit_columns(ls_t *ls, const warp_kernels_t *kernels, int plane, const image_t *picture, worker_t worker)
{
    const int32_t stride = ls->plane[plane].x.coefficients * (int32_t)picture->format;
    const int32_t fraction_bits = fraction_bits_for(ls, plane);
    const share_t strips = share_of(worker, (stride + LS_LANES - 1) / LS_LANES);
    const fit_t fit = {&ls->plane[plane].y, &ls->strip[worker.index], kernels, ls->coefficients + plane_offset(plane)};
    for (int32_t lane = strips.begin * LS_LANES; lane < strips.end * LS_LANES; lane += LS_LANES)
        fit_strip_of_columns(&fit, lane, stride, fraction_bits);
}

ls_surface_t ls_surface(const ls_t *ls, int plane)
{
    return (ls_surface_t){&ls->plane[plane].x, &ls->plane[plane].y, ls->coefficients + plane_offset(plane),
                          fraction_bits_for(ls, plane)};
}

ls_surface_t ls_fit(ls_t *ls, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16)
{
    ls_begin(ls, 0, picture, picture, (chroma_step_t){k_q16, k_q16});
    ls_fit_rows(ls, kernels, 0, picture, only_worker);
    ls_fit_columns(ls, kernels, 0, picture, only_worker);
    return ls_surface(ls, 0);
}
