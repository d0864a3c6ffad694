// SPDX-License-Identifier: Apache-2.0
// The study's room: one wall, its viewer's camera, and the product's own warp.
#include "sim/study/study_scene.h"

#include <assert.h>
#include <math.h>

enum { WALL_HALF_WIDTH_UM = 2000000, WALL_HALF_HEIGHT_UM = 1125000 };

/* Micro-pixels of focal length at which a wall of 2 * half_um, at the study's distance, fills `size` pixels. */
static int64_t focal_upx(int32_t size, int32_t half_um)
{
    return llround(size * 1e6 * (STUDY_DISTANCE_MM * 1e3) / (2.0 * half_um));
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

void study_warp_begin(warp_t *warp, const warp_method_t *method)
{
    static const uint8_t black[3] = {0, 0, 0};
    warp_init(warp, *method, false, black);
}

void study_warp_frame(warp_t *warp, const homography_t *homography, const image_t *picture, const image_t *panel)
{
    const bool made = warp_frame(warp, warp_kernels_best(), NULL, homography, panel, picture);
    assert(made);
    (void)made;
}
