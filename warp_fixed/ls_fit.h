// SPDX-License-Identifier: Apache-2.0
// Picture -> least-squares spline surface (eq 6, 7 of the paper), in real time: along x, then along y.
#ifndef WARP_FIXED_LS_FIT_H
#define WARP_FIXED_LS_FIT_H

#include <stdint.h>

#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/ls_axis.h"

/** w_i and v_j of eq 7, one per picture column and row; LS_WEIGHT_ONE is an axis' largest. See ls_axis_update(). */
typedef struct {
    uint16_t x[IMAGE_MAX_WIDTH], y[IMAGE_MAX_HEIGHT];
} ls_weights_t;

/** The axes of the last k, and the last surface: about 142 MB, of which a picture touches 4 times its own bytes. */
typedef struct {
    ls_weights_t weights;
    ls_axis_t x, y;
    int32_t strip[(LS_MAX_SIZE + LS_TAPS - 1) * LS_LANES];        /**< z, then c, of a strip; three rows of 0 below */
    int32_t coefficients[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4]; /**< of rows of pixels, then of both axes */
} ls_t;

/** Set every weight to LS_WEIGHT_ONE. */
void ls_weights_init(ls_weights_t *weights);

/** Begin with uniform weights and without axes. */
void ls_init(ls_t *ls);

/** Take other weights, and forget the last axes. */
void ls_set_weights(ls_t *ls, const ls_weights_t *weights);

/**
 * Fit a picture.
 *
 * Per channel of a pixel: 17 products of 32 bits along x and 17 / k along y, and 4 / k + 4 / k^2 to solve; for a new k
 * the axes' solution besides (ls_axis_update()).
 *
 * Formats: pixels and right-hand sides Q17, coefficients along x Q11, along both Q4, or less where the picture makes
 * them large. No picture makes them overflow; weights that differ by much may, and then they saturate: along x at 2^20
 * levels, along both at 2^31. The proof, and the errors, are in the .c file.
 *
 * @param ls       From ls_init().
 * @param picture  Of any size and format (image.h).
 * @param k_q16    k <= 1 interpolates; between 1 and 1.25 counts as 1.25.
 * @return A view into `ls`, valid until the next call or ls_set_weights().
 */
ls_surface_t ls_fit(ls_t *ls, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16);

#endif
