// SPDX-License-Identifier: Apache-2.0
// Homography -> how large projector pixels are in the picture: the sides of each block.
#include "warp_fixed/footprint_from_homography.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/grid_quotient.h"

/* One coordinate along a row: x = by_u U + at_zero, and what its derivatives by u and v are made of. */
typedef struct {
    int64_t by_u, by_v, at_zero;
    slope_t slope_by_u; /* the same at every pixel */
    int32_t exponent;
} axis_t;

/* A row, at whose pixels derivatives are asked for. */
typedef struct {
    axis_t x, y;
    int64_t w_by_u, w_by_v, w_at_zero;
} derivatives_t;

static axis_t axis_of(const grid_linear_t *form, int32_t exponent, const grid_linear_t *w, int32_t v_half)
{
    const int64_t at_zero = form->v * v_half + form->c, w_at_zero = w->v * v_half + w->c;
    const int128_t numerator = (int128_t)form->u * w_at_zero - (int128_t)at_zero * w->u;
    return (axis_t){form->u, form->v, at_zero, slope_from_numerator(numerator, exponent), exponent};
}

static derivatives_t derivatives_of(const grid_t *grid, int32_t j)
{
    const int32_t v_half = 2 * j + 1;
    return (derivatives_t){
        .x = axis_of(&grid->x, grid->x_exponent, &grid->w, v_half),
        .y = axis_of(&grid->y, grid->y_exponent, &grid->w, v_half),
        .w_by_u = grid->w.u,
        .w_by_v = grid->w.v,
        .w_at_zero = grid->w.v * v_half + grid->w.c,
    };
}

/* Squared slope, Q32, saturated to 2^62. */
static inline uint64_t square_q32(slope_t slope, reciprocal_t over)
{
    /* Rounded to Q24 and then to Q16: floor((floor((s + 1) / 2) + 128) / 256). */
    const int64_t q16 = (slope_q25(slope, over) + 257) >> 9, limit = (int64_t)1 << 31;
    const bool within = q16 <= limit && q16 >= -limit;
    return within ? (uint64_t)(q16 * q16) : (uint64_t)1 << 62;
}

/* |(dx/du, dx/dv)|^2, Q32, 2^63 at most. */
static inline uint64_t side_squared(const axis_t *axis, int32_t u_half, int64_t w, int64_t w_by_v, reciprocal_t over)
{
    const int64_t x = axis->by_u * u_half + axis->at_zero;
    const slope_t slope_by_v = slope_from_numerator((int128_t)axis->by_v * w - (int128_t)x * w_by_v, axis->exponent);
    return square_q32(axis->slope_by_u, over) + square_q32(slope_by_v, over);
}

enum { AT_ONCE = 8 };

/*
 * Sides at some pixels of a row, AT_ONCE at most. In steps of one kind for all of them, for each is a long chain of
 * products: so those of several pixels are on their way at once.
 */
static void sides_at(footprint_sides_t *sides, const derivatives_t *row, const int32_t *u_half, int32_t count)
{
    reciprocal_t over[AT_ONCE];
    uint64_t width[AT_ONCE], height[AT_ONCE];
    for (int32_t k = 0; k < count; k++)
        over[k] = reciprocal_of(row->w_by_u * u_half[k] + row->w_at_zero);
    for (int32_t k = 0; k < count; k++) {
        const int64_t w = row->w_by_u * u_half[k] + row->w_at_zero;
        width[k] = side_squared(&row->x, u_half[k], w, row->w_by_v, over[k]);
        height[k] = side_squared(&row->y, u_half[k], w, row->w_by_v, over[k]);
    }
    for (int32_t k = 0; k < count; k++)
        sides[k] = (footprint_sides_t){floor_sqrt(width[k]), floor_sqrt(height[k])};
}

static int32_t rows_from(const grid_t *grid, int32_t first_row, int32_t rows)
{
    return clamp_i32(grid->panel_height - first_row, 0, rows);
}

int footprint_block_log2(const grid_t *grid, int32_t first_row)
{
    const int64_t by_u = grid->w.u < 0 ? -grid->w.u : grid->w.u, by_v = grid->w.v < 0 ? -grid->w.v : grid->w.v;
    const int64_t change = 2 * (by_u > by_v ? by_u : by_v); /* of w per pixel: below 2^50 (w < 2^60 over 8192 px) */
    const int32_t rows = rows_from(grid, first_row, FOOTPRINT_BAND);
    int log2 = 4;
    for (int32_t j = first_row; j < first_row + rows; j++) {
        const grid_row_t *row = &grid->row[j];
        if (row->begin == row->end)
            continue;
        const int64_t at_begin = grid_depth(grid, row->begin, j), at_end = grid_depth(grid, row->end - 1, j);
        const int64_t least = at_begin < at_end ? at_begin : at_end;
        while (log2 > 0 && change << (log2 + 4) > least)
            log2--;
    }
    return log2;
}

void footprint_blocks(footprint_blocks_t *out, const grid_t *grid, int32_t first_row, int size_log2)
{
    const int32_t size = 1 << size_log2, rows = rows_from(grid, first_row, size);
    int32_t first_lit = -1, last_lit = -1, begin = IMAGE_MAX_WIDTH, end = 0;
    for (int32_t j = first_row; j < first_row + rows; j++) {
        const grid_row_t *row = &grid->row[j];
        if (row->begin == row->end)
            continue;
        first_lit = first_lit < 0 ? j : first_lit;
        last_lit = j;
        begin = row->begin < begin ? row->begin : begin;
        end = row->end > end ? row->end : end;
    }
    out->begin = out->end = 0;
    if (first_lit < 0)
        return;

    int32_t middle = (first_lit + last_lit) / 2;
    while (grid->row[middle].begin == grid->row[middle].end) /* possible next to a tip of the lit region */
        middle++;
    const grid_row_t *row = &grid->row[middle];
    const derivatives_t derivatives = derivatives_of(grid, middle);
    out->begin = begin >> size_log2;
    out->end = ((end - 1) >> size_log2) + 1;
    for (int32_t b = out->begin; b < out->end; b += AT_ONCE) {
        const int32_t count = out->end - b < AT_ONCE ? out->end - b : AT_ONCE;
        int32_t u_half[AT_ONCE];
        for (int32_t k = 0; k < count; k++)
            u_half[k] = 2 * clamp_i32(((b + k) << size_log2) + size / 2, row->begin, row->end - 1) + 1;
        sides_at(&out->block[b], &derivatives, u_half, count);
    }
}
