// SPDX-License-Identifier: Apache-2.0
// The least-squares surface at each point: 4 x 4 coefficients, weighed along both axes.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

/* Weights are not negative and add up to one: every mean is among its terms, and no sum exceeds 2^61. */
static inline void evaluate(uint8_t *out, const ls_surface_t *surface, int32_t x_q18, int32_t y_q18, int32_t channels)
{
    const ls_taps_t x = ls_axis_taps(surface->x, x_q18), y = ls_axis_taps(surface->y, y_q18);
    const ptrdiff_t stride = (ptrdiff_t)surface->x->coefficients * channels;
    const int32_t *corner = surface->coefficients + y.first * stride + x.first * channels;
    for (int32_t channel = 0; channel < channels; channel++) {
        int64_t sum = 0;
        for (int32_t v = 0; v < LS_TAPS; v++) {
            int64_t row = 0;
            for (int32_t u = 0; u < LS_TAPS; u++)
                row += (int64_t)x.weight[u] * corner[v * stride + u * channels + channel];
            sum += y.weight[v] * round_shift(row, LS_WEIGHT_BITS);
        }
        out[channel] = (uint8_t)clamp_i64(round_shift(sum, LS_WEIGHT_BITS + surface->fraction_bits), 0, 255);
    }
}

static inline void evaluate_patch(const patch_t *patch, const ls_surface_t *surface, int32_t channels)
{
    for (int32_t r = 0; r < patch->height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        for (int32_t k = 0; k < patch->width; k++)
            evaluate(patch->out + r * patch->stride + k * channels, surface, x_q18[k], y_q18[k], channels);
    }
}

void resample_ls_gray_scalar(const patch_t *patch, const ls_surface_t *surface)
{
    evaluate_patch(patch, surface, 1);
}

void resample_ls_chroma_scalar(const patch_t *patch, const ls_surface_t *surface)
{
    evaluate_patch(patch, surface, 2);
}

void resample_ls_xrgb_scalar(const patch_t *patch, const ls_surface_t *surface)
{
    evaluate_patch(patch, surface, 4);
}
