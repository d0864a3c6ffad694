// SPDX-License-Identifier: Apache-2.0
// How rectangular a quadrilateral is: corner angles, and the minimum bounding rectangle.
#include "sim/study/rectangle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Twice the area of the triangle o, a, b; positive when they turn from x to y. */
static double turn(rectangle_point_t o, rectangle_point_t a, rectangle_point_t b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

static int by_x_then_y(const void *left, const void *right)
{
    const rectangle_point_t *a = left, *b = right;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    return (a->y > b->y) - (a->y < b->y);
}

/* One half of the monotone chain: points in the order of step, laid on hull from `size` on. */
static int32_t add_chain(rectangle_point_t *hull, int32_t size, const rectangle_point_t *points, int32_t count,
                         int32_t step)
{
    const int32_t least = size + 1;
    for (int32_t n = 0; n < count; n++) {
        const rectangle_point_t point = points[step > 0 ? n : count - 1 - n];
        while (size > least && turn(hull[size - 2], hull[size - 1], point) <= 0.0)
            size--;
        hull[size++] = point;
    }
    return size - 1; /* its last point begins the other half */
}

int32_t rectangle_hull(rectangle_point_t *points, rectangle_point_t *spare, int32_t count)
{
    qsort(points, (size_t)count, sizeof *points, by_x_then_y);
    const int32_t half = add_chain(spare, 0, points, count, 1);
    const int32_t size = add_chain(spare, half, points, count, -1);
    memcpy(points, spare, (size_t)size * sizeof *points);
    return size;
}

double rectangle_bounds_area(const rectangle_point_t *hull, int32_t count)
{
    double least = HUGE_VAL;
    for (int32_t n = 0; n < count; n++) {
        const rectangle_point_t from = hull[n], to = hull[(n + 1) % count];
        const double length = hypot(to.x - from.x, to.y - from.y);
        const double x = (to.x - from.x) / length, y = (to.y - from.y) / length;
        double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
        for (int32_t m = 0; m < count; m++) {
            const double at[2] = {x * hull[m].x + y * hull[m].y, x * hull[m].y - y * hull[m].x};
            for (int axis = 0; axis < 2; axis++) {
                low[axis] = fmin(low[axis], at[axis]);
                high[axis] = fmax(high[axis], at[axis]);
            }
        }
        least = fmin(least, (high[0] - low[0]) * (high[1] - low[1]));
    }
    return least;
}

rectangle_shape_t rectangle_shape(const rectangle_point_t corner[4])
{
    rectangle_shape_t shape = {0};
    double twice_area = 0.0;
    for (int n = 0; n < 4; n++) {
        const rectangle_point_t here = corner[n], before = corner[(n + 3) % 4], after = corner[(n + 1) % 4];
        const double ahead_x = after.x - here.x, ahead_y = after.y - here.y;
        const double back_x = before.x - here.x, back_y = before.y - here.y;
        const double angle = atan2(fabs(ahead_x * back_y - ahead_y * back_x), ahead_x * back_x + ahead_y * back_y);
        const double off_deg = fabs(angle * 180.0 / 3.14159265358979323846 - 90.0);
        shape.mean_deg += off_deg / 4.0;
        shape.worst_deg = fmax(shape.worst_deg, off_deg);
        twice_area += here.x * after.y - here.y * after.x;
    }
    shape.rectangularity = fabs(twice_area) / 2.0 / rectangle_bounds_area(corner, 4);
    return shape;
}
