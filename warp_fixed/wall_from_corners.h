// SPDX-License-Identifier: Apache-2.0
// Corner markers -> the wall: its plane, and where on it every projector pixel lands (paper, eq 1 and 2).
#ifndef WARP_FIXED_WALL_FROM_CORNERS_H
#define WARP_FIXED_WALL_FROM_CORNERS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/real.h"

enum { WALL_MAX_MARKERS = 32 };

/** A further measured point of the wall, at a known projector pixel. */
typedef struct {
    int32_t px_q16[2]; /**< projector raster position, Q16 pixels; pixel (i, j) has its centre at i + 1/2, j + 1/2 */
    int32_t um[3];     /**< world position, micrometres */
} wall_marker_t;

/** What was measured. Corners in the order top-left, top-right, bottom-right, bottom-left of the projected picture. */
typedef struct {
    int32_t panel_width, panel_height; /**< projector, pixels, 1 to IMAGE_MAX_WIDTH x IMAGE_MAX_HEIGHT */
    int32_t corner_um[4][3];           /**< world, micrometres */
    bool corner_known[4];              /**< at least three */
    int32_t marker_count;              /**< 0 to WALL_MAX_MARKERS */
    wall_marker_t marker[WALL_MAX_MARKERS];
} wall_corners_t;

/**
 * The projector-to-wall map. A panel point (u, v), in pixels, lies at
 * origin_um + (point[0..2] . (u, v, 1)) / (weight . (u, v, 1)) in the world, micrometres.
 *
 * The weight is 1 at the panel's top-left corner and positive all over the panel; it is 1 everywhere, to 2^-50, when
 * the picture is a parallelogram (eq 2, with the principal point in the middle of the panel).
 */
typedef struct {
    int32_t panel_width, panel_height;
    int32_t origin_um[3];
    real_t point[3][3];
    real_t weight[3];
    int32_t rms_um;    /**< of the measured points' distances from the least-squares plane */
    int32_t worst_um;  /**< the largest of them */
    int32_t marker_um; /**< worst distance, within the plane, between a marker and where the map puts its pixel */
    int32_t skew_mdeg; /**< largest departure of a corner angle from 90 degrees, millidegrees */
} wall_t;

typedef enum {
    WALL_OK = 0,
    WALL_TOO_FEW_CORNERS, /**< fewer than three are known */
    WALL_ON_A_LINE,       /**< the points lie on a line, or in one place: no plane */
    WALL_CROSSED,         /**< the corners do not go round a convex quadrilateral: wrong order, or a corner misread */
    WALL_BAD_SIZE         /**< panel or marker count outside its range */
} wall_status_t;

/**
 * Fit the plane n . X + d = 0 (eq 1) to all points by least squares, project the corners on it, and take the
 * homography through them. With three corners the fourth completes the parallelogram.
 *
 * @param[out] wall      Written only when WALL_OK is returned.
 * @param      measured  Every coordinate within +-2^30 um.
 */
wall_status_t wall_from_corners(wall_t *wall, const wall_corners_t *measured);

/** @return One line that says what the status means, for an error message. Static text. */
const char *wall_status_text(wall_status_t status);

#endif
