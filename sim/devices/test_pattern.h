// SPDX-License-Identifier: Apache-2.0
// The built-in test picture: colour bars, a gray ramp, a grid and a moving bar.
#ifndef SIM_DEVICES_TEST_PATTERN_H
#define SIM_DEVICES_TEST_PATTERN_H

#include <stdint.h>

#include "warp_fixed/image.h"

enum { TEST_PATTERN_STEPS = 64 };

/**
 * Draw picture number index. Integers only: the same bytes everywhere.
 *
 * Upper two thirds: eight 75 % colour bars (white, yellow, cyan, green, magenta, red, blue, black). Lower third: gray
 * from 0 at the left to 255 at the right. Over them white lines one pixel wide: the frame, and a grid of 16 x 9 cells.
 * On top a bar of 1/64 of the width (at least 1 px) that moves right by 1/64 of the width per picture, and repeats
 * after TEST_PATTERN_STEPS pictures: orange, so that it differs from everything below it.
 *
 * @param image  Any size and format; every pixel is written.
 */
void test_pattern_draw(const image_t *image, int64_t index);

#endif
