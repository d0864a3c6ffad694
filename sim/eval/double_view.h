// SPDX-License-Identifier: Apache-2.0
// Eye, camera and wall in double precision and metres: for evaluation, never for a frame.
#ifndef SIM_EVAL_DOUBLE_VIEW_H
#define SIM_EVAL_DOUBLE_VIEW_H

#include <stdbool.h>

#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/wall_from_corners.h"

/** A viewer's pinhole camera somewhere in the world. */
typedef struct {
    double eye_m[3];
    double world_from_camera[3][3];
    double focal_px[2], principal_px[2];
} double_view_t;

/** @param pose  Its quaternion may have any length but zero. */
void double_view(double_view_t *view, const camera_t *camera, const pose_t *pose);

/** Direction in the world in which the eye sees picture point (x, y); its part along the optical axis is 1. */
void double_view_ray(const double_view_t *view, const double xy_px[2], double ray[3]);

/** @return false, and nothing written, when the world point is not in front of the viewer. */
bool double_view_project(const double_view_t *view, const double point_m[3], double xy_px[2]);

/** A wall's map of panel points: origin_m + (point . (u, v, 1)) / (weight . (u, v, 1)). */
typedef struct {
    double origin_m[3], point[3][3], weight[3];
} double_wall_t;

void double_wall(double_wall_t *out, const wall_t *wall);

/** Where on the wall panel point (u, v) lies, in the world. */
void double_wall_point(const double_wall_t *wall, const double uv_px[2], double point_m[3]);

#endif
