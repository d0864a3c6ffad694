// SPDX-License-Identifier: Apache-2.0
// The low-pass filter before resampling: separable, its cut-off 1 / (2 k) from the step k.
#ifndef WARP_FIXED_PREFILTER_H
#define WARP_FIXED_PREFILTER_H

#include <stdint.h>

#include "warp_fixed/fir_design.h"
#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"

/** First pass of one row, with mirrored ends. */
typedef struct {
    int16_t v[(IMAGE_MAX_WIDTH + 2 * PREFILTER_MAX_RADIUS) * 4];
} prefilter_sums_t;

/**
 * Run the first pass along row y, and continue it by half-sample mirroring.
 *
 * @return The row's first sum within `sums`; radius pixels before and after the row are there too.
 */
const int16_t *prefilter_sums(prefilter_sums_t *sums, const warp_kernels_t *kernels, const fir_t *fir,
                              const image_t *picture, int32_t y);

/** The filter of the last k, and the filtered picture. */
typedef struct {
    warp_filter_t filter; /**< that fir is; WARP_FILTER_NONE at first */
    int32_t k_q16;        /**< that fir was designed for */
    fir_t fir;
    prefilter_sums_t sums;
    uint8_t pixels[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4];
} prefilter_t;

/** Forget the last filter. */
void prefilter_init(prefilter_t *prefilter);

/**
 * Low-pass the picture for a step k, with half-sample mirror borders.
 *
 * @param filter  WARP_FILTER_NONE bypasses.
 * @param k_q16   Q16; k <= 1 bypasses the filter; larger than FIR_MAX_K_Q16 counts as that.
 * @return A view into `prefilter`, or *picture itself when bypassed. 2 (2 radius + 1) products per byte.
 */
image_t prefilter_picture(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                          warp_filter_t filter, int32_t k_q16);

#endif
