// SPDX-License-Identifier: Apache-2.0
// The pixel loops: one function type each, one table of pointers per CPU level. Scalar C is the definition.
//
// Every implementation writes the same bytes, and not one byte more. None allocates, keeps state or reads outside the
// pixels named. Counts may be 0 and need not be a multiple of anything.
#ifndef WARP_FIXED_KERNELS_H
#define WARP_FIXED_KERNELS_H

#include <stdint.h>

#include "warp_fixed/color.h"
#include "warp_fixed/grid_row.h"
#include "warp_fixed/image.h"
#include "warp_fixed/ls_axis.h"
#include "warp_fixed/window_weights.h"

/**
 * Write the points of blocks of a row, one after the other: each block's forward differences, modulo 2^32.
 *
 * @param[out] x_q18, y_q18  end - begin points.
 * @param      row           grid_row_cursor().
 * @param      begin, end    Lit pixels; each a multiple of the length of the row's blocks, as multiples of
 * GRID_MAX_SPAN are, or where the lit pixels begin and end.
 */
typedef void grid_points_fn(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_row_cursor_t *row,
                            int32_t begin, int32_t end);

enum {
    PATCH_MAX_WIDTH = GRID_MAX_SPAN,
    PATCH_MAX_HEIGHT = 16,
    PATCH_SLACK_Q18 = 1 << (GRID_FRACTION_BITS - 6), /**< 1/64 px, and points err by less than 1/256 */
    PATCH_KNOWN_PX = 900
};

/**
 * A rectangle of panel pixels, all of them lit, and the points where they fall in the picture.
 *
 * Points are a grid's. A homography makes a convex quadrilateral of the rectangle, so no point is further left, right,
 * up or down than those of the four corners, by more than PATCH_SLACK_Q18. This holds of points clamped to what is
 * within PATCH_KNOWN_PX of the picture: of others it is only known that they are as far away as that (grid_row.c).
 */
typedef struct {
    uint8_t *out;                 /**< the first pixel, of the picture's format */
    ptrdiff_t stride;             /**< bytes from a row of pixels to the next */
    const int32_t *x_q18, *y_q18; /**< points of row r begin at r * PATCH_MAX_WIDTH */
    int32_t width, height;        /**< 0 to PATCH_MAX_WIDTH, PATCH_MAX_HEIGHT */
} patch_t;

/**
 * Take the picture pixel under each point: floor of the point clamped to the picture, [0, width] x [0, height].
 */
typedef void resample_nearest_fn(const patch_t *patch, const image_t *picture);

/** Weights of a window along both axes, and where its texels are. */
typedef struct {
    window_axis_t x, y;
    image_t picture;             /**< at its level */
    coefficients_t coefficients; /**< of that picture; the spline_* loops read them instead */
    int32_t width, height;       /**< of level 0: points are clamped to it */
    int level_x, level_y;        /**< a point is divided by 8^level: 0 along short windows */
} window_t;

/**
 * Weigh the window of texels around each point (window_weights.h). Texels beyond the picture's edge are mirrored.
 *
 * v = (sum_y first * texel + half) >> first_shift for each column, out = pixel_from_sum(sum_x second * v), per channel.
 * The coefficients_* loops do the same on coefficients: out is sum_x second * v, rounded and clamped.
 * Points are clamped here to the picture.
 */
typedef void resample_window_fn(const patch_t *patch, const window_t *window);

enum {
    PREFILTER_MAX_RADIUS = 512 + 8, /**< of butter at the largest k, 64, with that of the spline */
    FILTER_ROWS = 2,                /**< of one call of filter_columns_fn: they share what they read */
    FILTER_SLACK = 4                /**< neighbours that filter_row_fn may read, if the radius is less */
};

/** A symmetric FIR filter: w[0] + 2 (w[1] + ... + w[radius]) = 1 << FILTER_SUM_LOG2. */
typedef struct {
    int32_t radius;
    int16_t weight[PREFILTER_MAX_RADIUS + 1]; /**< of distance 0, 1, ... */
} fir_t;

/**
 * First pass of a filter: FILTER_ROWS output rows from 2 radius + FILTER_ROWS rows, column by column.
 *
 * @param[out] v      Rows of count sums that do not overlap, each sum(weight * byte) rounded to FILTER_FIRST_BITS
 *                    fraction bits, less the middle grey.
 * @param      rows   rows[0] to rows[2 radius + FILTER_ROWS - 1], each of count bytes; v[i] is made of the 2 radius + 1
 *                    from rows[i] on.
 * @param      count  Bytes of a row: width times channels.
 */
typedef void filter_columns_fn(int16_t *const v[FILTER_ROWS], const uint8_t *const *rows, const fir_t *fir,
                               int32_t count);

/**
 * Second pass: one row of coefficients from the first pass's sums, sum(weight * v) rounded to COEFFICIENT_BITS.
 *
 * @param[out] out       count coefficients.
 * @param      v         With r, the radius, at least FILTER_SLACK: v[-r * channels] to v[count + r * channels - 1] are
 *                       readable.
 * @param      channels  Distance between neighbours of one channel: 1, 2 or 4.
 */
typedef void filter_row_fn(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                           int32_t channels);

/** The same to bytes: rounded half up and clamped. */
typedef void filter_row_bytes_fn(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                                 int32_t channels);

enum {
    LS_LANES = 16,     /**< pictures are fitted in strips of so many rows, or columns, times channels */
    LS_PIXEL_BITS = 17 /**< fraction bits of pixels, and of right-hand sides */
};

/**
 * Take one pixel of each row of a strip.
 *
 * @param[out] data  LS_LANES: row after row, channel after channel, byte << LS_PIXEL_BITS.
 * @param      rows  LS_LANES / channels of them.
 * @param      x     The pixel.
 */
typedef void ls_pixels_fn(int32_t *restrict data, const uint8_t *const *rows, int32_t x);

/**
 * Scale each lane: to = from * 2^shift, rounded half up, saturated to +-(2^31 - 1).
 *
 * @param[out] to     LS_LANES.
 * @param      from   LS_LANES.
 * @param      shift  LS_LANES, each -31 to 31.
 */
typedef void ls_scale_fn(int32_t *restrict to, const int32_t *restrict from, const int32_t *restrict shift);

/**
 * Take one equation into the right-hand sides: scale the data, then turn it with each of four rows (ls_axis.h).
 *
 * For t = 0 to 3: (z_t, d) = (cos z_t + sin d, cos d - sin z_t), every product rounded as mul_q31().
 *
 * @param z     Rows `first` to `first + 3`, each of LS_LANES. No sum leaves 32 bits: ls_fit.c.
 * @param data  LS_LANES, of magnitude 255 * 2^17 at most.
 */
typedef void ls_forward_fn(int32_t *restrict z, const int32_t *restrict data, const ls_equation_t *equation);

/**
 * Replace one row of right-hand sides by coefficients, saturated to +-(2^31 - 1).
 *
 * @param row  LS_LANES right-hand sides, then three rows of LS_LANES coefficients.
 */
typedef void ls_backward_fn(int32_t *row, const ls_solution_t *solution);

/** A fitted picture. */
typedef struct {
    const ls_axis_t *x, *y;
    const int32_t *coefficients; /**< rows of x->coefficients times the picture's channels */
    int32_t fraction_bits;       /**< of the coefficients, 0 to 4 */
} ls_surface_t;

/**
 * Evaluate the surface of eq 6 at each point.
 *
 * v = sum_x weight * coefficient for each of four rows, rounded to the coefficients' format; out = sum_y weight * v,
 * per channel, rounded half up and clamped to 0..255. Points are clamped here to the picture.
 */
typedef void resample_ls_fn(const patch_t *patch, const ls_surface_t *surface);

/**
 * Take a row of YUYV or UYVY (picture.h) apart.
 *
 * @param[out] luma    2 * pairs bytes.
 * @param[out] chroma  2 * pairs bytes: U, V in turn.
 * @param      from    4 * pairs bytes.
 */
typedef void planes_from_row_fn(uint8_t *restrict luma, uint8_t *restrict chroma, const uint8_t *restrict from,
                                int32_t pairs);

/** Put a row of YUYV together; sizes as above. */
typedef void row_from_planes_fn(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                                int32_t pairs);

/** Put a row of XRGB8888 together, 8 * pairs bytes, by color.h; X is 0. Both pixels of a pair have its chroma. */
typedef void xrgb_from_yuv_fn(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                              const color_matrix_t *matrix, int32_t pairs);

/** Make XRGB8888 of a row of RGB888 or BGR888 (picture.h); X is 0. */
typedef void xrgb_from_row_fn(uint8_t *restrict out, const uint8_t *restrict from, int32_t count);

/** The loops of one CPU level. */
typedef struct {
    const char *name;
    grid_points_fn *grid_points;
    resample_nearest_fn *nearest_gray, *nearest_chroma, *nearest_xrgb;
    resample_window_fn *window_gray, *window_chroma, *window_xrgb;
    resample_window_fn *coefficients_gray, *coefficients_chroma, *coefficients_xrgb;
    filter_columns_fn *filter_columns;
    filter_row_fn *filter_row;
    filter_row_bytes_fn *filter_row_bytes;
    ls_pixels_fn *ls_pixels_gray, *ls_pixels_chroma, *ls_pixels_xrgb;
    ls_scale_fn *ls_scale;
    ls_forward_fn *ls_forward;
    ls_backward_fn *ls_backward;
    resample_ls_fn *ls_gray, *ls_chroma, *ls_xrgb;
    planes_from_row_fn *planes_from_yuyv, *planes_from_uyvy;
    row_from_planes_fn *yuyv_from_planes;
    xrgb_from_yuv_fn *xrgb_from_yuv;
    xrgb_from_row_fn *xrgb_from_rgb888, *xrgb_from_bgr888;
} warp_kernels_t;

/** Plain C: the definition of every loop. */
extern const warp_kernels_t warp_kernels_scalar;

/** NEON (neon.h). */
extern const warp_kernels_t warp_kernels_neon;

enum { WARP_KERNELS_LEVELS = 2 };

/** Every level, the slowest first. */
extern const warp_kernels_t *const warp_kernels_levels[WARP_KERNELS_LEVELS];

/** @return The fastest level that this build has. */
const warp_kernels_t *warp_kernels_best(void);

/** @return The level of that name, or NULL. */
const warp_kernels_t *warp_kernels_from_name(const char *name);

#endif
