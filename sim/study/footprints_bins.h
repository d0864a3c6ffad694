// SPDX-License-Identifier: Apache-2.0
// The error of a panel, summed up by how large its pixels are in the viewer's picture.
#ifndef SIM_STUDY_FOOTPRINTS_BINS_H
#define SIM_STUDY_FOOTPRINTS_BINS_H

#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "sim/eval/mesh_psnr.h"
#include "warp_fixed/image.h"

enum { FOOTPRINTS_BINS = 28 };

/** Projector pixels whose footprints are about as large. */
typedef struct {
    int64_t pixels, samples; /**< that show picture; of the truth within them */
    double error;            /**< sum over samples of (truth - shown)^2, less what no value could avoid */
} footprints_bin_t;

/** @return The smallest area of a bin, square picture pixels: 2^(-6 + bin / 2). Bins at the ends take the rest. */
double footprints_bin_area(int bin);

/** @return Area of the panel pixel at (i, j) in the picture, |det J| at its centre, square picture pixels. */
double footprints_area(const double_homography_t *homography, int32_t i, int32_t j);

/**
 * Fill the bins with what a panel shows.
 *
 * The error within a projector pixel is that of its one value against the mean of the truth there, count times their
 * difference squared. All bins together are the panel's squared error less that of the exact, not rounded, means.
 */
void footprints_bins(footprints_bin_t bin[FOOTPRINTS_BINS], const mesh_t *mesh, const double_homography_t *homography,
                     const image_t *panel);

/** @return The sum of the bins whose smallest area is in [from, to). */
footprints_bin_t footprints_bins_sum(const footprints_bin_t bin[FOOTPRINTS_BINS], double from, double to);

#endif
