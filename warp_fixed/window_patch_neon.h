// SPDX-License-Identifier: Apache-2.0
// Patches whose windows need no checks: those inside the picture, and copies of its edge continued by mirroring.
#ifndef WARP_FIXED_WINDOW_PATCH_NEON_H
#define WARP_FIXED_WINDOW_PATCH_NEON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "warp_fixed/kernels.h"
#include "warp_fixed/neon.h"

enum { PATCH_STEP = 4 };

/** A picture, or its coefficients, as bytes. */
typedef struct {
    const uint8_t *data;
    int32_t width, height;
    ptrdiff_t stride; /**< bytes from row to row; height times it fits 31 bits */
    int32_t texel_bytes;
} texels_t;

/** All that a loop has to know to find windows: a point plus its start, Q18, is where the window begins in data. */
typedef struct {
    const uint8_t *data;
    int32_t stride;
    int32_t x_start_q18, y_start_q18;
} window_source_t;

/** Four windows. Rows of weights are in weights, counted from the begin of the table. */
typedef struct {
    uint32_t texel[PATCH_STEP]; /**< bytes from the source's first */
    uint32_t row_x[PATCH_STEP], row_y[PATCH_STEP];
} window_step_t;

/**
 * Weigh the windows of a patch of at least PATCH_STEP pixels a row, all of them inside the source.
 *
 * Pixels may be written more than once.
 */
typedef void weigh_patch_fn(const patch_t *patch, const window_t *window, const window_source_t *source);

/**
 * Weigh a patch whose windows may leave the picture, at level 0.
 *
 * @param taps_x, taps_y  Texels that `weigh` reads from a window's begin on.
 * @param pixel_bytes     Of what it writes.
 */
void weigh_anywhere(const patch_t *patch, const window_t *window, const texels_t *texels, const int32_t taps[2],
                    int32_t pixel_bytes, weigh_patch_fn *weigh);

/** Whether the points of a patch of at least one pixel need no clamping. */
bool points_inside(const patch_t *patch, int32_t width, int32_t height);

/** The windows of four points; rows of weights have WINDOW_SHORT_TAPS entries. */
static inline window_step_t window_step(const window_source_t *source, const int32_t *x_q18, const int32_t *y_q18,
                                        int texel_log2)
{
    enum { TO_ROW = GRID_FRACTION_BITS - PHASE_BITS - 3, ROWS = (PHASES - 1) * WINDOW_SHORT_TAPS };
    const int32x4_t x = vaddq_s32(vld1q_s32(x_q18), vdupq_n_s32(source->x_start_q18));
    const int32x4_t y = vaddq_s32(vld1q_s32(y_q18), vdupq_n_s32(source->y_start_q18));
    const int32x4_t column = vshlq_s32(vshrq_n_s32(x, GRID_FRACTION_BITS), vdupq_n_s32(texel_log2));
    const int32x4_t texel = vmlaq_n_s32(column, vshrq_n_s32(y, GRID_FRACTION_BITS), source->stride);
    window_step_t step;
    vst1q_u32(step.texel, vreinterpretq_u32_s32(texel));
    vst1q_u32(step.row_x, vandq_u32(vreinterpretq_u32_s32(vshrq_n_s32(x, TO_ROW)), vdupq_n_u32(ROWS)));
    vst1q_u32(step.row_y, vandq_u32(vreinterpretq_u32_s32(vshrq_n_s32(y, TO_ROW)), vdupq_n_u32(ROWS)));
    return step;
}

/** Whether offsets in a picture fit 32 bits; no picture without huge gaps between its rows is larger. */
static inline bool offsets_fit(ptrdiff_t stride, int32_t rows)
{
    return (int64_t)stride * rows <= INT32_MAX;
}

/** @return Where step k of a row of `width` pixels begins: the last one may overlap the one before. */
static inline int32_t step_begin(int32_t k, int32_t width)
{
    return k + PATCH_STEP <= width ? k : width - PATCH_STEP;
}

#endif
