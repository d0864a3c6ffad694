// SPDX-License-Identifier: Apache-2.0
// The paper's geometry in floating point: what the fixed-point geometry is measured against.
#ifndef TESTS_SUPPORT_ORACLE_H
#define TESTS_SUPPORT_ORACLE_H

#include <stdbool.h>

#include "tests/support/rng.h"
#include "warp_fixed/homography_from_pose.h"

/** Map of a panel point (u, v) in pixels to the world in metres: (point . (u, v, 1)) / (weight . (u, v, 1)). */
typedef struct {
    long double point[3][3], weight[3];
    long double normal[3], through[3]; /**< the least-squares plane, metres */
} oracle_wall_t;

typedef struct {
    long double row[3][3];
    long double weight[3];
} oracle_homography_t;

/** A random wall, camera and pose within the range that the grid's figure holds for. */
typedef struct {
    wall_corners_t corners;
    camera_t camera;
    pose_t pose;
} oracle_case_t;

/** A case with its geometry, once in fixed point and once as the oracle has it. */
typedef struct {
    oracle_case_t c;
    homography_t homography;
    oracle_wall_t wall;
    oracle_homography_t exact;
} oracle_scene_t;

/** Work out the geometry of scene->c. @return false when the fixed-point side refuses wall or pose. */
bool oracle_scene(oracle_scene_t *scene);

/** Four or three corners; the plane by inverse iteration, the homography by Gaussian elimination. */
void oracle_wall(oracle_wall_t *wall, const wall_corners_t *measured);

void oracle_homography(oracle_homography_t *h, const camera_t *camera, const oracle_wall_t *wall, const pose_t *pose);

/** Picture point and depth in metres of panel point (u, v). */
void oracle_point(const oracle_homography_t *h, long double u, long double v, long double xy[2], long double *depth);

/** Angle between the ray to panel point (u, v) and the wall's normal, degrees, 0 to 90. */
double oracle_incidence_deg(const oracle_wall_t *wall, const pose_t *pose, long double u, long double v);

/** Distance of the eye from the wall's plane, metres. */
double oracle_eye_distance_m(const oracle_wall_t *wall, const pose_t *pose);

/** A wall anywhere, keystoned or not, four or three corners; an eye 0.3 to 8 m before it, any roll, looking its way. */
void oracle_random_case(oracle_case_t *out, rng_t *rng);

#endif
