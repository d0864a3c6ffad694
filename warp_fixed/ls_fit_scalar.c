// SPDX-License-Identifier: Apache-2.0
// The least-squares fit of a strip: pixels in, rotations forward, substitution back.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

static inline void take_pixels(int32_t *data, const uint8_t *const *rows, int32_t x, int32_t channels)
{
    for (int lane = 0; lane < LS_LANES; lane++)
        data[lane] = rows[lane / channels][x * channels + lane % channels] << LS_PIXEL_BITS;
}

void ls_pixels_gray_scalar(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    take_pixels(data, rows, x, 1);
}

void ls_pixels_chroma_scalar(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    take_pixels(data, rows, x, 2);
}

void ls_pixels_xrgb_scalar(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    take_pixels(data, rows, x, 4);
}

void ls_scale_scalar(int32_t *restrict to, const int32_t *restrict from, const int32_t *restrict shift)
{
    for (int lane = 0; lane < LS_LANES; lane++) {
        const int64_t x = from[lane];
        const int64_t scaled = shift[lane] < 0 ? round_shift(x, -shift[lane]) : x * ((int64_t)1 << shift[lane]);
        to[lane] = (int32_t)clamp_i64(scaled, -INT32_MAX, INT32_MAX);
    }
}

void ls_forward_scalar(int32_t *restrict z, const int32_t *restrict data, const ls_equation_t *equation)
{
    int32_t d[LS_LANES];
    for (int lane = 0; lane < LS_LANES; lane++)
        d[lane] = mul_q31(equation->scale_q31, data[lane]);
    for (int t = 0; t < LS_TAPS; t++) {
        const int32_t cos = equation->cos_q31[t], sin = equation->sin_q31[t];
        for (int lane = 0; lane < LS_LANES; lane++) {
            const int32_t old = z[t * LS_LANES + lane];
            z[t * LS_LANES + lane] = mul_q31(cos, old) + mul_q31(sin, d[lane]);
            d[lane] = mul_q31(cos, d[lane]) - mul_q31(sin, old);
        }
    }
}

/* Factors below 2^29 and rows of 32 bits: the sum stays below 2^62. */
void ls_backward_scalar(int32_t *row, const ls_solution_t *solution)
{
    for (int lane = 0; lane < LS_LANES; lane++) {
        int64_t sum = (int64_t)solution->own * row[lane];
        for (int t = 0; t < LS_TAPS - 1; t++)
            sum += (int64_t)solution->next[t] * row[(t + 1) * LS_LANES + lane];
        row[lane] = (int32_t)clamp_i64(round_shift(sum, solution->shift), -INT32_MAX, INT32_MAX);
    }
}
