// SPDX-License-Identifier: Apache-2.0
// Linear interpolation: its weights follow from the phases, without a table.
#ifndef WARP_FIXED_RESAMPLE_LINEAR_NEON_H
#define WARP_FIXED_RESAMPLE_LINEAR_NEON_H

#include "warp_fixed/window_patch_neon.h"

enum { RESAMPLE_LINEAR_STEP = 8 };

weigh_patch_fn resample_linear_gray_neon;
weigh_patch_fn resample_linear_xrgb_neon;

#endif
