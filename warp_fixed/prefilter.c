// SPDX-License-Identifier: Apache-2.0
// The low-pass filter before resampling: separable, its cut-off 1 / (2 k) from the step k.
#include "warp_fixed/prefilter.h"

#include "warp_fixed/fixed.h"

void prefilter_init(prefilter_t *prefilter)
{
    prefilter->filter = WARP_FILTER_NONE;
    prefilter->k_q16 = 0;
}

const int16_t *prefilter_sums(prefilter_sums_t *sums, const warp_kernels_t *kernels, const fir_t *fir,
                              const image_t *picture, int32_t y)
{
    const int32_t channels = (int32_t)picture->format, width = picture->width;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + 1];
    for (int32_t d = -fir->radius; d <= fir->radius; d++)
        rows[d + fir->radius] = image_row(picture, mirror_index(y + d, picture->height));
    int16_t *middle = sums->v + PREFILTER_MAX_RADIUS * channels;
    kernels->prefilter_columns(middle, rows, fir, width * channels);
    for (int32_t d = 1; d <= fir->radius; d++) {
        for (int32_t channel = 0; channel < channels; channel++) {
            middle[-d * channels + channel] = middle[mirror_index(-d, width) * channels + channel];
            middle[(width - 1 + d) * channels + channel] =
                middle[mirror_index(width - 1 + d, width) * channels + channel];
        }
    }
    return middle;
}

image_t prefilter_picture(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                          warp_filter_t filter, int32_t k_q16)
{
    if (filter == WARP_FILTER_NONE || k_q16 <= 1 << 16)
        return *picture;
    const int32_t k = k_q16 < FIR_MAX_K_Q16 ? k_q16 : FIR_MAX_K_Q16;
    if (k != prefilter->k_q16 || filter != prefilter->filter) {
        fir_design(&prefilter->fir, filter, k);
        prefilter->filter = filter;
        prefilter->k_q16 = k;
    }
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const image_t filtered = {prefilter->pixels, picture->width, picture->height, count, picture->format};
    for (int32_t y = 0; y < picture->height; y++) {
        const int16_t *sums = prefilter_sums(&prefilter->sums, kernels, &prefilter->fir, picture, y);
        kernels->prefilter_row(image_row(&filtered, y), sums, &prefilter->fir, count, channels);
    }
    return filtered;
}
