// SPDX-License-Identifier: Apache-2.0
// The table of pixel loops.
#include "warp_fixed/kernels.h"

#include <stddef.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/same_text.h"

const warp_kernels_t warp_kernels_scalar = {
    .name = "scalar",
    .grid_points = grid_points_scalar,
    .nearest_gray = resample_nearest_gray_scalar,
    .nearest_chroma = resample_nearest_chroma_scalar,
    .nearest_xrgb = resample_nearest_xrgb_scalar,
    .window_gray = resample_window_gray_scalar,
    .window_chroma = resample_window_chroma_scalar,
    .window_xrgb = resample_window_xrgb_scalar,
    .coefficients_gray = resample_coefficients_gray_scalar,
    .coefficients_chroma = resample_coefficients_chroma_scalar,
    .coefficients_xrgb = resample_coefficients_xrgb_scalar,
    .filter_columns = filter_columns_scalar,
    .filter_row = filter_row_scalar,
    .filter_row_bytes = filter_row_bytes_scalar,
    .ls_pixels_gray = ls_pixels_gray_scalar,
    .ls_pixels_chroma = ls_pixels_chroma_scalar,
    .ls_pixels_xrgb = ls_pixels_xrgb_scalar,
    .ls_scale = ls_scale_scalar,
    .ls_forward = ls_forward_scalar,
    .ls_backward = ls_backward_scalar,
    .ls_gray = resample_ls_gray_scalar,
    .ls_chroma = resample_ls_chroma_scalar,
    .ls_xrgb = resample_ls_xrgb_scalar,
    .planes_from_yuyv = planes_from_yuyv_scalar,
    .planes_from_uyvy = planes_from_uyvy_scalar,
    .yuyv_from_planes = yuyv_from_planes_scalar,
    .xrgb_from_yuv = xrgb_from_yuv_scalar,
    .xrgb_from_rgb888 = xrgb_from_rgb888_scalar,
    .xrgb_from_bgr888 = xrgb_from_bgr888_scalar,
};

const warp_kernels_t warp_kernels_neon = {
    .name = "neon",
    .grid_points = grid_points_neon,
    .nearest_gray = resample_nearest_gray_neon,
    .nearest_chroma = resample_nearest_chroma_neon,
    .nearest_xrgb = resample_nearest_xrgb_neon,
    .window_gray = resample_window_gray_neon,
    .window_chroma = resample_window_chroma_neon,
    .window_xrgb = resample_window_xrgb_neon,
    .coefficients_gray = resample_coefficients_gray_neon,
    .coefficients_chroma = resample_coefficients_chroma_neon,
    .coefficients_xrgb = resample_coefficients_xrgb_neon,
    .filter_columns = filter_columns_neon,
    .filter_row = filter_row_neon,
    .filter_row_bytes = filter_row_bytes_neon,
    .ls_pixels_gray = ls_pixels_gray_neon,
    .ls_pixels_chroma = ls_pixels_chroma_neon,
    .ls_pixels_xrgb = ls_pixels_xrgb_neon,
    .ls_scale = ls_scale_neon,
    .ls_forward = ls_forward_neon,
    .ls_backward = ls_backward_neon,
    .ls_gray = resample_ls_gray_neon,
    .ls_chroma = resample_ls_chroma_neon,
    .ls_xrgb = resample_ls_xrgb_neon,
    .planes_from_yuyv = planes_from_yuyv_neon,
    .planes_from_uyvy = planes_from_uyvy_neon,
    .yuyv_from_planes = yuyv_from_planes_neon,
    .xrgb_from_yuv = xrgb_from_yuv_neon,
    .xrgb_from_rgb888 = xrgb_from_rgb888_neon,
    .xrgb_from_bgr888 = xrgb_from_bgr888_neon,
};

const warp_kernels_t *const warp_kernels_levels[WARP_KERNELS_LEVELS] = {&warp_kernels_scalar, &warp_kernels_neon};

const warp_kernels_t *warp_kernels_best(void)
{
    return warp_kernels_levels[WARP_KERNELS_LEVELS - 1];
}

const warp_kernels_t *warp_kernels_from_name(const char *name)
{
    for (int level = 0; level < WARP_KERNELS_LEVELS; level++)
        if (same_text(warp_kernels_levels[level]->name, name))
            return warp_kernels_levels[level];
    return NULL;
}
