// SPDX-License-Identifier: Apache-2.0
// A homography out of a fuzzer's input.
#ifndef TESTS_FUZZ_INPUT_HOMOGRAPHY_H
#define TESTS_FUZZ_INPUT_HOMOGRAPHY_H

#include "tests/fuzz/input.h"
#include "warp_fixed/homography_from_pose.h"

typedef struct {
    bool by_numbers; /**< its nine numbers, also such as no wall gives; else corners, camera and pose */
    bool gentle;     /**< of these numbers: most light many pixels */
    bool even;       /**< all sizes are */
} input_homography_t;

/**
 * Make one for a panel and a picture of 1 to 160 pixels along each axis, mostly small. By a wall, no input gives a
 * viewer 2 m before a wall of 2 m that fills the picture, every number of it is added to that; and what the wall says
 * of itself is checked.
 *
 * @param[out] homography  Written only when true is returned.
 * @return false when the wall or the pose is refused.
 */
bool input_homography(homography_t *homography, input_t *input, input_homography_t kind);

#endif
