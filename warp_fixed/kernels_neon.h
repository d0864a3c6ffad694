// SPDX-License-Identifier: Apache-2.0
// The loops in NEON (neon.h): the same bytes as the scalar ones, which do what is too narrow or too far apart for
// vectors. See kernels.h.
#ifndef WARP_FIXED_KERNELS_NEON_H
#define WARP_FIXED_KERNELS_NEON_H

#include "warp_fixed/kernels.h"

grid_points_fn grid_points_neon;
resample_nearest_fn resample_nearest_gray_neon;
resample_nearest_fn resample_nearest_chroma_neon;
resample_nearest_fn resample_nearest_xrgb_neon;
resample_window_fn resample_window_gray_neon;
resample_window_fn resample_window_chroma_neon;
resample_window_fn resample_window_xrgb_neon;
resample_window_fn resample_coefficients_gray_neon;
resample_window_fn resample_coefficients_chroma_neon;
resample_window_fn resample_coefficients_xrgb_neon;
filter_columns_fn filter_columns_neon;
filter_row_fn filter_row_neon;
filter_row_bytes_fn filter_row_bytes_neon;
ls_pixels_fn ls_pixels_gray_neon;
ls_pixels_fn ls_pixels_chroma_neon;
ls_pixels_fn ls_pixels_xrgb_neon;
ls_scale_fn ls_scale_neon;
ls_forward_fn ls_forward_neon;
ls_backward_fn ls_backward_neon;
resample_ls_fn resample_ls_gray_neon;
resample_ls_fn resample_ls_chroma_neon;
resample_ls_fn resample_ls_xrgb_neon;
planes_from_row_fn planes_from_yuyv_neon;
planes_from_row_fn planes_from_uyvy_neon;
row_from_planes_fn yuyv_from_planes_neon;
xrgb_from_yuv_fn xrgb_from_yuv_neon;
xrgb_from_row_fn xrgb_from_rgb888_neon;
xrgb_from_row_fn xrgb_from_bgr888_neon;

#endif
