// SPDX-License-Identifier: Apache-2.0
// Short windows of gray or chroma texels some of whose weights are negative. Of the resample_window_* files only.
#ifndef WARP_FIXED_RESAMPLE_PAIRS_NEON_H
#define WARP_FIXED_RESAMPLE_PAIRS_NEON_H

#include "warp_fixed/window_patch_neon.h"

/** @return How to make a short window of gray texels whose weights are those of a kernel with negative ones. */
patch_loop_t resample_pairs_gray_neon(const window_t *window);

/** @return The same of chroma texels. */
patch_loop_t resample_pairs_chroma_neon(const window_t *window);

#endif
