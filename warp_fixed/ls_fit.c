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
    ls_axis_init(&ls->x);
    ls_axis_init(&ls->y);
}

void ls_set_weights(ls_t *ls, const ls_weights_t *weights)
{
    ls->weights = *weights;
    ls_axis_init(&ls->x);
    ls_axis_init(&ls->y);
}

static void begin_strip(ls_t *ls, const ls_axis_t *axis)
{
    memset(ls->strip, 0, sizeof(int32_t) * LS_LANES * (size_t)(axis->coefficients + LS_TAPS - 1));
}

static void take_equation(ls_t *ls, const warp_kernels_t *kernels, const ls_equation_t *equation, const int32_t *data)
{
    kernels->ls_forward(ls->strip + equation->first * LS_LANES, data, equation);
}

/* Equations without data, of axes below 4 pixels, then the coefficients. */
static void end_strip(ls_t *ls, const warp_kernels_t *kernels, const ls_axis_t *axis)
{
    const int32_t nothing[LS_LANES] = {0};
    for (int32_t i = axis->knots.size; i < axis->equations; i++)
        take_equation(ls, kernels, &axis->equation[i], nothing);
    for (int32_t j = axis->coefficients - 1; j >= 0; j--)
        kernels->ls_backward(ls->strip + j * LS_LANES, &axis->solution[j]);
}

/* A solved strip -> coefficients of picture rows [y, end). Always inlined with a constant number of channels. */
static inline void store_rows(ls_t *ls, int32_t y, int32_t end, int32_t channels)
{
    const ptrdiff_t stride = (ptrdiff_t)ls->x.coefficients * channels;
    for (int32_t row = y; row < end; row++) {
        int32_t *to = ls->coefficients + row * stride;
        const int32_t *from = ls->strip + (row - y) * channels;
        for (int32_t j = 0; j < ls->x.coefficients; j++)
            memcpy(to + j * channels, from + j * LS_LANES, (size_t)channels * sizeof *to);
    }
}

/* Picture rows [y, end) -> rows of coefficients. Lanes are rows times channels; those to spare repeat the last row. */
static void fit_rows(ls_t *ls, const warp_kernels_t *kernels, const image_t *picture, int32_t y, int32_t end)
{
    const bool gray = picture->format == IMAGE_GRAY8;
    ls_pixels_fn *const take_pixels = gray ? kernels->ls_pixels_gray : kernels->ls_pixels_xrgb;
    const uint8_t *rows[LS_LANES];
    for (int32_t i = 0; i < LS_LANES; i++)
        rows[i] = image_row(picture, y + i < end ? y + i : end - 1);
    int32_t data[LS_LANES];
    begin_strip(ls, &ls->x);
    for (int32_t x = 0; x < picture->width; x++) {
        take_pixels(data, rows, x);
        take_equation(ls, kernels, &ls->x.equation[x], data);
    }
    end_strip(ls, kernels, &ls->x);
    if (gray)
        store_rows(ls, y, end, IMAGE_GRAY8);
    else
        store_rows(ls, y, end, IMAGE_XRGB8888);
}

/* Bits that leave every coefficient of both axes below 2^31. There are `count` of the rows. */
static int32_t fraction_bits_for(const int32_t *rows, ptrdiff_t count)
{
    int32_t largest = 0;
    for (ptrdiff_t i = 0; i < count; i++) {
        const int32_t magnitude = rows[i] < 0 ? -rows[i] : rows[i];
        largest = magnitude > largest ? magnitude : largest;
    }
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

/* `lanes` columns of coefficients along x, `stride` to a row -> of both axes, with fraction_bits, in place. */
static void fit_columns(ls_t *ls, const warp_kernels_t *kernels, int32_t *column, int32_t lanes, ptrdiff_t stride,
                        int32_t fraction_bits)
{
    int32_t largest[LS_LANES], shift[LS_LANES], back[LS_LANES], values[LS_LANES] = {0}, data[LS_LANES];
    find_largest(largest, column, stride, ls->y.knots.size, lanes);
    choose_shifts(shift, kernels, largest);
    begin_strip(ls, &ls->y);
    for (int32_t y = 0; y < ls->y.knots.size; y++) {
        copy_lanes(values, column + y * stride, lanes);
        kernels->ls_scale(data, values, shift);
        take_equation(ls, kernels, &ls->y.equation[y], data);
    }
    end_strip(ls, kernels, &ls->y);
    const int32_t surplus = ROW_BITS - LS_STATE_BITS - fraction_bits;
    for (int lane = 0; lane < LS_LANES; lane++)
        back[lane] = -(surplus + shift[lane]);
    for (int32_t j = 0; j < ls->y.coefficients; j++) {
        kernels->ls_scale(data, ls->strip + j * LS_LANES, back);
        copy_lanes(column + j * stride, data, lanes);
    }
}

ls_surface_t ls_fit(ls_t *ls, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16)
{
    const int32_t channels = (int32_t)picture->format, rows = LS_LANES / channels;
    ls_axis_update(&ls->x, picture->width, k_q16, ls->weights.x);
    ls_axis_update(&ls->y, picture->height, k_q16, ls->weights.y);
    for (int32_t y = 0; y < picture->height; y += rows)
        fit_rows(ls, kernels, picture, y, y + rows < picture->height ? y + rows : picture->height);
    const int32_t stride = ls->x.coefficients * channels;
    const int32_t fraction_bits = fraction_bits_for(ls->coefficients, (ptrdiff_t)stride * picture->height);
    for (int32_t lane = 0; lane < stride; lane += LS_LANES)
        fit_columns(ls, kernels, ls->coefficients + lane, stride - lane < LS_LANES ? stride - lane : LS_LANES, stride,
                    fraction_bits);
    return (ls_surface_t){&ls->x, &ls->y, ls->coefficients, fraction_bits};
}
