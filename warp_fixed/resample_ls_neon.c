// SPDX-License-Identifier: Apache-2.0
// The least-squares surface at each point, four points at a time.
//
// No mean leaves the range of its terms, so sums fit 32 bits again as soon as the weights' bits are shifted out.
#include <stdbool.h>
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/window_patch_neon.h"

enum { ROWS = LS_EDGE_PHASES + PHASES /* of weights, from either end */ };

/* What the points of a patch share along one axis. */
typedef struct {
    int32x4_t size, factor, phases, edge, middle, last;
    const int32_t *weight;
} ls_placer_t;

static inline ls_placer_t placer_of(const ls_axis_t *axis)
{
    return (ls_placer_t){
        vdupq_n_s32(axis->knots.size << GRID_FRACTION_BITS),
        vdupq_n_s32(axis->phase_factor),
        vdupq_n_s32(axis->phases),
        vdupq_n_s32(axis->edge_phases),
        vdupq_n_s32(axis->middle_phase),
        vdupq_n_s32(axis->coefficients - LS_TAPS),
        &axis->weight[0][0][0],
    };
}

/* Along one axis, of PATCH_STEP points: their first coefficients, and where in the table their weights begin. */
typedef struct {
    int32x4_t first, weight;
} ls_places_t;

/* As ls_axis_taps(). */
NEON_INLINE ls_places_t places_of(const ls_placer_t *axis, const int32_t *x_q18)
{
    const int32x4_t zero = vdupq_n_s32(0), x = vminq_s32(vmaxq_s32(vld1q_s32(x_q18), zero), axis->size);
    const int32x4_t low = vreinterpretq_s32_s64(vmull_s32(vget_low_s32(x), vget_low_s32(axis->factor)));
    const int32x4_t high = vreinterpretq_s32_s64(vmull_high_s32(x, axis->factor));
    const int32x4_t phase = vrshrq_n_s32(vuzp2q_s32(low, high), GRID_FRACTION_BITS + LS_FACTOR_BITS - 32);

    const int32x4_t other = vsubq_s32(axis->phases, phase), from_end = vminq_s32(phase, other);
    const uint32x4_t mirrored = vcgtq_s32(phase, other);
    const int32x4_t from_middle = vsubq_s32(from_end, axis->middle);
    const int32x4_t repeated = vaddq_s32(vandq_s32(from_middle, vdupq_n_s32(PHASES - 1)), axis->edge);
    const int32x4_t row = vbslq_s32(vcltq_s32(from_end, axis->edge), from_end, repeated);
    const int32x4_t of_end = vandq_s32(vreinterpretq_s32_u32(mirrored), vdupq_n_s32(ROWS));
    const int32x4_t piece = vmaxq_s32(vshrq_n_s32(from_middle, PHASE_BITS), zero);
    return (ls_places_t){
        vbslq_s32(mirrored, vsubq_s32(axis->last, piece), piece),
        vshlq_n_s32(vaddq_s32(row, of_end), 2),
    };
}

/* 64-bit sums of four values. */
typedef struct {
    int64x2_t low, high;
} sums_t;

/* No functions, for intrinsics want lanes that are constants. */
#define PRODUCTS(values, weights, lane)                                                                                \
    ((sums_t){vmull_lane_s32(vget_low_s32(values), weights, lane),                                                     \
              vmull_lane_s32(vget_high_s32(values), weights, lane)})
#define ADD_PRODUCTS(sums, values, weights, lane)                                                                      \
    ((sums_t){vmlal_lane_s32((sums).low, vget_low_s32(values), weights, lane),                                         \
              vmlal_lane_s32((sums).high, vget_high_s32(values), weights, lane)})

NEON_INLINE sums_t weighed(int32x4_t a, int32x4_t b, int32x4_t c, int32x4_t d, int32x4_t weights)
{
    const int32x2_t left = vget_low_s32(weights), right = vget_high_s32(weights);
    sums_t sums = PRODUCTS(a, left, 0);
    sums = ADD_PRODUCTS(sums, b, left, 1);
    sums = ADD_PRODUCTS(sums, c, right, 0);
    return ADD_PRODUCTS(sums, d, right, 1);
}

/* Four channels of a row's mean. */
NEON_INLINE int32x4_t row_xrgb(const int32_t *at, int32x4_t weights)
{
    const sums_t sums = weighed(vld1q_s32(at), vld1q_s32(at + 4), vld1q_s32(at + 8), vld1q_s32(at + 12), weights);
    return vcombine_s32(vrshrn_n_s64(sums.low, LS_WEIGHT_BITS), vrshrn_n_s64(sums.high, LS_WEIGHT_BITS));
}

/* What each mean is, rounded down. */
NEON_INLINE int32x4_t evaluate_xrgb(const int32_t *at, ptrdiff_t stride, int32x4_t across, int32x4_t down)
{
    const sums_t sums = weighed(row_xrgb(at, across), row_xrgb(at + stride, across), row_xrgb(at + 2 * stride, across),
                                row_xrgb(at + 3 * stride, across), down);
    return vcombine_s32(vshrn_n_s64(sums.low, LS_WEIGHT_BITS), vshrn_n_s64(sums.high, LS_WEIGHT_BITS));
}

/* U and V of four texels, weighed. */
NEON_INLINE int32x2_t row_chroma(const int32_t *at, int32x4_t weights)
{
    const int32x2_t left = vget_low_s32(weights), right = vget_high_s32(weights);
    int64x2_t sums = vmull_lane_s32(vld1_s32(at), left, 0);
    sums = vmlal_lane_s32(sums, vld1_s32(at + 2), left, 1);
    sums = vmlal_lane_s32(sums, vld1_s32(at + 4), right, 0);
    sums = vmlal_lane_s32(sums, vld1_s32(at + 6), right, 1);
    return vrshrn_n_s64(sums, LS_WEIGHT_BITS);
}

/* What both means are, rounded down. */
NEON_INLINE int32x2_t evaluate_chroma(const int32_t *at, ptrdiff_t stride, int32x4_t across, int32x4_t down)
{
    const int32x2_t upper = vget_low_s32(down), lower = vget_high_s32(down);
    int64x2_t sums = vmull_lane_s32(row_chroma(at, across), upper, 0);
    sums = vmlal_lane_s32(sums, row_chroma(at + stride, across), upper, 1);
    sums = vmlal_lane_s32(sums, row_chroma(at + 2 * stride, across), lower, 0);
    sums = vmlal_lane_s32(sums, row_chroma(at + 3 * stride, across), lower, 1);
    return vshrn_n_s64(sums, LS_WEIGHT_BITS);
}

/* Two sums to be added up. */
NEON_INLINE int64x2_t weighed_gray(int32x4_t values, int32x4_t weights)
{
    return vmlal_high_s32(vmull_s32(vget_low_s32(values), vget_low_s32(weights)), values, weights);
}

NEON_INLINE int32x2_t two_rows_gray(const int32_t *at, ptrdiff_t stride, int32x4_t weights)
{
    const int64x2_t sums =
        vpaddq_s64(weighed_gray(vld1q_s32(at), weights), weighed_gray(vld1q_s32(at + stride), weights));
    return vrshrn_n_s64(sums, LS_WEIGHT_BITS);
}

NEON_INLINE int64x2_t evaluate_gray(const int32_t *at, ptrdiff_t stride, int32x4_t across, int32x4_t down)
{
    return weighed_gray(vcombine_s32(two_rows_gray(at, stride, across), two_rows_gray(at + 2 * stride, stride, across)),
                        down);
}

/* Means with fraction_bits, of which there are some, on their way to bytes. */
NEON_INLINE uint16x4_t sixteen_bits(int32x4_t means, int32x4_t shift)
{
    return vqmovun_s32(vrshlq_s32(means, shift));
}

/* All that a step reads. */
typedef struct {
    ls_placer_t x, y;
    const int32_t *coefficients;
    ptrdiff_t stride;
    int32x4_t shift;
} ls_source_t;

/* Where the coefficients and weights of PATCH_STEP points begin. */
typedef struct {
    uint32_t corner[PATCH_STEP], across[PATCH_STEP], down[PATCH_STEP];
} ls_step_t;

NEON_INLINE ls_step_t step_of(const ls_source_t *from, const int32_t *x_q18, const int32_t *y_q18, int32_t channels)
{
    const ls_places_t x = places_of(&from->x, x_q18), y = places_of(&from->y, y_q18);
    const int32x4_t corner = vmlaq_n_s32(vmulq_n_s32(x.first, channels), y.first, (int32_t)from->stride);
    ls_step_t step;
    vst1q_u32(step.corner, vreinterpretq_u32_s32(corner));
    vst1q_u32(step.across, vreinterpretq_u32_s32(x.weight));
    vst1q_u32(step.down, vreinterpretq_u32_s32(y.weight));
    return step;
}

NEON_INLINE void step_xrgb(uint8_t *out, const ls_source_t *from, const ls_step_t *step)
{
    uint16x4_t pixel[PATCH_STEP];
    for (int i = 0; i < PATCH_STEP; i++) {
        const int32x4_t across = vld1q_s32(from->x.weight + step->across[i]);
        const int32x4_t down = vld1q_s32(from->y.weight + step->down[i]);
        pixel[i] =
            sixteen_bits(evaluate_xrgb(from->coefficients + step->corner[i], from->stride, across, down), from->shift);
    }
    vst1q_u8(out,
             vcombine_u8(vqmovn_u16(vcombine_u16(pixel[0], pixel[1])), vqmovn_u16(vcombine_u16(pixel[2], pixel[3]))));
}

NEON_INLINE void step_chroma(uint8_t *out, const ls_source_t *from, const ls_step_t *step)
{
    int32x2_t means[PATCH_STEP];
    for (int i = 0; i < PATCH_STEP; i++) {
        const int32x4_t across = vld1q_s32(from->x.weight + step->across[i]);
        const int32x4_t down = vld1q_s32(from->y.weight + step->down[i]);
        means[i] = evaluate_chroma(from->coefficients + step->corner[i], from->stride, across, down);
    }
    const uint16x4_t left = sixteen_bits(vcombine_s32(means[0], means[1]), from->shift);
    const uint16x4_t right = sixteen_bits(vcombine_s32(means[2], means[3]), from->shift);
    vst1_u8(out, vqmovn_u16(vcombine_u16(left, right)));
}

NEON_INLINE void step_gray(uint8_t *out, const ls_source_t *from, const ls_step_t *step)
{
    int64x2_t sums[PATCH_STEP];
    for (int i = 0; i < PATCH_STEP; i++) {
        const int32x4_t across = vld1q_s32(from->x.weight + step->across[i]);
        const int32x4_t down = vld1q_s32(from->y.weight + step->down[i]);
        sums[i] = evaluate_gray(from->coefficients + step->corner[i], from->stride, across, down);
    }
    const int32x4_t means = vcombine_s32(vshrn_n_s64(vpaddq_s64(sums[0], sums[1]), LS_WEIGHT_BITS),
                                         vshrn_n_s64(vpaddq_s64(sums[2], sums[3]), LS_WEIGHT_BITS));
    const uint16x4_t four = sixteen_bits(means, from->shift);
    const uint8x8_t pixels = vqmovn_u16(vcombine_u16(four, four));
    memcpy(out, &pixels, PATCH_STEP);
}

/* Where step k of a row of at least PATCH_STEP pixels begins: the last one may overlap the one before. */
static inline int32_t step_begin(int32_t k, int32_t width)
{
    return k + PATCH_STEP <= width ? k : width - PATCH_STEP;
}

NEON_INLINE void evaluate_patch(const patch_t *patch, const ls_surface_t *surface, int32_t channels)
{
    const ls_source_t from = {
        placer_of(surface->x),
        placer_of(surface->y),
        surface->coefficients,
        (ptrdiff_t)surface->x->coefficients * channels,
        vdupq_n_s32(-surface->fraction_bits),
    };
    for (int32_t r = 0; r < patch->height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (int32_t k = 0; k < patch->width; k += PATCH_STEP) {
            const int32_t at = step_begin(k, patch->width);
            const ls_step_t step = step_of(&from, x_q18 + at, y_q18 + at, channels);
            if (channels == 4)
                step_xrgb(out + (ptrdiff_t)at * 4, &from, &step);
            else if (channels == 2)
                step_chroma(out + (ptrdiff_t)at * 2, &from, &step);
            else
                step_gray(out + at, &from, &step);
        }
    }
}

void resample_ls_xrgb_neon(const patch_t *patch, const ls_surface_t *surface)
{
    if (patch->width < PATCH_STEP || surface->fraction_bits == 0)
        resample_ls_xrgb_scalar(patch, surface);
    else
        evaluate_patch(patch, surface, 4);
}

void resample_ls_chroma_neon(const patch_t *patch, const ls_surface_t *surface)
{
    if (patch->width < PATCH_STEP || surface->fraction_bits == 0)
        resample_ls_chroma_scalar(patch, surface);
    else
        evaluate_patch(patch, surface, 2);
}

void resample_ls_gray_neon(const patch_t *patch, const ls_surface_t *surface)
{
    if (patch->width < PATCH_STEP || surface->fraction_bits == 0)
        resample_ls_gray_scalar(patch, surface);
    else
        evaluate_patch(patch, surface, 1);
}
