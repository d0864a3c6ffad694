// SPDX-License-Identifier: Apache-2.0
// The low-pass filter before resampling: separable, its cut-off 1 / (2 k) from the step k.
#ifndef WARP_FIXED_PREFILTER_H
#define WARP_FIXED_PREFILTER_H

#include <stdint.h>

#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"

enum { PREFILTER_MAX_K_Q16 = 64 << 16 };

/** The filter of the last k, and the filtered picture. */
typedef struct {
    int32_t k_q16; /**< that fir was designed for; 0 at first */
    fir_t fir;
    int16_t sums[(IMAGE_MAX_WIDTH + 2 * PREFILTER_MAX_RADIUS) * 4]; /**< first pass of one row, with mirrored ends */
    uint8_t pixels[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4];
} prefilter_t;

/**
 * Design the sampled Gaussian of -3 dB at 1 / (2 k) cycles per pixel: sigma = k sqrt(ln 2) / pi, cut at 4 sigma.
 *
 * Integers only, so the same taps everywhere: weight n is 2^-(c n^2 / k^2) with c = pi^2 / (2 ln(2)^2), rounded, and
 * the middle one makes the sum exact.
 *
 * @param k_q16  Q16, above 1 and up to PREFILTER_MAX_K_Q16.
 */
void prefilter_gauss(fir_t *fir, int32_t k_q16);

/** Forget the last filter. */
void prefilter_init(prefilter_t *prefilter);

/**
 * Low-pass the picture with the Gaussian for k, with half-sample mirror borders.
 *
 * @param k_q16  Q16; k <= 1 bypasses the filter; larger than PREFILTER_MAX_K_Q16 counts as that.
 * @return A view into `prefilter`, or *picture itself when bypassed. 2 (2 radius + 1) products per byte.
 */
image_t prefilter_picture(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16);

#endif
