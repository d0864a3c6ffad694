// SPDX-License-Identifier: Apache-2.0
// Orientations as the protocols write them -> quaternions: the one place where angles become a rotation.
//
// All turns are active and follow the right-hand rule in the coordinates they are given in: a positive turn about x
// takes +y towards +z, about y +z towards +x, about z +x towards +y. Quaternions are w, x, y, z and turn vectors of
// the turned body into vectors of the frame that it is turned in. In left-handed axes the formulas are the same.
#ifndef SIM_TRACKERS_TRACKER_ROTATION_H
#define SIM_TRACKERS_TRACKER_ROTATION_H

#include <stdbool.h>

/** c = a b: first b, then a. c may be a or b. */
void tracker_rotation_multiply(double c[4], const double a[4], const double b[4]);

/** out = vector turned by a unit quaternion. out may be vector. */
void tracker_rotation_apply(double out[3], const double quaternion[4], const double vector[3]);

/**
 * Three turns about the body's own axes, one after the other (intrinsic): "zxy" with {a, b, c} is the matrix
 * Rz(a) Rx(b) Ry(c).
 *
 * @param axes     Three letters of x, y, z.
 * @param degrees  Any; when one is not finite, the quaternion is not.
 */
void tracker_rotation_from_angles(double quaternion[4], const char axes[3], const double degrees[3]);

/** A rotation vector: its direction is the axis, its length the angle in radians. */
void tracker_rotation_from_vector(double quaternion[4], const double radians[3]);

/**
 * A rotation matrix, row by row.
 *
 * @param[out] quaternion  Written only when true is returned; unit length, w >= 0.
 * @return false when the matrix is no rotation: columns not of unit length and at right angles within 0.01, or
 * mirrored.
 */
bool tracker_rotation_from_matrix(double quaternion[4], const double matrix[3][3]);

#endif
