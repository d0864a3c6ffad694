// SPDX-License-Identifier: Apache-2.0
// Homography -> how large projector pixels are in the picture: the step k of a frame, the sides of each block.
#include "warp_fixed/footprint_from_homography.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/real_vector.h"

enum { MAX_VERTICES = 12 };

/* Convex, its vertices (u, v, 1) on the panel. */
typedef struct {
    int count;
    real_t at[MAX_VERTICES][3];
} polygon_t;

static polygon_t polygon_of_centres(const homography_t *h)
{
    const real_t low = real_from_int(1, -1), one = real_from_int(1, 0);
    const real_t right = real_from_int(2 * (int64_t)h->panel_width - 1, -1);
    const real_t bottom = real_from_int(2 * (int64_t)h->panel_height - 1, -1);
    return (polygon_t){4, {{low, low, one}, {right, low, one}, {right, bottom, one}, {low, bottom, one}}};
}

/* Sutherland and Hodgman's clip of a polygon to form . (u, v, 1) >= 0: adds one vertex at most. */
static void polygon_clip(polygon_t *polygon, const real_t form[3])
{
    polygon_t out = {.count = 0};
    for (int i = 0; i < polygon->count; i++) {
        const real_t *here = polygon->at[i], *next = polygon->at[(i + 1) % polygon->count];
        const real_t d_here = vector_dot(form, here), d_next = vector_dot(form, next);
        const bool in_here = real_sign(d_here) >= 0, in_next = real_sign(d_next) >= 0;
        if (in_here) {
            for (int k = 0; k < 3; k++)
                out.at[out.count][k] = here[k];
            out.count++;
        }
        if (in_here != in_next) {
            const real_t part = real_div(d_here, real_sub(d_here, d_next));
            for (int k = 0; k < 2; k++)
                out.at[out.count][k] = real_add(here[k], real_mul(part, real_sub(next[k], here[k])));
            out.at[out.count][2] = real_from_int(1, 0);
            out.count++;
        }
    }
    *polygon = out;
}

/* The larger column norm of the Jacobian at (u, v, 1), Q16; saturated where the depth is not positive. */
static int32_t larger_column_q16(const homography_t *h, const real_t at[3])
{
    const real_t w = vector_dot(h->row[2], at);
    if (real_sign(w) <= 0)
        return FOOTPRINT_MAX_STEP_Q16;
    const real_t over = real_div(real_from_int(1, 0), w);
    real_t largest = real_from_int(0, 0);
    for (int column = 0; column < 2; column++) {
        real_t square = real_from_int(0, 0);
        for (int a = 0; a < 2; a++) {
            const real_t point = real_mul(vector_dot(h->row[a], at), over);
            const real_t slope = real_mul(real_sub(h->row[a][column], real_mul(point, h->row[2][column])), over);
            square = real_add(square, real_mul(slope, slope));
        }
        if (real_less(largest, square))
            largest = square;
    }
    return (int32_t)real_to_fixed(real_sqrt(largest), 16, FOOTPRINT_MAX_STEP_Q16);
}

static int32_t largest_step_q16(const homography_t *h, const polygon_t *polygon)
{
    int32_t largest = 0;
    for (int i = 0; i < polygon->count; i++) {
        const int32_t step = larger_column_q16(h, polygon->at[i]);
        largest = step > largest ? step : largest;
    }
    return largest;
}

footprint_step_t footprint_step(const homography_t *homography)
{
    polygon_t polygon = polygon_of_centres(homography);
    footprint_step_t step;
    step.all_q16 = largest_step_q16(homography, &polygon);

    const int32_t size[2] = {homography->picture_width, homography->picture_height};
    polygon_clip(&polygon, homography->row[2]);
    for (int a = 0; a < 2; a++) {
        real_t beyond[3];
        for (int k = 0; k < 3; k++)
            beyond[k] = real_sub(real_mul(real_from_int(size[a], 0), homography->row[2][k]), homography->row[a][k]);
        polygon_clip(&polygon, homography->row[a]);
        polygon_clip(&polygon, beyond);
    }
    step.in_q16 = largest_step_q16(homography, &polygon);
    return step;
}

/* sqrt(a^2 + b^2), |a|, |b| <= 2^31: the sum of squares is at most 2^63. */
static uint32_t norm(int64_t a, int64_t b)
{
    return floor_sqrt((uint64_t)(a * a) + (uint64_t)(b * b));
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
    out->begin = begin >> size_log2;
    out->end = ((end - 1) >> size_log2) + 1;
    for (int32_t b = out->begin; b < out->end; b++) {
        const int32_t i = clamp_i32((b << size_log2) + size / 2, row->begin, row->end - 1);
        const grid_jacobian_t jacobian = grid_jacobian(grid, i, middle);
        out->block[b] =
            (footprint_sides_t){norm(jacobian.x_by_u, jacobian.x_by_v), norm(jacobian.y_by_u, jacobian.y_by_v)};
    }
}
