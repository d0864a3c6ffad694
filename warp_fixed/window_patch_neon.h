// SPDX-License-Identifier: Apache-2.0
// Patches whose windows need no checks: those inside the picture, and copies of its edge continued by mirroring.
//
// Loops with negative weights read copies only, whose bytes are less 128, as signed ones: the copy costs some two
// instructions a pixel, and saves one for each vector of texels and the addresses of all rows but the first. Linear
// interpolation of gray pixels reads copies too, of pairs (resample_linear_neon.c). In these a row has its bytes and
// those of the next one in turn. Each row begins a pair; or every other one, for windows of an odd number of rows that
// read one more, be it the one before.
#ifndef WARP_FIXED_WINDOW_PATCH_NEON_H
#define WARP_FIXED_WINDOW_PATCH_NEON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "warp_fixed/kernels.h"
#include "warp_fixed/neon.h"

enum {
    PATCH_STEP = 4,
    PATCH_MAX_STEP = 8,
    COPY_STRIDE = 13 * 64 /**< an odd number of cache lines: rows that follow one another do not share sets */
};

/** A picture, or its coefficients, as bytes. */
typedef struct {
    const uint8_t *data;
    int32_t width, height;
    ptrdiff_t stride;    /**< bytes from row to row; height times it fits 31 bits */
    int32_t texel_bytes; /**< 1, 2, 4 or 8 */
} texels_t;

/** All that a loop has to know to find windows: a point plus its start, Q18, is where the window begins in data. */
typedef struct {
    const uint8_t *data;
    int32_t stride;
    int32_t x_start_q18, y_start_q18;
} window_source_t;

/** Where four windows and their weights begin; rows of weights have WINDOW_SHORT_TAPS entries. */
typedef struct {
    uint32_t texel[PATCH_STEP]; /**< bytes from the source's first */
    uint32_t row_x[PATCH_STEP]; /**< bytes from row 0 of the second pass */
    uint32_t row_y[PATCH_STEP]; /**< entries from row 0 of the first pass: bytes in first_bytes */
} window_step_t;

/** Weigh the windows of a patch, all of them inside the source. Its width is a multiple of the loop's step. */
typedef void weigh_patch_fn(const patch_t *patch, const window_t *window, const window_source_t *source);

/** How a loop reads and writes. */
typedef struct {
    weigh_patch_fn *weigh;
    int32_t taps_x, taps_y; /**< texels that it reads from a window's begin on */
    int32_t pixel_bytes;    /**< that it writes for a pixel */
    int32_t step;           /**< pixels that it makes at once; PATCH_MAX_STEP at most */
    bool centred;           /**< it reads bytes less 128, and a source's stride is COPY_STRIDE */
    int32_t pair_step;      /**< 0, or it reads pairs: of each row and the next (1), or of every other one (2), at
                                 floor(row / pair_step) COPY_STRIDE; texels are twice as long, and less than 512 */
} patch_loop_t;

/** @return Is it at most WINDOW_SHORT_TAPS long along both axes, and so at level 0? */
static inline bool window_is_short(const window_t *window)
{
    return window->x.taps <= WINDOW_SHORT_TAPS && window->y.taps <= WINDOW_SHORT_TAPS;
}

/** Weigh a patch whose short windows may leave the picture. */
void weigh_anywhere(const patch_t *patch, const window_t *window, const texels_t *texels, const patch_loop_t *loop);

/** Whether the points of a patch of at least one pixel need no clamping. */
bool points_inside(const patch_t *patch, int32_t width, int32_t height);

/** Where four windows begin: bytes from the source's first, and in texels with a fraction whose upper bits are phases.
 */
typedef struct {
    uint32x4_t texel;
    uint32x4_t x_q18, y_q18;
} window_begins_t;

static inline window_begins_t window_begins(const window_source_t *source, const int32_t *x_q18, const int32_t *y_q18,
                                            int texel_log2)
{
    const int32x4_t x = vaddq_s32(vld1q_s32(x_q18), vdupq_n_s32(source->x_start_q18));
    const int32x4_t y = vaddq_s32(vld1q_s32(y_q18), vdupq_n_s32(source->y_start_q18));
    const int32x4_t column = vshlq_s32(vshrq_n_s32(x, GRID_FRACTION_BITS), vdupq_n_s32(texel_log2));
    const int32x4_t texel = vmlaq_n_s32(column, vshrq_n_s32(y, GRID_FRACTION_BITS), source->stride);
    return (window_begins_t){vreinterpretq_u32_s32(texel), vreinterpretq_u32_s32(x), vreinterpretq_u32_s32(y)};
}

/** The windows of four points. */
static inline window_step_t window_step(const window_source_t *source, const int32_t *x_q18, const int32_t *y_q18,
                                        int texel_log2)
{
    enum { TO_ROW = GRID_FRACTION_BITS - PHASE_BITS - 3, ROWS = (PHASES - 1) * WINDOW_SHORT_TAPS };
    const window_begins_t begins = window_begins(source, x_q18, y_q18, texel_log2);
    window_step_t step;
    store_numbers(step.texel, begins.texel);
    store_numbers(step.row_x, vandq_u32(vshrq_n_u32(begins.x_q18, TO_ROW - 1), vdupq_n_u32(2 * ROWS)));
    store_numbers(step.row_y, vandq_u32(vshrq_n_u32(begins.y_q18, TO_ROW), vdupq_n_u32(ROWS)));
    return step;
}

/** Whether offsets in a picture fit 32 bits; no picture without huge gaps between its rows is larger. */
static inline bool offsets_fit(ptrdiff_t stride, int32_t rows)
{
    return (int64_t)stride * rows <= INT32_MAX;
}

#endif
