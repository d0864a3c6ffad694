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
static void sums_of_rows(int16_t *sums[FILTER_ROWS], prefilter_rows_t *memory, const fir_t *fir,
                         const warp_kernels_t *kernels, const image_t *picture, int32_t y)
{
    const int32_t channels = (int32_t)picture->format;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + FILTER_ROWS];
    for (int32_t i = 0; i < 2 * fir->radius + FILTER_ROWS; i++)
        rows[i] = image_row(picture, mirror_index(y - fir->radius + i, picture->height));
    for (int i = 0; i < FILTER_ROWS; i++)
        sums[i] = memory->sums[i] + PREFILTER_MAX_RADIUS * channels;
    kernels->filter_columns(sums, rows, fir, picture->width * channels);
    for (int i = 0; i < FILTER_ROWS; i++)
        mirror_ends(sums[i], picture->width, channels, fir->radius);
}

/* Where a plane begins, in channels: the second one has half of them at most. */
static ptrdiff_t plane_offset(int plane)
{
    return (ptrdiff_t)plane * IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888 / 2;
}

image_t prefilter_pixels(prefilter_t *prefilter, const image_t *picture, int plane)
{
    return (image_t){prefilter->pixels + plane_offset(plane), picture->width, picture->height,
                     picture->width * (int32_t)picture->format, picture->format};
}

void prefilter_make_pixels(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int plane,
                           worker_t worker)
{
    const image_t filtered = prefilter_pixels(prefilter, picture, plane);
    const fir_t *fir = &prefilter->fir;
    const share_t share = share_of(worker, picture->height);
    for (int32_t y = share.begin; y < share.end; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(sums, &prefilter->rows[worker.index], fir, kernels, picture, y);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < share.end; i++)
            kernels->filter_row_bytes(image_row(&filtered, y + i), sums[i], fir, filtered.stride,
                                      (int32_t)picture->format);
    }
}

coefficients_t prefilter_coefficients(prefilter_t *prefilter, const image_t *picture, level_t level)
{
    const ptrdiff_t whole = (ptrdiff_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888;
    const ptrdiff_t offset = level.x == 0 && level.y == 0 ? plane_offset(level.plane) : whole + levels_offset(level);
    return (coefficients_t){prefilter->coefficients + offset, picture->width, picture->height,
                            (int32_t)picture->format};
}

void prefilter_make_coefficients(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                                 level_t level, worker_t worker)
{
    const coefficients_t made = prefilter_coefficients(prefilter, picture, level);
    const int32_t count = made.width * made.channels;
    const fir_t *fir = &prefilter->fir;
    const share_t share = share_of(worker, picture->height);
    for (int32_t y = share.begin; y < share.end; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(sums, &prefilter->rows[worker.index], fir, kernels, picture, y);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < share.end; i++)
            kernels->filter_row(made.data + (ptrdiff_t)(y + i) * count, sums[i], fir, count, made.channels);
    }
}
