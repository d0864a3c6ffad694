// SPDX-License-Identifier: Apache-2.0
// Finds a bright quadrilateral in a picture, with its corners between pixels.
#include <math.h>
#include <stdlib.h>

#include "sim/study/rectangle.h"

static const double half_level = 127.5;
static const double near_px = 3.0;         /* a side's points are so near to its first guess */
static const double area_share = 0.03;     /* the figure and the quadrilateral differ by less of their area */
static const double left_out_share = 0.08; /* of a side, at both ends: corners are rounded by the pixels */

enum { REFINEMENTS = 3 };

typedef struct {
    rectangle_point_t *point;
    int32_t count, room;
} edge_t;

/* Where the brightness passes half level between two neighbours' centres. */
static void add_crossing(edge_t *edge, const image_t *picture, int32_t x, int32_t y, int32_t across)
{
    const double here = image_row(picture, y)[x], next = image_row(picture, y + 1 - across)[x + across];
    if ((here < half_level) == (next < half_level))
        return;
    const double share = (half_level - here) / (next - here);
    if (edge->count < edge->room)
        edge->point[edge->count] = (rectangle_point_t){x + 0.5 + across * share, y + 0.5 + (1 - across) * share};
    edge->count++;
}

/* @return false when there are none, or more than any convex figure has. */
static bool find_edge(edge_t *edge, const image_t *picture)
{
    for (int32_t y = 0; y < picture->height; y++)
        for (int32_t x = 0; x < picture->width; x++) {
            if (x + 1 < picture->width)
                add_crossing(edge, picture, x, y, 1);
            if (y + 1 < picture->height)
                add_crossing(edge, picture, x, y, 0);
        }
    return edge->count >= 8 && edge->count <= edge->room;
}

static double off_line(rectangle_point_t from, rectangle_point_t to, rectangle_point_t point)
{
    return ((to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x)) /
           hypot(to.x - from.x, to.y - from.y);
}

/* The two hull points farthest from each other. */
static void farthest_pair(const rectangle_point_t *hull, int32_t count, int32_t pair[2])
{
    double farthest = -1.0;
    for (int32_t a = 0; a < count; a++)
        for (int32_t b = a + 1; b < count; b++) {
            const double distance = hypot(hull[a].x - hull[b].x, hull[a].y - hull[b].y);
            if (distance > farthest) {
                farthest = distance;
                pair[0] = a;
                pair[1] = b;
            }
        }
}

/*
 * First corners, indices into the hull in its order: the farthest pair, the point farthest from their line, and the
 * point farthest outside that triangle.
 */
static void first_corners(const rectangle_point_t *hull, int32_t count, int32_t corner[4])
{
    farthest_pair(hull, count, corner);
    double farthest = -1.0;
    for (int32_t n = 0; n < count; n++) {
        const double off = fabs(off_line(hull[corner[0]], hull[corner[1]], hull[n]));
        if (off > farthest) {
            farthest = off;
            corner[2] = n;
        }
    }
    for (int n = 2; n > 0 && corner[n] < corner[n - 1]; n--) {
        const int32_t swapped = corner[n];
        corner[n] = corner[n - 1];
        corner[n - 1] = swapped;
    }
    farthest = -1.0;
    int place = 3;
    for (int side = 0; side < 3; side++) {
        const int32_t from = corner[side], to = corner[(side + 1) % 3];
        for (int32_t n = (from + 1) % count; n != to; n = (n + 1) % count) {
            const double off = fabs(off_line(hull[from], hull[to], hull[n]));
            if (off > farthest) {
                farthest = off;
                corner[3] = n;
                place = side + 1;
            }
        }
    }
    const int32_t last = corner[3];
    for (int n = 3; n > place; n--)
        corner[n] = corner[n - 1];
    corner[place] = last;
}

/* A line: through a point, along (x, y). */
typedef struct {
    rectangle_point_t through, along;
} line_t;

static bool line_of_side(line_t *line, const edge_t *edge, rectangle_point_t from, rectangle_point_t to)
{
    const double length = hypot(to.x - from.x, to.y - from.y);
    if (length < 2.0 * near_px)
        return false; /* the ragged tip of a figure without four sides */
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
    for (int32_t e = 0; e < edge->count; e++) {
        const double x = edge->point[e].x - from.x, y = edge->point[e].y - from.y;
        const double share = (x * (to.x - from.x) + y * (to.y - from.y)) / (length * length);
        if (share < left_out_share || share > 1.0 - left_out_share ||
            fabs(off_line(from, to, edge->point[e])) > near_px)
            continue;
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        syy += y * y;
    }
    if (n < 2.0)
        return false;
    const double xx = sxx / n - sx / n * (sx / n), xy = sxy / n - sx / n * (sy / n), yy = syy / n - sy / n * (sy / n);
    const double angle = 0.5 * atan2(2.0 * xy, xx - yy);
    *line = (line_t){{from.x + sx / n, from.y + sy / n}, {cos(angle), sin(angle)}};
    return true;
}

static bool meet(rectangle_point_t *point, const line_t *a, const line_t *b)
{
    const double sine = a->along.x * b->along.y - a->along.y * b->along.x;
    if (fabs(sine) < 0.05)
        return false;
    const double x = b->through.x - a->through.x, y = b->through.y - a->through.y;
    const double far = (x * b->along.y - y * b->along.x) / sine;
    *point = (rectangle_point_t){a->through.x + far * a->along.x, a->through.y + far * a->along.y};
    return true;
}

static bool refine(rectangle_point_t corner[4], const edge_t *edge)
{
    line_t side[4];
    for (int n = 0; n < 4; n++)
        if (!line_of_side(&side[n], edge, corner[n], corner[(n + 1) % 4]))
            return false;
    for (int n = 0; n < 4; n++)
        if (!meet(&corner[n], &side[(n + 3) % 4], &side[n]))
            return false;
    return true;
}

static double area(const rectangle_point_t *polygon, int32_t count)
{
    double twice = 0.0;
    for (int32_t n = 0; n < count; n++) {
        const rectangle_point_t here = polygon[n], next = polygon[(n + 1) % count];
        twice += here.x * next.y - here.y * next.x;
    }
    return fabs(twice) / 2.0;
}

static bool fit(rectangle_point_t corner[4], const edge_t *edge, rectangle_point_t *hull, rectangle_point_t *spare)
{
    for (int32_t e = 0; e < edge->count; e++)
        hull[e] = edge->point[e];
    const int32_t count = rectangle_hull(hull, spare, edge->count);
    if (count < 4)
        return false;
    int32_t first[4];
    rectangle_point_t found[4];
    first_corners(hull, count, first);
    for (int n = 0; n < 4; n++)
        found[n] = hull[first[n]];
    for (int r = 0; r < REFINEMENTS; r++)
        if (!refine(found, edge))
            return false;
    if (fabs(area(found, 4) - area(hull, count)) > area_share * area(hull, count))
        return false;
    int top_left = 0;
    for (int n = 1; n < 4; n++)
        if (found[n].x + found[n].y < found[top_left].x + found[top_left].y)
            top_left = n;
    for (int n = 0; n < 4; n++)
        corner[n] = found[(top_left + n) % 4];
    return true;
}

bool rectangle_find(const image_t *picture, rectangle_point_t corner[4])
{
    /* a convex figure's edge crosses each row and each column twice at most; as many again for ragged ones */
    const int32_t room = 4 * (picture->width + picture->height);
    rectangle_point_t *points = malloc((size_t)room * 4 * sizeof *points);
    if (points == NULL)
        return false;
    edge_t edge = {.point = points, .room = room};
    const bool found = find_edge(&edge, picture) && fit(corner, &edge, points + room, points + 2 * room);
    free(points);
    return found;
}
