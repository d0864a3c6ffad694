// SPDX-License-Identifier: Apache-2.0
// Windows of 4 x 4 texels whose outer weights are negative and whose inner ones are not: Keys' cubic.
#ifndef WARP_FIXED_RESAMPLE_CUBIC_NEON_H
#define WARP_FIXED_RESAMPLE_CUBIC_NEON_H

#include <stdbool.h>

#include "warp_fixed/window_patch_neon.h"

static inline bool window_is_cubic(const window_t *window)
{
    return window->x.negative && window->x.taps == CUBIC_TAPS && window->y.taps == CUBIC_TAPS;
}

weigh_patch_fn resample_cubic_gray_neon;
weigh_patch_fn resample_cubic_xrgb_neon;

#endif
