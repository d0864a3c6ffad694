// SPDX-License-Identifier: Apache-2.0
// The filter before resampling: a low-pass for the step k, with or without B-spline coefficients of what it makes.
#include "warp_fixed/prefilter.h"

#include "warp_fixed/fixed.h"

void prefilter_init(prefilter_t *prefilter)
{
    prefilter->kind = (prefilter_kind_t){WARP_FILTER_NONE, 0, false};
}

bool prefilter_begin(prefilter_t *prefilter, warp_filter_t filter, int32_t k_q16, bool splines)
{
    prefilter_kind_t kind = {filter, k_q16 < FIR_MAX_K_Q16 ? k_q16 : FIR_MAX_K_Q16, splines};
    if (filter == WARP_FILTER_NONE || k_q16 <= 1 << 16)
        kind = (prefilter_kind_t){WARP_FILTER_NONE, 0, splines};
    for (int level_x = 0; level_x < LEVELS; level_x++)
        for (int level_y = 0; level_y < LEVELS; level_y++)
            prefilter->made[level_x][level_y] = false;
    const prefilter_kind_t *last = &prefilter->kind;
    if (kind.filter != last->filter || kind.k_q16 != last->k_q16 || kind.splines != last->splines) {
        fir_design(&prefilter->fir, kind.filter, kind.k_q16, splines);
        prefilter->kind = kind;
    }
    return splines || kind.filter != WARP_FILTER_NONE;
}

/* The first pass along row y, continued by mirroring. @return the row's first sum. */
static const int16_t *sums_of_row(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                                  int32_t y)
{
    const fir_t *fir = &prefilter->fir;
    const int32_t channels = (int32_t)picture->format, width = picture->width;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + 1];
    for (int32_t d = -fir->radius; d <= fir->radius; d++)
        rows[d + fir->radius] = image_row(picture, mirror_index(y + d, picture->height));
    int16_t *middle = prefilter->sums + PREFILTER_MAX_RADIUS * channels;
    kernels->filter_columns(middle, rows, fir, width * channels);
    for (int32_t d = 1; d <= fir->radius; d++) {
        for (int32_t channel = 0; channel < channels; channel++) {
            middle[-d * channels + channel] = middle[mirror_index(-d, width) * channels + channel];
            middle[(width - 1 + d) * channels + channel] =
                middle[mirror_index(width - 1 + d, width) * channels + channel];
        }
    }
    return middle;
}

image_t prefilter_pixels(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture)
{
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const image_t filtered = {prefilter->pixels, picture->width, picture->height, count, picture->format};
    for (int32_t y = 0; y < picture->height; y++)
        kernels->filter_row_bytes(image_row(&filtered, y), sums_of_row(prefilter, kernels, picture, y), &prefilter->fir,
                                  count, channels);
    return filtered;
}

coefficients_t prefilter_coefficients(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                                      int level_x, int level_y)
{
    const ptrdiff_t whole = (ptrdiff_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888;
    const ptrdiff_t offset = level_x == 0 && level_y == 0 ? 0 : whole + levels_offset(level_x, level_y);
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const coefficients_t made = {prefilter->coefficients + offset, picture->width, picture->height, channels};
    if (prefilter->made[level_x][level_y])
        return made;
    for (int32_t y = 0; y < picture->height; y++)
        kernels->filter_row(made.data + (ptrdiff_t)y * count, sums_of_row(prefilter, kernels, picture, y),
                            &prefilter->fir, count, channels);
    prefilter->made[level_x][level_y] = true;
    return made;
}
