// SPDX-License-Identifier: Apache-2.0
// Measured points -> the least-squares plane through them (paper, eq 1).
#ifndef WARP_FIXED_PLANE_FROM_POINTS_H
#define WARP_FIXED_PLANE_FROM_POINTS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/real.h"

enum { PLANE_MAX_POINTS = 36 };

/** Points to fit; in whatever unit, micrometres here. */
typedef struct {
    int count; /**< 1 to PLANE_MAX_POINTS */
    real_t at[PLANE_MAX_POINTS][3];
} cloud_t;

/** A frame on the plane: its origin is the mean of the points; x, y along it and n = x cross y are unit vectors. */
typedef struct {
    real_t mean[3];
    real_t x[3], y[3], n[3];
} plane_t;

/**
 * The plane n . (X - mean) = 0 of least squared distances: n is the direction of the points' least variance.
 *
 * @return false, with *plane unspecified, when the points lie on a line or in one place: when their second variance is
 *         below 10^-6 of the first.
 */
bool plane_from_points(plane_t *plane, const cloud_t *cloud);

/** Coordinates of a point's projection in the plane's frame. */
void plane_coordinates(real_t xy[2], const plane_t *plane, const real_t at[3]);

/** Root mean square and largest distance of the points from the plane, rounded, saturated to INT32_MAX. */
void plane_residuals(int32_t *rms, int32_t *worst, const plane_t *plane, const cloud_t *cloud);

#endif
