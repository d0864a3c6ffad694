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

/* A row of sums continued by mirroring: beyond one width, what is mirrored has been so before. */
static void mirror_ends(int16_t *sums, int32_t width, int32_t channels, int32_t radius)
{
    for (int32_t d = 1; d <= radius; d++) {
        for (int32_t channel = 0; channel < channels; channel++) {
            sums[-d * channels + channel] = sums[(d - 1) * channels + channel];
            sums[(width - 1 + d) * channels + channel] = sums[(width - d) * channels + channel];
        }
    }
}

/* The first pass along rows y and after, of which the picture may have none: sums[i] is the first one of row y + i. */
static void sums_of_rows(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int32_t y,
                         int16_t *sums[FILTER_ROWS])
{
    const fir_t *fir = &prefilter->fir;
    const int32_t channels = (int32_t)picture->format;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + FILTER_ROWS];
    for (int32_t i = 0; i < 2 * fir->radius + FILTER_ROWS; i++)
        rows[i] = image_row(picture, mirror_index(y - fir->radius + i, picture->height));
    for (int i = 0; i < FILTER_ROWS; i++)
        sums[i] = prefilter->sums[i] + PREFILTER_MAX_RADIUS * channels;
    kernels->filter_columns(sums, rows, fir, picture->width * channels);
    for (int i = 0; i < FILTER_ROWS; i++)
        mirror_ends(sums[i], picture->width, channels, fir->radius);
}

image_t prefilter_pixels(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture)
{
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const image_t filtered = {prefilter->pixels, picture->width, picture->height, count, picture->format};
    for (int32_t y = 0; y < picture->height; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(prefilter, kernels, picture, y, sums);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < picture->height; i++)
            kernels->filter_row_bytes(image_row(&filtered, y + i), sums[i], &prefilter->fir, count, channels);
    }
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
    for (int32_t y = 0; y < picture->height; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(prefilter, kernels, picture, y, sums);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < picture->height; i++)
            kernels->filter_row(made.data + (ptrdiff_t)(y + i) * count, sums[i], &prefilter->fir, count, channels);
    }
    prefilter->made[level_x][level_y] = true;
    return made;
}
