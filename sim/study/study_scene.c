// SPDX-License-Identifier: Apache-2.0
// The study's room: one wall, a viewer who looks at its centre, and the product's own warp.
#include "sim/study/study_scene.h"

#include <assert.h>
#include <math.h>
#include <string.h>

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

static void multiply(double out[4], const double p[4], const double q[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

pose_t study_pose_turned(const double angle_deg[3])
{
    double turned[4] = {1.0, 0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        const double half = -angle_deg[axis] * pi / 360.0;
        double one[4] = {cos(half), 0.0, 0.0, 0.0}, next[4];
        one[axis + 1] = sin(half);
        multiply(next, one, turned);
        memcpy(turned, next, sizeof turned);
    }
    const double w = turned[0], x = turned[1], y = turned[2], z = turned[3];
    /* where the camera's backward axis points */
    const double back[3] = {-2.0 * (x * z + w * y), -2.0 * (y * z - w * x), -(w * w - x * x - y * y + z * z)};
    pose_t pose;
    for (int i = 0; i < 3; i++)
        pose.eye_nm[i] = llround(distance_nm * back[i]);
    for (int i = 0; i < 4; i++)
        pose.quaternion_q30[i] = (int32_t)lround(turned[i] * 1073741824.0);
    return pose;
}

pose_t study_pose(double angle_deg)
{
    return study_pose_turned((const double[3]){0.0, angle_deg, 0.0});
}

void study_warp_begin(warp_t *warp, const warp_method_t *method)
{
    static const uint8_t black[3] = {0, 0, 0};
    warp_init(warp, *method, false, black);
}

void study_warp_frame(warp_t *warp, const homography_t *homography, const image_t *picture, const image_t *panel)
{
    const bool made = warp_frame(warp, &warp_kernels_scalar, NULL, homography, panel, picture);
    assert(made);
    (void)made;
}
