// SPDX-License-Identifier: Apache-2.0
// Homography -> where every lit projector pixel falls in the picture, in Q18 integers.
#include "warp_fixed/grid_from_homography.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/grid_row.h"

enum { FORM_BITS = 60 };

static int64_t value_at(const grid_linear_t *form, int32_t u_half, int32_t v_half)
{
    return form->u * u_half + form->v * v_half + form->c;
}

/* @return The exponent by which the reals are the form's integers: real form = integers * 2^exponent. */
static int32_t linear_from_reals(grid_linear_t *form, const real_t by_pixel[3])
{
    const real_t reach = real_from_int(IMAGE_MAX_WIDTH, 0);
    const real_t bound =
        real_add(real_mul(real_add(real_abs(by_pixel[0]), real_abs(by_pixel[1])), reach), real_abs(by_pixel[2]));
    const int32_t bits = FORM_BITS - (bound.exponent + 63);
    const int64_t limit = (int64_t)1 << FORM_BITS;
    form->u = real_to_fixed(by_pixel[0], bits - 1, limit);
    form->v = real_to_fixed(by_pixel[1], bits - 1, limit);
    form->c = real_to_fixed(by_pixel[2], bits, limit);
    return -bits;
}

/* Half-plane of panel points whose pixel, widened by 1/8 on each side, reaches form >= 0. */
static void edge_from_reals(grid_linear_t *edge, const real_t form[3])
{
    const real_t reach = real_mul(real_add(real_abs(form[0]), real_abs(form[1])), real_from_int(5, -3));
    const real_t widened[3] = {form[0], form[1], real_add(form[2], reach)};
    (void)linear_from_reals(edge, widened);
}

/* The five half-planes of a lit pixel: left, right, top, bottom of the picture, and in front of the viewer. */
static void edges_from_homography(grid_linear_t edge[5], const homography_t *h)
{
    const int32_t size[2] = {h->picture_width, h->picture_height};
    for (int a = 0; a < 2; a++) {
        real_t beyond[3];
        for (int k = 0; k < 3; k++)
            beyond[k] = real_sub(real_mul(real_from_int(size[a], 0), h->row[2][k]), h->row[a][k]);
        edge_from_reals(&edge[2 * a], h->row[a]);
        edge_from_reals(&edge[2 * a + 1], beyond);
    }
    (void)linear_from_reals(&edge[4], h->row[2]);
    edge[4].c -= 1; /* depth 0 is behind */
}

static int64_t floor_div(int64_t a, int64_t b)
{
    const int64_t quotient = a / b;
    return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

/* Narrow [*first, *last] (half pixels, not empty) to where edge >= 0 on the row v_half. Most edges need no division. */
static void clip_half_pixels(int64_t *first, int64_t *last, const grid_linear_t *edge, int32_t v_half)
{
    const int64_t at_zero = edge->v * v_half + edge->c;
    if (edge->u > 0 && at_zero + edge->u * *first < 0)
        *first = -floor_div(at_zero, edge->u);
    else if (edge->u < 0 && at_zero + edge->u * *last < 0)
        *last = floor_div(at_zero, -edge->u);
    else if (edge->u == 0 && at_zero < 0)
        *last = -1;
}

static grid_row_t lit_row(const grid_t *grid, const grid_linear_t edge[5], int32_t j)
{
    int64_t first = 1, last = 2 * (int64_t)grid->panel_width - 1; /* half pixels; centres are odd */
    for (int e = 0; e < 5 && first <= last; e++)
        clip_half_pixels(&first, &last, &edge[e], 2 * j + 1);
    if (first > last)
        return (grid_row_t){0, 0, 0, false};
    const int64_t begin = first / 2, end = (last + 1) / 2;
    return begin < end ? (grid_row_t){(int16_t)begin, (int16_t)end, 0, false} : (grid_row_t){0, 0, 0, false};
}

void grid_from_homography(grid_t *grid, const homography_t *homography)
{
    grid_linear_t edge[5];
    grid->panel_width = homography->panel_width;
    grid->panel_height = homography->panel_height;
    grid->picture_width = homography->picture_width;
    grid->picture_height = homography->picture_height;
    const int32_t w_exponent = linear_from_reals(&grid->w, homography->row[2]);
    grid->x_exponent = linear_from_reals(&grid->x, homography->row[0]) - w_exponent;
    grid->y_exponent = linear_from_reals(&grid->y, homography->row[1]) - w_exponent;
    edges_from_homography(edge, homography);

    for (int32_t j = 0; j < grid->panel_height; j++) {
        grid->row[j] = lit_row(grid, edge, j);
        if (grid->row[j].begin < grid->row[j].end)
            grid_row_plan(grid, j);
    }
}

int64_t grid_depth(const grid_t *grid, int32_t i, int32_t j)
{
    return value_at(&grid->w, 2 * i + 1, 2 * j + 1);
}
