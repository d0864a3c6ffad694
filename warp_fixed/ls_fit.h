// SPDX-License-Identifier: Apache-2.0
// Picture -> least-squares spline surface (eq 6, 7 of the paper), in real time: along x, then along y.
#ifndef WARP_FIXED_LS_FIT_H
#define WARP_FIXED_LS_FIT_H

#include <stdint.h>

#include "warp_fixed/chroma_step.h"
#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/ls_axis.h"
#include "warp_fixed/workers.h"

enum { LS_PLANES = 2 };

/** w_i and v_j of eq 7, one per picture column and row; LS_WEIGHT_ONE is an axis' largest. See ls_axis_update(). */
typedef struct {
    uint16_t x[IMAGE_MAX_WIDTH], y[IMAGE_MAX_HEIGHT];
} ls_weights_t;

/** What one worker has to itself. */
typedef struct {
    int32_t largest[LS_PLANES];                           /**< magnitude in its rows of coefficients along x */
    int32_t lane[(LS_MAX_SIZE + LS_TAPS - 1) * LS_LANES]; /**< z, then c, of a strip; three rows of 0 below */
} ls_strip_t;

/** The axes of the last k, and the last surface: about 144 MB, of which a picture touches 4 times its own bytes. */
typedef struct {
    ls_weights_t weights;
    struct {
        ls_axis_t x, y;
    } plane[LS_PLANES];            /**< a picture's only plane is 0 */
    ls_strip_t strip[WORKERS_MAX]; /**< each worker's */
    int32_t coefficients[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT *
                         4]; /**< of rows of pixels, then of both axes; of plane 1, which has half the
                                channels at most, in the second half */
} ls_t;

/** Set every weight to LS_WEIGHT_ONE. */
void ls_weights_init(ls_weights_t *weights);

/** Begin with uniform weights and without axes. */
void ls_init(ls_t *ls);

/** Take other weights, and forget the last axes. */
void ls_set_weights(ls_t *ls, const ls_weights_t *weights);

/**
 * Begin to fit a picture: solve its axes (ls_axis_update()), when k or its size is new. Then all workers fit rows, and
 * when they have, all fit columns.
 *
 * Per channel of a pixel: 17 products of 32 bits along x and 17 / k along y, and 4 / k + 4 / k^2 to solve.
 *
 * Formats: pixels and right-hand sides Q17, coefficients along x Q11, along both Q4, or less where the picture makes
 * them large. No picture makes them overflow; weights that differ by much may, and then they saturate: along x at 2^20
 * levels, along both at 2^31. The proof, and the errors, are in the .c file.
 *
 * @param ls       From ls_init().
 * @param plane    Of a picture with two; else 0.
 * @param picture  Of any size and format (image.h); its size alone matters here.
 * @param whole    The picture that the weights are for: itself, or, for chroma, the luma, whose size is 1 or 2 times
 * the chroma's along each axis. Then it has the weights of every second column or row.
 * @param step     k along x and y, which are equal but for chroma; k <= 1 interpolates; between 1 and 1.25 counts as
 *                 1.25.
 */
void ls_begin(ls_t *ls, int plane, const image_t *picture, const image_t *whole, chroma_step_t step);

/** Fit a worker's rows of the picture, along x. */
void ls_fit_rows(ls_t *ls, const warp_kernels_t *kernels, int plane, const image_t *picture, worker_t worker);

/** Fit a worker's columns of what ls_fit_rows() has made, along y. */
void ls_fit_columns(ls_t *ls, const warp_kernels_t *kernels, int plane, const image_t *picture, worker_t worker);

/** @return A view into `ls` of what all workers have fitted, valid until the next ls_begin() or ls_set_weights(). */
ls_surface_t ls_surface(const ls_t *ls, int plane);

/** All of it for a picture of one plane, by one worker. */
ls_surface_t ls_fit(ls_t *ls, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16);

#endif
