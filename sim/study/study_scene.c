// SPDX-License-Identifier: Apache-2.0
// The study's room: one wall, a viewer who looks at its centre, and the product's own warp.
#include "sim/study/study_scene.h"

#include <assert.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

enum { WALL_HALF_WIDTH_UM = 2000000, WALL_HALF_HEIGHT_UM = 1125000 };

static const double distance_nm = 2.5e9;

/* Micro-pixels of focal length at which a wall of 2 * half_um, at the study's distance, fills `size` pixels. */
static int64_t focal_upx(int32_t size, int32_t half_um)
{
    return llround(size * 1e6 * (distance_nm / 1e3) / (2.0 * half_um));
}

void study_scene(study_scene_t *scene, const study_sizes_t *sizes)
{
    const int32_t x = WALL_HALF_WIDTH_UM, y = WALL_HALF_HEIGHT_UM;
    const wall_corners_t corners = {.panel_width = sizes->panel_width,
                                    .panel_height = sizes->panel_height,
                                    .corner_um = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}},
                                    .corner_known = {true, true, true, true}};
    const int32_t width = sizes->picture_width, height = sizes->picture_height;
    scene->camera = (camera_t){.width = width,
                               .height = height,
                               .focal_upx = {focal_upx(width, x), focal_upx(height, y)},
                               .principal_upx = {width * INT64_C(500000), height * INT64_C(500000)}};
    const wall_status_t status = wall_from_corners(&scene->wall, &corners);
    assert(status == WALL_OK);
    (void)status;
}

pose_t study_pose(double angle_deg)
{
    const double angle = angle_deg * pi / 180.0, one_q30 = 1073741824.0;
    return (pose_t){.eye_nm = {llround(distance_nm * sin(angle)), 0, llround(-distance_nm * cos(angle))},
                    .quaternion_q30 = {(int32_t)lround(cos(angle / 2) * one_q30), 0,
                                       (int32_t)lround(-sin(angle / 2) * one_q30), 0}};
}

void study_warp(warp_t *warp, const warp_method_t *method, const homography_t *homography, const image_t *picture,
                const image_t *panel)
{
    static const uint8_t black[3] = {0, 0, 0};
    warp_init(warp, *method, false, black);
    const bool made = warp_frame(warp, &warp_kernels_scalar, NULL, homography, panel, picture);
    assert(made);
    (void)made;
}
