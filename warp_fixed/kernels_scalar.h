// SPDX-License-Identifier: Apache-2.0
// The pixel loops in plain C: the definition of what every other version must write. See kernels.h.
#ifndef WARP_FIXED_KERNELS_SCALAR_H
#define WARP_FIXED_KERNELS_SCALAR_H

#include "warp_fixed/kernels.h"

grid_points_fn grid_points_scalar;
resample_nearest_fn resample_nearest_gray_scalar;
resample_nearest_fn resample_nearest_xrgb_scalar;
resample_window_fn resample_window_gray_scalar;
resample_window_fn resample_window_xrgb_scalar;
prefilter_columns_fn prefilter_columns_scalar;
prefilter_row_fn prefilter_row_scalar;
spline_row_fn spline_row_scalar;
resample_window_fn resample_spline_gray_scalar;
resample_window_fn resample_spline_xrgb_scalar;
ls_forward_fn ls_forward_scalar;
ls_backward_fn ls_backward_scalar;
resample_ls_fn resample_ls_gray_scalar;
resample_ls_fn resample_ls_xrgb_scalar;

#endif
