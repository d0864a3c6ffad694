// SPDX-License-Identifier: Apache-2.0
// A homography from nine doubles, for tests that need no room.
#ifndef TESTS_SUPPORT_HOMOGRAPHY_OF_H
#define TESTS_SUPPORT_HOMOGRAPHY_OF_H

#include "warp_fixed/homography_from_pose.h"

typedef struct {
    int32_t panel_width, panel_height;
    int32_t picture_width, picture_height;
} homography_sizes_t;

/**
 * @param rows  Three rows of three: panel point (u, v, 1) to picture point; the third row is the depth in um (the
 *              weight is 1 everywhere).
 */
homography_t homography_of(const double rows[9], homography_sizes_t sizes);

#endif
