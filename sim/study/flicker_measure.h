// SPDX-License-Identifier: Apache-2.0
// How steady and how sharp a moving viewer sees a picture that should stand still.
#ifndef SIM_STUDY_FLICKER_MEASURE_H
#define SIM_STUDY_FLICKER_MEASURE_H

#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "warp_fixed/image.h"

/**
 * Keep only the picture pixels that the wall covers.
 *
 * @param[in,out] mask    A byte for each pixel of the picture, row by row; set to 0 unless the pixel, widened by the
 *                        margin on all sides, lies in the picture and on the wall's lit rectangle.
 * @param         margin  Picture pixels, 0 or more.
 */
void flicker_mask(uint8_t *mask, const double_homography_t *homography, double margin);

/** Sums over pixels and frames, all 0 at the beginning. */
typedef struct {
    int64_t change; /**< of the gray levels, without sign */
    int64_t pixels;
    int64_t seen;  /**< gradient of the seen picture times that of the ideal one */
    int64_t ideal; /**< squared gradient of the ideal one */
} flicker_sums_t;

/** Add the change of the seen picture from one frame to the next. GRAY8, all of one size. */
void flicker_add_change(flicker_sums_t *sums, const image_t *before, const image_t *after, const uint8_t *mask);

/** Add what the seen picture keeps of the ideal one's gradient: differences of neighbours both in the mask. */
void flicker_add_sharpness(flicker_sums_t *sums, const image_t *seen, const image_t *ideal, const uint8_t *mask);

/** @return Mean absolute change, gray levels; NaN when nothing was added. */
double flicker_level(const flicker_sums_t *sums);

/**
 * @return The part of the ideal gradient that is seen: the regression coefficient of the seen gradient on the ideal
 *         one. 1 is perfect, less is blurred, more is over-sharpened. What does not follow the ideal picture (noise,
 *         aliases, edges of pixels) adds nothing to it. NaN when nothing was added.
 */
double flicker_sharpness(const flicker_sums_t *sums);

#endif
