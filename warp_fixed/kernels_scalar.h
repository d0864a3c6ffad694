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
resample_window_fn resample_coefficients_gray_scalar;
resample_window_fn resample_coefficients_xrgb_scalar;
filter_columns_fn filter_columns_scalar;
filter_row_fn filter_row_scalar;
filter_row_bytes_fn filter_row_bytes_scalar;
ls_pixels_fn ls_pixels_gray_scalar;
ls_pixels_fn ls_pixels_xrgb_scalar;
ls_scale_fn ls_scale_scalar;
ls_forward_fn ls_forward_scalar;
ls_backward_fn ls_backward_scalar;
resample_ls_fn resample_ls_gray_scalar;
resample_ls_fn resample_ls_xrgb_scalar;

#endif
