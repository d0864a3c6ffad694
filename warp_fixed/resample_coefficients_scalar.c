// SPDX-License-Identifier: Apache-2.0
// A window of coefficients around each point, weighed along both axes.
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/window_place.h"

enum { PATCH_STRIDE = 4 * WINDOW_MAX_TAPS };

/* The coefficients of a window that reaches beyond the picture, gathered with mirroring into patch. */
static void gather_mirrored(int16_t *patch, const window_t *window, int32_t x, int32_t y)
{
    const coefficients_t *from = &window->coefficients;
    const int32_t channels = from->channels;
    for (int32_t v = 0; v < window->y.taps; v++) {
        const int16_t *row = from->data + (ptrdiff_t)mirror_index(y + v, from->height) * from->width * channels;
        for (int32_t u = 0; u < window->x.taps; u++)
            memcpy(patch + v * PATCH_STRIDE + u * channels, row + mirror_index(x + u, from->width) * channels,
                   (size_t)channels * sizeof *patch);
    }
}

/* One pixel. Always inlined with a constant number of channels, so that the compiler can unroll over them. */
static inline void weigh(uint8_t *out, const window_t *window, int32_t x_q18, int32_t y_q18, int32_t channels)
{
    const coefficients_t *from = &window->coefficients;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const window_place_t x = window_place(&window->x, x_q18, window->width, window->level_x);
    const window_place_t y = window_place(&window->y, y_q18, window->height, window->level_y);
    int16_t patch[WINDOW_MAX_TAPS * PATCH_STRIDE];
    const int16_t *coefficients = patch;
    ptrdiff_t stride = PATCH_STRIDE;
    if (x.begin >= 0 && x.begin + nx <= from->width && y.begin >= 0 && y.begin + ny <= from->height) {
        stride = (ptrdiff_t)from->width * channels;
        coefficients = from->data + y.begin * stride + x.begin * channels;
    } else {
        gather_mirrored(patch, window, x.begin, y.begin);
    }

    int32_t v[4 * WINDOW_MAX_TAPS];
    for (int32_t u = 0; u < nx * channels; u++)
        v[u] = 1 << (COEFFICIENT_SUM_LOG2 - 1);
    for (int32_t t = 0; t < ny; t++)
        for (int32_t u = 0; u < nx * channels; u++)
            v[u] += y.first[t] * coefficients[t * stride + u];
    for (int32_t channel = 0; channel < channels; channel++) {
        int32_t sum = 0;
        for (int32_t u = 0; u < nx; u++)
            sum += x.second[u] * (v[u * channels + channel] >> COEFFICIENT_SUM_LOG2);
        out[channel] = pixel_from_centred(sum, COEFFICIENT_SUM_LOG2 + COEFFICIENT_BITS);
    }
}

static inline void weigh_patch(const patch_t *patch, const window_t *window, int32_t channels)
{
    for (int32_t r = 0; r < patch->height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        for (int32_t k = 0; k < patch->width; k++)
            weigh(patch->out + r * patch->stride + k * channels, window, x_q18[k], y_q18[k], channels);
    }
}

void resample_coefficients_gray_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 1);
}

void resample_coefficients_chroma_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 2);
}

void resample_coefficients_xrgb_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 4);
}
