// SPDX-License-Identifier: Apache-2.0
// Pose of the viewer -> homography from projector pixel to picture point (paper, eq 3).
#ifndef WARP_FIXED_HOMOGRAPHY_FROM_POSE_H
#define WARP_FIXED_HOMOGRAPHY_FROM_POSE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/real.h"
#include "warp_fixed/wall_from_corners.h"

/** Where the viewer's eye is and how it looks. The quaternion turns camera-frame vectors into world vectors. */
typedef struct {
    int64_t eye_nm[3];         /**< world, nanometres; |each| < 2^50 */
    int32_t quaternion_q30[4]; /**< w, x, y, z in Q30; need not be of unit length, but not zero */
} pose_t;

/** The viewer's virtual pinhole camera K_c. Micro-pixels: an exact decimal stays exact. */
typedef struct {
    int32_t width, height;    /**< picture, pixels, 1 to IMAGE_MAX_WIDTH x IMAGE_MAX_HEIGHT */
    int64_t focal_upx[2];     /**< 10^-6 px, > 0 */
    int64_t principal_upx[2]; /**< 10^-6 px */
} camera_t;

/**
 * Maps a panel point to a picture point: (x, y) = (row 0, row 1) . (u, v, 1) / (row 2 . (u, v, 1)).
 *
 * Row 2 has the sign of the depth in front of the viewer; row 2 . (u, v, 1) / (weight . (u, v, 1)) is the depth in um.
 */
typedef struct {
    real_t row[3][3];
    real_t weight[3]; /**< the wall's */
    int32_t panel_width, panel_height;
    int32_t picture_width, picture_height;
} homography_t;

/** @return false when the quaternion is zero; *homography is then untouched. */
bool homography_from_pose(homography_t *homography, const camera_t *camera, const wall_t *wall, const pose_t *pose);

/**
 * A homography given by its nine numbers, for measurements without a room.
 *
 * @param rows_q40  Row by row, Q40: from pixel index (i, j) to picture index, as a table of OpenCV's kind has it; the
 *                  half-pixel shift to raster points on both sides is made here.
 */
void homography_from_indices(homography_t *homography, const int64_t rows_q40[3][3], const int32_t panel[2],
                             const int32_t picture[2]);

/** @return Does the viewer see the wall from behind, so that its picture is mirrored (rear projection)? */
bool homography_is_mirrored(const homography_t *homography);

/** @return Depth in front of the viewer of panel point (u, v), both in half pixels (2 i + 1 is a centre), um. */
int64_t homography_depth_um(const homography_t *homography, int32_t u_half, int32_t v_half);

#endif
