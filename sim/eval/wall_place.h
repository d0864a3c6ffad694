// SPDX-License-Identifier: Apache-2.0
// Where a wall is in the room, in millimetres: for choosing places to look at it from.
#ifndef SIM_EVAL_WALL_PLACE_H
#define SIM_EVAL_WALL_PLACE_H

#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/wall_from_corners.h"

/** Vectors of length 1 lie in the wall's plane, but for front. */
typedef struct {
    double corner_mm[4][3]; /**< top-left, top-right, bottom-right, bottom-left of the projected picture */
    double centre_mm[3];    /**< where the middle of the panel is */
    double top[3];          /**< from the picture's bottom edge to its top */
    double front[3];        /**< across the plane, to the side from which the picture is not mirrored */
} wall_place_t;

void wall_place(wall_place_t *place, const wall_t *wall);

/** @return Distance of a point from the wall's plane, mm; negative behind it. */
double wall_place_distance_mm(const wall_place_t *place, const double at_mm[3]);

/**
 * The pose of a viewer who looks at the wall's centre.
 *
 * @param eye_mm  Within 1000 m; not the centre itself.
 * @param up      Of length 1: it is upwards in the viewer's picture. Who looks straight up or down has the wall's top
 * there.
 */
pose_t wall_place_look(const wall_place_t *place, const double eye_mm[3], const double up[3]);

#endif
