// SPDX-License-Identifier: Apache-2.0
// Rotations as unit quaternions in Q30: logarithm, exponential, and the way between two of them.
//
// Components are w, x, y, z as in pose_t. Rotation vectors are axis times angle, radians in Q30. Integers only, bounded
// time; results are within 10^-5 degrees unless told otherwise. Outputs may be inputs.
#ifndef FIRMWARE_QUATERNION_H
#define FIRMWARE_QUATERNION_H

#include <stdbool.h>
#include <stdint.h>

/** @return false when q is shorter than 2^-10; unit is then untouched. */
bool quaternion_normalise(int32_t unit[4], const int32_t q[4]);

/** The rotation vector that leads from one orientation to another, in the frame of the first, at most half a turn:
 *  to = from exp(vector). Within 0.0003 degrees at half a turn, 10^-5 degrees up to a quarter. */
void quaternion_between(int64_t vector_q30[3], const int32_t from[4], const int32_t to[4]);

/** turned = from exp(vector). Components of the vector are clamped to 8 radians. */
void quaternion_turn(int32_t turned[4], const int32_t from[4], const int64_t vector_q30[3]);

/** The orientation a part of the way from one to another, at constant speed, the short way round. part_q30: 0 to 2^30.
 */
void quaternion_slerp(int32_t middle[4], const int32_t from[4], const int32_t to[4], int32_t part_q30);

#endif
