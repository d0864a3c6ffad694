// SPDX-License-Identifier: Apache-2.0
// A homography from nine doubles, for tests that need no room.
#include "tests/support/homography_of.h"

#include <math.h>

static real_t real_of(double value)
{
    int exponent;
    const double fraction = frexp(value, &exponent);
    return real_from_int((int64_t)ldexp(fraction, 53), exponent - 53);
}

homography_t homography_of(const double rows[9], homography_sizes_t sizes)
{
    homography_t homography = {.weight = {real_of(0.0), real_of(0.0), real_of(1.0)},
                               .panel_width = sizes.panel_width,
                               .panel_height = sizes.panel_height,
                               .picture_width = sizes.picture_width,
                               .picture_height = sizes.picture_height};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            homography.row[r][k] = real_of(rows[3 * r + k]);
    return homography;
}
