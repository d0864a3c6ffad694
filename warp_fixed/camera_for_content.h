// SPDX-License-Identifier: Apache-2.0
// The camera through which a picture that was drawn from one eye serves another eye, for content at a known depth.
//
// The picture was drawn from the eye C0 with the rotation R_c and the camera K. The viewer's eye is now at C1. The
// content is taken for a plane at depth d before the drawn camera: z = d in its frame. With c = R_c (C1 - C0), the new
// eye in that frame, and y = R_c (X - C1), a wall point X from the new eye, the ray from C1 through X meets the plane
// at
//     P = c + y (d - c_z) / y_z   and there the picture shows   K P = K (y (1 - c_z / d) + c y_z / d),
// all but for a factor of d / y_z. That is eq 3 with the pose (C1, R_c) and another camera:
//     focal' = focal (1 - c_z / d),   principal' = principal + focal (c_x, c_y) / d.
// So homography_from_pose() takes it as it is. For content far away c / d vanishes and the camera is the picture's own.
#ifndef WARP_FIXED_CAMERA_FOR_CONTENT_H
#define WARP_FIXED_CAMERA_FOR_CONTENT_H

#include "warp_fixed/homography_from_pose.h"

/** The eye may have moved by so many depths of the content, sideways and back; and forth by that less of all but one
 *  part in so many. */
enum { CAMERA_FOR_CONTENT_DEPTHS = 8 };

/**
 * @param[out] corrected  The camera for homography_from_pose() with the pose (eye_nm, drawn's orientation). Rounded to
 *                        10^-6 px. Untouched when false is returned. May be the same as camera.
 * @param      camera     The picture's.
 * @param      drawn      What the picture was drawn for.
 * @param      eye_nm     Where the viewer's eye is now; range as in pose_t.
 * @param      depth_um   Of the content; < 2^40.
 * @return false when the eye has moved by more than CAMERA_FOR_CONTENT_DEPTHS allows, or depth_um <= 0, or the
 * quaternion is zero.
 */
bool camera_for_content(camera_t *corrected, const camera_t *camera, const pose_t *drawn, const int64_t eye_nm[3],
                        int64_t depth_um);

#endif
