// SPDX-License-Identifier: Apache-2.0
// Homography -> the step k of a frame: how far apart neighbouring pixels are in the picture at most.
//
// Why one pair of pixels stands for its line (a row or a column). Along a line x, y and w are linear in the pixel, so
// neighbours' picture points differ by (x' w - x w', y' w - y w') / (w w'), whose numerator is the same all along the
// line and linear from line to line: the largest step of a line is where w is least, at an end of the line's part in
// the picture. From one line to the next, an edge of the picture cuts lines ever further on or ever further back, so
// following it takes no more steps over all lines than there are pixels in one.
#include "warp_fixed/footprint_from_homography.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/real_vector.h"

enum { FORM_BITS = 60, MAX_EDGES = 5 };

static const int32_t least_exponent = -(1 << 20); /* beyond all that any homography leads to */

/* Rounding along and across to integers moves a form by at most 4096 over the panel, and the reals' own errors less. */
static const int64_t form_error = 1 << 14;

/* Value of a linear form at pixel i of line j: along * i + across * j + first. |value| <= 2^60 on the panel. */
typedef struct {
    int64_t along, across, first;
} form_t;

/* The panel's pixel centres, line by line. */
typedef struct {
    int axis; /* 0: lines are rows, 1: columns */
    int32_t length, count;
    bool in_front;           /* all of the panel */
    form_t w, change[2];     /* change / (w w') is the way from a pixel's point to the next one's, */
    int32_t change_exponent; /* * 2^change_exponent, but for w's scale, which both axes share */
} lines_t;

/* Where on a line a form becomes >= 0: pixel `at`, counted from the line's end when from_end, has `value`. */
typedef struct {
    int64_t along, across, value;
    int32_t at;
    bool from_end;
} edge_t;

/* mantissa * 2^exponent; 2^30 <= mantissa < 2^32, or 0 with the least exponent. */
typedef struct {
    uint32_t mantissa;
    int32_t exponent;
} short_t;

/* Pixels i and i + 1 of line j; their points are sqrt(square / depth) apart. */
typedef struct {
    short_t square, depth;
    int axis;
    int32_t ij[2];
} pair_t;

/* What |form| cannot exceed on the panel. */
static real_t form_bound(const homography_t *h, const real_t form[3])
{
    const real_t along = real_mul(real_abs(form[0]), real_from_int(h->panel_width, 0));
    const real_t across = real_mul(real_abs(form[1]), real_from_int(h->panel_height, 0));
    return real_add(real_add(along, across), real_abs(form[2]));
}

static int32_t form_bits(real_t bound)
{
    return FORM_BITS - (bound.exponent + 63);
}

static form_t form_from_reals(const real_t form[3], int axis, real_t bound)
{
    const int32_t bits = form_bits(bound);
    const int64_t limit = (int64_t)1 << FORM_BITS;
    const real_t first = real_add(form[2], real_scale(real_add(form[0], form[1]), -1));
    return (form_t){real_to_fixed(form[axis], bits, limit), real_to_fixed(form[1 - axis], bits, limit),
                    real_to_fixed(first, bits, limit)};
}

static int64_t form_at(const form_t *form, int32_t i, int32_t j)
{
    return form->along * i + form->across * j + form->first;
}

static int64_t form_least(const form_t *form, const lines_t *lines)
{
    return form_at(form, form->along < 0 ? lines->length - 1 : 0, form->across < 0 ? lines->count - 1 : 0);
}

static void lines_from_homography(lines_t *lines, const homography_t *h, int axis)
{
    lines->axis = axis;
    lines->length = axis == 0 ? h->panel_width : h->panel_height;
    lines->count = axis == 0 ? h->panel_height : h->panel_width;
    lines->w = form_from_reals(h->row[2], axis, form_bound(h, h->row[2]));
    lines->in_front = form_least(&lines->w, lines) >= form_error;

    real_t change[2][3], bound = real_from_int(0, 0);
    for (int a = 0; a < 2; a++) {
        for (int k = 0; k < 3; k++)
            change[a][k] = real_sub(real_mul(h->row[a][axis], h->row[2][k]), real_mul(h->row[2][axis], h->row[a][k]));
        bound = real_add(bound, form_bound(h, change[a]));
    }
    for (int a = 0; a < 2; a++)
        lines->change[a] = form_from_reals(change[a], axis, bound);
    lines->change_exponent = -form_bits(bound);
}

/* Edges that cut the panel: of the half-planes in front of the viewer and on the picture's side of its four edges. */
static int edges_from_homography(edge_t edge[MAX_EDGES], const homography_t *h, const lines_t *lines)
{
    const int32_t size[2] = {h->picture_width, h->picture_height};
    form_t form[MAX_EDGES];
    for (int a = 0; a < 2; a++) {
        real_t beyond[3];
        for (int k = 0; k < 3; k++)
            beyond[k] = real_sub(real_mul(real_from_int(size[a], 0), h->row[2][k]), h->row[a][k]);
        form[2 * a] = form_from_reals(h->row[a], lines->axis, form_bound(h, h->row[a]));
        form[2 * a + 1] = form_from_reals(beyond, lines->axis, form_bound(h, beyond));
        form[2 * a].first += form_error; /* a centre on the picture's edge is in it */
        form[2 * a + 1].first += form_error;
    }
    form[4] = lines->w;
    form[4].first -= form_error; /* depth 0 is behind */

    int count = 0;
    for (int e = 0; e < MAX_EDGES; e++) {
        const form_t *f = &form[e];
        if (form_least(f, lines) >= 0)
            continue;
        if (f->along >= 0)
            edge[count++] = (edge_t){f->along, f->across, f->first, 0, false};
        else
            edge[count++] = (edge_t){-f->along, f->across, form_at(f, lines->length - 1, 0), 0, true};
    }
    return count;
}

/* @return The first pixel of this line with value >= 0, `length` when none has; the edge goes on to the next line. */
static int32_t edge_next(edge_t *edge, int32_t length)
{
    int64_t value = edge->value;
    int32_t at = edge->at;
    for (; at > 0 && value >= edge->along; at--)
        value -= edge->along;
    for (; at < length && value < 0; at++)
        value += edge->along;
    edge->at = at;
    edge->value = value + edge->across;
    return at;
}

static short_t short_from_wide(uint128_t wide)
{
    const uint64_t high = (uint64_t)(wide >> 64), low = (uint64_t)wide;
    if (high >> 31 != 0) { /* the common case: it has all bits of the mantissa */
        const int zeros = __builtin_clzll(high);
        return (short_t){(uint32_t)(high << zeros >> 32), 96 - zeros};
    }
    if (wide == 0)
        return (short_t){0, least_exponent};
    const int zeros = high != 0 ? __builtin_clzll(high) : 64 + __builtin_clzll(low);
    return (short_t){(uint32_t)(wide << zeros >> 96), 96 - zeros};
}

/* Take the pair at pixel i of line j for *largest when it is larger, by more than 2^-28 of it. */
static inline void consider(pair_t *largest, const lines_t *lines, short_t square, int32_t i, int32_t j)
{
    const int64_t w = form_at(&lines->w, i, j);
    const short_t once = short_from_wide((uint128_t)w * (uint64_t)(w + lines->w.along));
    const short_t depth = {(uint32_t)((uint64_t)once.mantissa * once.mantissa >> 32), 2 * once.exponent + 32};

    const uint64_t this = (uint64_t)square.mantissa * largest->depth.mantissa;
    const uint64_t that = (uint64_t)largest->square.mantissa * depth.mantissa;
    const int32_t lead = square.exponent + largest->depth.exponent - largest->square.exponent - depth.exponent;
    if (lead <= -3 || (lead < 3 && (lead < 0 ? this >> -lead <= that : this <= that >> lead)))
        return; /* both are 0 or in [2^61, 2^64): a lead of 3 decides */
    *largest = (pair_t){square, depth, lines->axis, {i, j}};
}

/* Go through the lines for the largest pair in the picture and, where all is in front, the largest of all. */
static void find_largest(pair_t *in, pair_t *all, const lines_t *lines, edge_t *edge, int edges)
{
    const bool nearer_on = lines->w.along < 0;
    for (int32_t j = 0; j < lines->count; j++) {
        int32_t first = 0, last = lines->length - 1;
        for (int e = 0; e < edges; e++) {
            const int32_t at = edge_next(&edge[e], lines->length);
            if (edge[e].from_end)
                last = lines->length - 1 - at < last ? lines->length - 1 - at : last;
            else
                first = at > first ? at : first;
        }
        const int64_t x = form_at(&lines->change[0], 0, j), y = form_at(&lines->change[1], 0, j);
        short_t square = short_from_wide((uint128_t)((int128_t)x * x + (int128_t)y * y));
        square.exponent += 2 * lines->change_exponent;
        if (first < last)
            consider(in, lines, square, nearer_on ? last - 1 : first, j);
        if (lines->in_front && lines->length > 1)
            consider(all, lines, square, nearer_on ? lines->length - 2 : 0, j);
    }
}

static int32_t distance_q16(const homography_t *h, const pair_t *pair)
{
    if (pair->square.mantissa == 0)
        return 0;
    real_t point[2][2];
    for (int end = 0; end < 2; end++) {
        real_t at[3];
        at[pair->axis] = real_from_int(2 * (int64_t)(pair->ij[0] + end) + 1, -1);
        at[1 - pair->axis] = real_from_int(2 * (int64_t)pair->ij[1] + 1, -1);
        at[2] = real_from_int(1, 0);
        const real_t w = vector_dot(h->row[2], at);
        for (int a = 0; a < 2; a++)
            point[end][a] = real_div(vector_dot(h->row[a], at), w);
    }
    real_t square = real_from_int(0, 0);
    for (int a = 0; a < 2; a++) {
        const real_t way = real_sub(point[1][a], point[0][a]);
        square = real_add(square, real_mul(way, way));
    }
    return (int32_t)real_to_fixed(real_sqrt(square), 16, FOOTPRINT_MAX_STEP_Q16);
}

footprint_step_t footprint_step(const homography_t *homography)
{
    const pair_t none = {.square = {0, least_exponent}};
    pair_t in = none, all = none;
    lines_t lines;
    for (int axis = 0; axis < 2; axis++) {
        edge_t edge[MAX_EDGES];
        lines_from_homography(&lines, homography, axis);
        const int edges = edges_from_homography(edge, homography, &lines);
        find_largest(&in, &all, &lines, edge, edges);
    }
    return (footprint_step_t){distance_q16(homography, &in),
                              lines.in_front ? distance_q16(homography, &all) : FOOTPRINT_MAX_STEP_Q16,
                              {in.ij[in.axis], in.ij[1 - in.axis]}};
}
