// SPDX-License-Identifier: Apache-2.0
// Windows with more than WINDOW_SHORT_TAPS along either axis: resample_window_fn for these alone.
#ifndef WARP_FIXED_RESAMPLE_LONG_NEON_H
#define WARP_FIXED_RESAMPLE_LONG_NEON_H

#include "warp_fixed/kernels.h"

resample_window_fn resample_long_gray_neon;
resample_window_fn resample_long_chroma_neon;
resample_window_fn resample_long_xrgb_neon;
resample_window_fn resample_long_coefficients_gray_neon;
resample_window_fn resample_long_coefficients_chroma_neon;
resample_window_fn resample_long_coefficients_xrgb_neon;

#endif
