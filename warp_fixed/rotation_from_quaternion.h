// SPDX-License-Identifier: Apache-2.0
// Orientation of the viewer -> the rotation R_c of eq 3, world to camera frame.
#ifndef WARP_FIXED_ROTATION_FROM_QUATERNION_H
#define WARP_FIXED_ROTATION_FROM_QUATERNION_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/real.h"

/**
 * R_c: its rows are the camera's axes in the world; the transpose of the quaternion's rotation.
 *
 * @param quaternion_q30  As in pose_t: of any length but zero.
 * @return false when the quaternion is zero; rotation is then untouched.
 */
bool rotation_from_quaternion(real_t rotation[3][3], const int32_t quaternion_q30[4]);

#endif
