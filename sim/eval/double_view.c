// SPDX-License-Identifier: Apache-2.0
// Eye, camera and wall in double precision and metres: for evaluation, never for a frame.
#include "sim/eval/double_view.h"

#include <math.h>

#include "sim/eval/double_homography.h"

static void rotation_from_quaternion(double r[3][3], const int32_t quaternion_q30[4])
{
    double q[4], square = 0.0;
    for (int i = 0; i < 4; i++)
        square += (double)quaternion_q30[i] * quaternion_q30[i];
    for (int i = 0; i < 4; i++)
        q[i] = quaternion_q30[i] / sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            r[i][k] = rows[i][k];
}

void double_view(double_view_t *view, const camera_t *camera, const pose_t *pose)
{
    for (int i = 0; i < 3; i++)
        view->eye_m[i] = (double)pose->eye_nm[i] * 1e-9;
    rotation_from_quaternion(view->world_from_camera, pose->quaternion_q30);
    for (int i = 0; i < 2; i++) {
        view->focal_px[i] = (double)camera->focal_upx[i] * 1e-6;
        view->principal_px[i] = (double)camera->principal_upx[i] * 1e-6;
    }
}

void double_view_ray(const double_view_t *view, const double xy_px[2], double ray[3])
{
    const double x = (xy_px[0] - view->principal_px[0]) / view->focal_px[0];
    const double y = (xy_px[1] - view->principal_px[1]) / view->focal_px[1];
    for (int i = 0; i < 3; i++) {
        const double *row = view->world_from_camera[i];
        ray[i] = row[0] * x + row[1] * y + row[2];
    }
}

bool double_view_project(const double_view_t *view, const double point_m[3], double xy_px[2])
{
    double p[3] = {0.0, 0.0, 0.0}; /* in the camera frame: the transpose turns the other way */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[k] += view->world_from_camera[i][k] * (point_m[i] - view->eye_m[i]);
    if (!(p[2] > 0.0))
        return false;
    for (int i = 0; i < 2; i++)
        xy_px[i] = view->focal_px[i] * p[i] / p[2] + view->principal_px[i];
    return true;
}

void double_wall(double_wall_t *out, const wall_t *wall)
{
    for (int k = 0; k < 3; k++) {
        out->origin_m[k] = wall->origin_um[k] * 1e-6;
        out->weight[k] = double_from_real(wall->weight[k]);
        for (int i = 0; i < 3; i++)
            out->point[i][k] = double_from_real(wall->point[i][k]) * 1e-6;
    }
}

void double_wall_point(const double_wall_t *wall, const double uv_px[2], double point_m[3])
{
    const double u = uv_px[0], v = uv_px[1];
    const double weight = wall->weight[0] * u + wall->weight[1] * v + wall->weight[2];
    for (int i = 0; i < 3; i++) {
        const double *row = wall->point[i];
        point_m[i] = wall->origin_m[i] + (row[0] * u + row[1] * v + row[2]) / weight;
    }
}
