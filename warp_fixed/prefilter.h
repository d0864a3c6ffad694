// SPDX-License-Identifier: Apache-2.0
// The filter before resampling: a low-pass for the step k, with or without B-spline coefficients of what it makes.
#ifndef WARP_FIXED_PREFILTER_H
#define WARP_FIXED_PREFILTER_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/chroma_step.h"
#include "warp_fixed/fir_design.h"
#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/levels.h"

/** What a filter is designed for. */
typedef struct {
    warp_filter_t filter;
    int32_t k_q16; /**< 0 for WARP_FILTER_NONE */
    bool splines;
} prefilter_kind_t;

typedef struct {
    prefilter_kind_t kind;
    fir_t fir;
} prefilter_design_t;

enum { PREFILTER_DESIGNS = 3 };

/** The first pass of rows, with mirrored ends. */
typedef struct {
    int16_t sums[FILTER_ROWS][(IMAGE_MAX_WIDTH + 2 * PREFILTER_MAX_RADIUS) * 4];
} prefilter_rows_t;

/** The last filters, and what they have made of this frame's picture: 93 MB, touched as far as a picture needs them. */
typedef struct {
    prefilter_design_t design[PREFILTER_DESIGNS]; /**< of a picture or its luma; of its chroma along x, along y */
    prefilter_rows_t rows[WORKERS_MAX];           /**< each worker's */
    union {
        uint8_t pixels[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4];
        int16_t coefficients[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4 + LEVELS_BYTES]; /**< the picture's, its levels' */
    };
} prefilter_t;

/** Forget the last filters. */
void prefilter_init(prefilter_t *prefilter);

/**
 * Begin a frame: have the filter of its step.
 *
 * @param k_q16    Q16; k <= 1 bypasses the low-pass; larger than FIR_MAX_K_Q16 counts as that.
 * @param splines  Coefficients of the cubic B-spline are wanted.
 * @return false when nothing is to be filtered: resample the picture itself.
 */
bool prefilter_begin(prefilter_t *prefilter, warp_filter_t filter, int32_t k_q16, bool splines);

/** The same for the chroma of the picture, plane 1, with a step for each axis. After prefilter_begin(). */
bool prefilter_begin_chroma(prefilter_t *prefilter, warp_filter_t filter, chroma_step_t step, bool splines);

/** @return A view into `prefilter`, of the filtered picture as prefilter_make_pixels() writes it: a picture's only
 * plane is 0. */
image_t prefilter_pixels(prefilter_t *prefilter, const image_t *picture, int plane);

/** Filter a worker's rows, with half-sample mirror borders. 2 (2 radius + 1) products per byte. */
void prefilter_make_pixels(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int plane,
                           worker_t worker);

/**
 * @param picture  The picture at that level (levels.h).
 * @return A view into `prefilter`, of the coefficients as prefilter_make_coefficients() writes them. Those of each
 *         level have their own place; pixels share it with them.
 */
coefficients_t prefilter_coefficients(prefilter_t *prefilter, const image_t *picture, level_t level);

/** Filter a worker's rows of the picture at a level to coefficients. */
void prefilter_make_coefficients(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                                 level_t level, worker_t worker);

#endif
