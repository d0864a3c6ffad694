// SPDX-License-Identifier: Apache-2.0
// Short windows of gray or chroma texels some of whose weights are negative: two rows at a time.
//
// They read copies in which the bytes of a row and of the next one alternate (window_patch_neon.h). One load brings so
// many columns of two rows, one splat the weights of both; sums of even and of odd rows are added up last. Such copies
// are less than 512 texels wide and high and than 2^16 bytes long, so that windows are placed in lanes of 16 bits.
// Windows of an odd number of rows may begin in the middle of a pair: then their weights do, too, with the 0 before.
#include "warp_fixed/resample_pairs_neon.h"

#include <stdbool.h>

#include "warp_fixed/window_sums_neon.h"
#include "warp_fixed/window_texels_neon.h"

enum { STEP = 8, PAIRS = WINDOW_SHORT_TAPS / 2 };

_Static_assert((int)STEP <= (int)PATCH_MAX_STEP, "points of a step");

/* Where eight windows and their weights begin. */
typedef struct {
    uint16_t texel[STEP]; /* bytes from the copy's first */
    uint16_t row_x[STEP]; /* bytes from row 0 of the second pass */
    uint16_t row_y[STEP]; /* bytes from row 0 of the first pass, which may be -1 */
} step_t;

/* Where windows begin along one axis, in 1/128 texel. */
NEON_INLINE uint16x8_t begins(const int32_t *point_q18, int32_t start_q18)
{
    enum { TO_PHASE = GRID_FRACTION_BITS - PHASE_BITS };
    const int32x4_t start = vdupq_n_s32(start_q18);
    const int32x4x2_t points = vld1q_s32_x2(point_q18);
    const int32x4_t low = vaddq_s32(points.val[0], start), high = vaddq_s32(points.val[1], start);
    return vreinterpretq_u16_s16(vcombine_s16(vshrn_n_s32(low, TO_PHASE), vshrn_n_s32(high, TO_PHASE)));
}

NEON_INLINE void place(step_t *step, const window_source_t *source, const int32_t *x_q18, const int32_t *y_q18,
                       int32_t channels, bool is_odd)
{
    enum { ABOVE = 16 - PHASE_BITS, X_LOG2 = 4, Y_LOG2 = 3 };
    const uint16x8_t x = begins(x_q18, source->x_start_q18), y = begins(y_q18, source->y_start_q18);
    const uint16x8_t column = vshrq_n_u16(x, PHASE_BITS);
    const uint16x8_t pair = is_odd ? vshrq_n_u16(y, PHASE_BITS + 1) : vshrq_n_u16(y, PHASE_BITS);
    const uint16x8_t across = channels == 1 ? vshlq_n_u16(column, 1) : vshlq_n_u16(column, 2);
    const int16x8_t row_y = vreinterpretq_s16_u16(vshrq_n_u16(vshlq_n_u16(y, ABOVE), ABOVE - Y_LOG2));
    const int16x8_t second_of_pair = vreinterpretq_s16_u16(vshlq_n_u16(y, ABOVE - 1)); /* negative if so */
    store_short_numbers(step->texel, vmlaq_n_u16(across, pair, COPY_STRIDE));
    store_short_numbers(step->row_x, vshrq_n_u16(vshlq_n_u16(x, ABOVE), ABOVE - X_LOG2));
    store_short_numbers(step->row_y, vreinterpretq_u16_s16(is_odd ? vsraq_n_s16(row_y, second_of_pair, 15) : row_y));
}

/* Where texels and weights are. */
typedef struct {
    const uint8_t *data, *first, *second;
} tables_t;

/* First-pass weights of one window, those of two rows in turn. */
typedef struct {
    uint8x16_t pair[PAIRS];
} pair_splats_t;

NEON_INLINE pair_splats_t load_pair_splats(const uint8_t *first)
{
    const uint16x4_t weights = vreinterpret_u16_u8(load_to_splat(first));
    return (pair_splats_t){{
        vreinterpretq_u8_u16(vdupq_lane_u16(weights, 0)),
        vreinterpretq_u8_u16(vdupq_lane_u16(weights, 1)),
        vreinterpretq_u8_u16(vdupq_lane_u16(weights, 2)),
        vreinterpretq_u8_u16(vdupq_lane_u16(weights, 3)),
    }};
}

/* First-pass sums of `bytes` bytes of some rows: eight columns (for chroma, U and V of four), then more. */
typedef struct {
    int16x8_t left, right;
} columns_t;

/* What follows 16 bytes, if that many are read. */
NEON_INLINE uint8x16_t load_right(const uint8_t *row, int bytes)
{
    if (bytes > 24)
        return vld1q_u8(row + 16);
    return vcombine_u8(bytes > 16 ? vld1_u8(row + 16) : vdup_n_u8(0), vdup_n_u8(0));
}

NEON_INLINE columns_t first_pass(const uint8_t *texels, const pair_splats_t *splats, int rows, int bytes)
{
    int16x8_t v[4];
    const uint8_t *row = kept_address(texels);
    const ptrdiff_t next_pair = rows % 2 == 0 ? 2 * COPY_STRIDE : COPY_STRIDE;
    for (int t = 0; 2 * t < rows; t++, row += next_pair) {
        const uint8x16_t left = vld1q_u8(row), right = load_right(row, bytes), weight = splats->pair[t];
        const uint8x8_t eight[4] = {vget_low_u8(left), vget_high_u8(left), vget_low_u8(right), vget_high_u8(right)};
        const uint8x8_t weights[2] = {vget_low_u8(weight), vget_high_u8(weight)};
        for (int i = 0; i < bytes / 8; i++)
            v[i] =
                t == 0 ? products(eight[i], weights[i % 2], true) : add_products(v[i], eight[i], weights[i % 2], true);
    }
    const int16x8_t left = vpaddq_s16(v[0], v[1]);
    return (columns_t){left, bytes > 16 ? vpaddq_s16(v[2], v[bytes > 24 ? 3 : 2]) : left};
}

/* First-pass sums of a gray pixel. */
NEON_INLINE int16x8_t gray_columns(const tables_t *tables, const step_t *step, int i, int rows)
{
    const pair_splats_t splats = load_pair_splats(tables->first + stored_signed_offset(&step->row_y[i]));
    return first_pass(tables->data + stored_short_offset(&step->texel[i]), &splats, rows, 16).left;
}

/* Second-pass sums of a gray pixel, to be added up; negated. */
NEON_INLINE int32x4_t weigh_gray(const tables_t *tables, const step_t *step, int i, int16x8_t v)
{
    const int16x8_t w = vreinterpretq_s16_u8(vld1q_u8(tables->second + stored_short_offset(&step->row_x[i])));
    return vmlal_high_s16(vmull_s16(vget_low_s16(v), vget_low_s16(w)), v, w);
}

/* First-pass sums of a chroma pixel. */
NEON_INLINE columns_t chroma_columns(const tables_t *tables, const step_t *step, int i, int rows, int bytes)
{
    const pair_splats_t splats = load_pair_splats(tables->first + stored_signed_offset(&step->row_y[i]));
    return first_pass(tables->data + stored_short_offset(&step->texel[i]), &splats, rows, bytes);
}

/* U, V of even texels, U, V of odd ones; negated. */
NEON_INLINE int32x4_t weigh_chroma(const tables_t *tables, const step_t *step, int i, columns_t v, int bytes)
{
    const int16x8_t weights = vreinterpretq_s16_u8(vld1q_u8(tables->second + stored_short_offset(&step->row_x[i])));
    const int16x8_t left = twice_low(weights), right = twice_high(weights);
    int32x4_t sums = vmlal_high_s16(vmull_s16(vget_low_s16(v.left), vget_low_s16(left)), v.left, left);
    if (bytes > 16)
        sums = vmlal_s16(sums, vget_low_s16(v.right), vget_low_s16(right));
    if (bytes > 24)
        sums = vmlal_high_s16(sums, v.right, right);
    return sums;
}

/* Four pixels of a step from pixel i on, as sums. */
NEON_INLINE int32x4_t four_gray(const tables_t *tables, const step_t *step, int i, const int16x8_t v[STEP])
{
    const int32x4_t left = vpaddq_s32(weigh_gray(tables, step, i, v[i]), weigh_gray(tables, step, i + 1, v[i + 1]));
    const int32x4_t right =
        vpaddq_s32(weigh_gray(tables, step, i + 2, v[i + 2]), weigh_gray(tables, step, i + 3, v[i + 3]));
    return vpaddq_s32(left, right);
}

/* First-pass sums of four pixels of a step from pixel i on. */
typedef struct {
    columns_t pixel[4];
} four_columns_t;

NEON_INLINE four_columns_t four_chroma_columns(const tables_t *tables, const step_t *step, int i, int rows, int bytes)
{
    four_columns_t four;
    for (int k = 0; k < 4; k++)
        four.pixel[k] = chroma_columns(tables, step, i + k, rows, bytes);
    return four;
}

NEON_INLINE uint8x8_t four_chroma(const tables_t *tables, const step_t *step, int i, const four_columns_t *v, int bytes)
{
    int32x4_t sums[4];
    for (int k = 0; k < 4; k++)
        sums[k] = weigh_chroma(tables, step, i + k, v->pixel[k], bytes);
    return pixels_from_sums(chroma_from_sums(sums[0], sums[1]), chroma_from_sums(sums[2], sums[3]), true);
}

/* `bytes` as in first_pass(). */
NEON_INLINE void weigh_patch(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t channels, int rows, int bytes)
{
    const window_source_t from = *source; /* what is written might alias it */
    const tables_t tables = {from.data, window->y.first_bytes, (const uint8_t *)window->x.second};
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP) {
            step_t step;
            place(&step, &from, x_q18, y_q18, channels, rows % 2 != 0);
            if (channels == 1) {
                int16x8_t v[STEP];
                for (int i = 0; i < STEP; i++)
                    v[i] = gray_columns(&tables, &step, i, rows);
                const int32x4_t left = four_gray(&tables, &step, 0, v), right = four_gray(&tables, &step, 4, v);
                vst1_u8(out, pixels_from_sums(left, right, true));
            } else {
                const four_columns_t left = four_chroma_columns(&tables, &step, 0, rows, bytes);
                const four_columns_t right = four_chroma_columns(&tables, &step, 4, rows, bytes);
                vst1_u8(out, four_chroma(&tables, &step, 0, &left, bytes));
                vst1_u8(out + STEP, four_chroma(&tables, &step, 4, &right, bytes));
            }
            out += STEP * channels;
        }
    }
}

NEON_INLINE void by_rows(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t channels,
                         int bytes)
{
    switch (window->y.taps) {
    case 4:
        weigh_patch(patch, window, source, channels, 4, bytes);
        break;
    case 5:
        weigh_patch(patch, window, source, channels, 5, bytes);
        break;
    case 6:
        weigh_patch(patch, window, source, channels, 6, bytes);
        break;
    case 7:
        weigh_patch(patch, window, source, channels, 7, bytes);
        break;
    default:
        weigh_patch(patch, window, source, channels, WINDOW_SHORT_TAPS, bytes);
    }
}

static void gray(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    by_rows(patch, window, source, 1, 16);
}

static void chroma_4_columns(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    by_rows(patch, window, source, 2, 16);
}

static void chroma_6_columns(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    by_rows(patch, window, source, 2, 24);
}

static void chroma_8_columns(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    by_rows(patch, window, source, 2, 32);
}

static patch_loop_t loop_of(const window_t *window, weigh_patch_fn *weigh, int32_t taps_x, int32_t channels)
{
    return (patch_loop_t){
        .weigh = weigh,
        .taps_x = taps_x,
        .taps_y = (window->y.taps + 1) & -2,
        .pixel_bytes = channels,
        .step = STEP,
        .centred = true,
        .pair_step = window->y.taps % 2 + 1,
    };
}

patch_loop_t resample_pairs_gray_neon(const window_t *window)
{
    return loop_of(window, gray, WINDOW_SHORT_TAPS, 1);
}

patch_loop_t resample_pairs_chroma_neon(const window_t *window)
{
    /* Kernels with negative weights are at least four texels wide. */
    static weigh_patch_fn *const by_columns[] = {chroma_4_columns, chroma_6_columns, chroma_8_columns};
    const int32_t taps_x = (window->x.taps + 1) & -2;
    return loop_of(window, by_columns[taps_x / 2 - 2], taps_x, 2);
}
