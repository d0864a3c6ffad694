// SPDX-License-Identifier: Apache-2.0
// A window of texels around each point, weighed along both axes: every interpolation and mean but nearest neighbour.
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/window_place.h"

enum { PATCH_STRIDE = 4 * WINDOW_MAX_TAPS };

/* The texels of a window that reaches beyond the picture, gathered with mirroring into patch. */
static void gather_mirrored(uint8_t *patch, const window_t *window, int32_t x, int32_t y)
{
    const image_t *picture = &window->picture;
    const int32_t channels = (int32_t)picture->format;
    for (int32_t v = 0; v < window->y.taps; v++) {
        const uint8_t *row = image_row(picture, mirror_index(y + v, picture->height));
        for (int32_t u = 0; u < window->x.taps; u++)
            memcpy(patch + v * PATCH_STRIDE + u * channels, row + mirror_index(x + u, picture->width) * channels,
                   (size_t)channels);
    }
}

/* One pixel. Always inlined with a constant number of channels, so that the compiler can unroll over them. */
static inline void weigh(uint8_t *out, const window_t *window, int32_t x_q18, int32_t y_q18, int32_t channels)
{
    const image_t *picture = &window->picture;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const window_place_t x = window_place(&window->x, x_q18, window->width, window->level_x);
    const window_place_t y = window_place(&window->y, y_q18, window->height, window->level_y);
    uint8_t patch[WINDOW_MAX_TAPS * PATCH_STRIDE];
    const uint8_t *texels = patch;
    ptrdiff_t stride = PATCH_STRIDE;
    if (x.begin >= 0 && x.begin + nx <= picture->width && y.begin >= 0 && y.begin + ny <= picture->height) {
        texels = image_row(picture, y.begin) + x.begin * channels;
        stride = picture->stride;
    } else {
        gather_mirrored(patch, window, x.begin, y.begin);
    }

    int32_t v[4 * WINDOW_MAX_TAPS];
    const int32_t half = (1 << window->y.first_shift) >> 1;
    for (int32_t u = 0; u < nx * channels; u++)
        v[u] = half;
    for (int32_t t = 0; t < ny; t++)
        for (int32_t u = 0; u < nx * channels; u++)
            v[u] += y.first[t] * texels[t * stride + u];
    for (int32_t channel = 0; channel < channels; channel++) {
        int32_t sum = 0;
        for (int32_t u = 0; u < nx; u++)
            sum += x.second[u] * (v[u * channels + channel] >> window->y.first_shift);
        out[channel] = pixel_from_sum(sum);
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

void resample_window_gray_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 1);
}

void resample_window_chroma_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 2);
}

void resample_window_xrgb_scalar(const patch_t *patch, const window_t *window)
{
    weigh_patch(patch, window, 4);
}
