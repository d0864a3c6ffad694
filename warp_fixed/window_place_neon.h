// SPDX-License-Identifier: Apache-2.0
// Windows of any length, placed four at a time: where they lie, and whether all of them are within the picture.
#ifndef WARP_FIXED_WINDOW_PLACE_NEON_H
#define WARP_FIXED_WINDOW_PLACE_NEON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/neon.h"

enum { PLACE_STEP = 4 };

/** One axis of a call's windows. */
typedef struct {
    int32x4_t size, level_shift; /**< the point is clamped to size, then shifted left by level_shift */
    int32x4_t lead, room;        /**< a window is inside where 0 <= begin <= room */
} placer_axis_t;

/** What the places of one call share. */
typedef struct {
    placer_axis_t x, y;
    int32x4_t stride, channels;
} placer_t;

/** Four windows, all of them inside. Offsets are in elements (bytes or coefficients) from the picture's first. */
typedef struct {
    int32_t texel[PLACE_STEP]; /**< offset of the first */
    int32_t row_x[PLACE_STEP], row_y[PLACE_STEP];
} places_t;

/** @param taps  Texels that the caller reads; at least axis->taps. @param texels  Of the level. */
static inline placer_axis_t placer_axis(const window_axis_t *axis, int32_t size, int level, int32_t taps,
                                        int32_t texels)
{
    return (placer_axis_t){vdupq_n_s32(size << GRID_FRACTION_BITS), vdupq_n_s32(-3 * level),
                           vdupq_n_s32(axis->lead - PHASES / 2), vdupq_n_s32(texels - taps)};
}

/** @param taps_x  Texels of a row that the caller reads from a window's begin on; at least window->x.taps. */
static inline placer_t placer_of(const window_t *window, int32_t taps_x, ptrdiff_t stride)
{
    return (placer_t){
        placer_axis(&window->x, window->width, window->level_x, taps_x, window->picture.width),
        placer_axis(&window->y, window->height, window->level_y, window->y.taps, window->picture.height),
        vdupq_n_s32((int32_t)stride),
        vdupq_n_s32((int32_t)window->picture.format),
    };
}

/** Where the window begins, in 1/128 texel: see window_place(). */
static inline int32x4_t from_begin(const placer_axis_t *axis, const int32_t *point_q18)
{
    const int32x4_t clamped = vminq_s32(vmaxq_s32(vld1q_s32(point_q18), vdupq_n_s32(0)), axis->size);
    const int32x4_t scaled = vshlq_s32(clamped, axis->level_shift);
    return vaddq_s32(vrshrq_n_s32(scaled, GRID_FRACTION_BITS - PHASE_BITS), axis->lead);
}

/** Never negative where the window is inside. */
static inline int32x4_t inside(const placer_axis_t *axis, int32x4_t begin)
{
    return vminq_s32(begin, vsubq_s32(axis->room, begin));
}

/** @return false when a window may leave the picture; *places is then not to be used. */
static inline bool find_places(places_t *places, const placer_t *placer, const int32_t *x_q18, const int32_t *y_q18)
{
    const int32x4_t x = from_begin(&placer->x, x_q18), y = from_begin(&placer->y, y_q18);
    const int32x4_t u = vshrq_n_s32(x, PHASE_BITS), v = vshrq_n_s32(y, PHASE_BITS);
    const int32x4_t mask = vdupq_n_s32(PHASES - 1);
    vst1q_s32(places->texel, vmlaq_s32(vmulq_s32(u, placer->channels), v, placer->stride));
    vst1q_s32(places->row_x, vandq_s32(x, mask));
    vst1q_s32(places->row_y, vandq_s32(y, mask));
    return vminvq_s32(vminq_s32(inside(&placer->x, u), inside(&placer->y, v))) >= 0;
}

/** Weigh the window of one pixel: `texel` as in places_t, and the rows of its weights. */
typedef void weigh_placed_fn(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first,
                             const int16_t *second);

/** How a loop that places its windows four at a time reads and writes. */
typedef struct {
    weigh_placed_fn *weigh;
    resample_window_fn *scalar; /**< for windows that leave the picture, and what is left over at the end of a row */
    ptrdiff_t stride;           /**< elements from row to row */
    int32_t taps_x;             /**< texels of a row that `weigh` reads from a window's begin on */
    int32_t pixel_bytes;        /**< of what it writes */
} placed_loop_t;

static inline void weigh_placed(const patch_t *patch, const window_t *window, const placed_loop_t *loop)
{
    const placer_t placer = placer_of(window, loop->taps_x, loop->stride);
    for (int32_t r = 0; r < patch->height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (int32_t k = 0; k < patch->width; k += PLACE_STEP) {
            const int32_t left = patch->width - k, count = left < PLACE_STEP ? left : PLACE_STEP;
            const patch_t few = {out + k * loop->pixel_bytes, 0, x_q18 + k, y_q18 + k, count, 1};
            places_t places;
            if (count < PLACE_STEP || !find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
                loop->scalar(&few, window);
                continue;
            }
            for (int i = 0; i < PLACE_STEP; i++)
                loop->weigh(few.out + i * loop->pixel_bytes, window, places.texel[i],
                            window->y.first + places.row_y[i] * window->y.row,
                            window->x.second + places.row_x[i] * window->x.row);
        }
    }
}

#endif
