// SPDX-License-Identifier: Apache-2.0
// The table of pixel loops.
#include "warp_fixed/kernels.h"

#include "warp_fixed/kernels_scalar.h"

const warp_kernels_t warp_kernels_scalar = {
    .name = "scalar",
    .grid_points = grid_points_scalar,
    .nearest_gray = resample_nearest_gray_scalar,
    .nearest_xrgb = resample_nearest_xrgb_scalar,
    .window_gray = resample_window_gray_scalar,
    .window_xrgb = resample_window_xrgb_scalar,
    .coefficients_gray = resample_coefficients_gray_scalar,
    .coefficients_xrgb = resample_coefficients_xrgb_scalar,
    .filter_columns = filter_columns_scalar,
    .filter_row = filter_row_scalar,
    .filter_row_bytes = filter_row_bytes_scalar,
    .ls_forward = ls_forward_scalar,
    .ls_backward = ls_backward_scalar,
    .ls_gray = resample_ls_gray_scalar,
    .ls_xrgb = resample_ls_xrgb_scalar,
};
