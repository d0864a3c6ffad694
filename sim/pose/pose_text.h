// SPDX-License-Identifier: Apache-2.0
// Text -> pose: seven decimal numbers, exactly.
#ifndef SIM_POSE_POSE_TEXT_H
#define SIM_POSE_POSE_TEXT_H

#include <stdbool.h>

#include "warp_fixed/homography_from_pose.h"

enum { POSE_TEXT_FIELDS = 7, POSE_TEXT_MESSAGE_LENGTH = 256 };

/** x_mm y_mm z_mm qw qx qy qz */
extern const char *const pose_text_field_name[POSE_TEXT_FIELDS];

/**
 * Seven numbers -> pose. Positions are rounded to 1 nm, six decimals of a millimetre, the quaternion's components
 * to Q30. It keeps its length: homography_from_pose() divides by it.
 *
 * @param      field  Decimal numbers without spaces, in the order of pose_text_field_name; exponents are allowed.
 * @param[out] pose   Written only when true is returned.
 * @param[out] error  On failure: "NAME: what was found, what was expected".
 * @return false when a field is not a number, a position lies beyond +-1000 m, or the quaternion's length is not within
 *         1 % of 1.
 */
bool pose_from_fields(const char *const field[POSE_TEXT_FIELDS], pose_t *pose, char error[POSE_TEXT_MESSAGE_LENGTH]);

/**
 * The same from one text, the numbers separated by spaces or tabs: "0 0 -2000 1 0 0 0".
 *
 * @param[out] error  On failure: one line without newline.
 */
bool pose_from_text(const char *text, pose_t *pose, char error[POSE_TEXT_MESSAGE_LENGTH]);

#endif
