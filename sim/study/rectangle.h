// SPDX-License-Identifier: Apache-2.0
// How rectangular a quadrilateral is: corner angles, and the minimum bounding rectangle (the paper's figures 8 and 9).
#ifndef SIM_STUDY_RECTANGLE_H
#define SIM_STUDY_RECTANGLE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

/** Pixels of a picture: pixel (i, j) has its centre at i + 1/2, j + 1/2. */
typedef struct {
    double x, y;
} rectangle_point_t;

typedef struct {
    double mean_deg, worst_deg; /**< departure of the corner angles from 90 degrees: mean and largest of the four */
    double rectangularity;      /**< area over the area of the minimum bounding rectangle, 0 to 1 */
} rectangle_shape_t;

/**
 * The convex hull.
 *
 * @param[in,out] points  Reordered; the first ones become the hull's corners, in one turn, none on a line between
 * others.
 * @param         spare   Room for 2 * count points.
 * @param         count   2 or more.
 * @return Number of its corners; 2 when all lie on a line.
 */
int32_t rectangle_hull(rectangle_point_t *points, rectangle_point_t *spare, int32_t count);

/**
 * Area of the smallest rectangle of any direction around a convex polygon: one of its sides lies on a side of the
 * polygon, so each is tried. O(count^2).
 */
double rectangle_bounds_area(const rectangle_point_t *hull, int32_t count);

/** Measure a convex quadrilateral. @param corner  In order round it. */
rectangle_shape_t rectangle_shape(const rectangle_point_t corner[4]);

/**
 * Find the one bright convex quadrilateral in a GRAY8 picture, to a few hundredths of a pixel.
 *
 * Its edge is where the brightness, linear between pixel centres, passes half level (127.5). The hull of these points
 * gives first corners; each side is then the line of least squares through the points near it, and neighbours meet in
 * the corners.
 *
 * @param[out] corner  Written only when true is returned: round the quadrilateral, from the one nearest to the top
 * left.
 * @return false when there is none: nothing bright, no four sides of 6 pixels or more, too frayed an edge; or when
 *         memory is out.
 */
bool rectangle_find(const image_t *picture, rectangle_point_t corner[4]);

#endif
