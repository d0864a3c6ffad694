// SPDX-License-Identifier: Apache-2.0
// Pose of the viewer -> homography from projector pixel to picture point (paper, eq 3).
#include "warp_fixed/homography_from_pose.h"

#include "warp_fixed/real_vector.h"
#include "warp_fixed/rotation_from_quaternion.h"

bool homography_from_pose(homography_t *homography, const camera_t *camera, const wall_t *wall, const pose_t *pose)
{
    real_t rotation[3][3];
    if (!rotation_from_quaternion(rotation, pose->quaternion_q30))
        return false;

    /* Wall point minus eye, times the weight, in um: the difference is taken first, where it is exact. */
    real_t from_eye[3][3];
    const real_t thousandth = real_div(real_from_int(1, 0), real_from_int(1000, 0));
    for (int a = 0; a < 3; a++) {
        const int64_t offset_nm = (int64_t)wall->origin_um[a] * 1000 - pose->eye_nm[a];
        const real_t offset_um = real_mul(real_from_int(offset_nm, 0), thousandth);
        for (int k = 0; k < 3; k++)
            from_eye[k][a] = real_add(wall->point[a][k], real_mul(offset_um, wall->weight[k]));
    }

    const real_t million = real_from_int(1000000, 0);
    for (int k = 0; k < 3; k++) {
        const real_t depth = vector_dot(rotation[2], from_eye[k]);
        for (int a = 0; a < 2; a++) {
            const real_t focal = real_div(real_from_int(camera->focal_upx[a], 0), million);
            const real_t principal = real_div(real_from_int(camera->principal_upx[a], 0), million);
            homography->row[a][k] =
                real_add(real_mul(focal, vector_dot(rotation[a], from_eye[k])), real_mul(principal, depth));
        }
        homography->row[2][k] = depth;
        homography->weight[k] = wall->weight[k];
    }
    homography->panel_width = wall->panel_width;
    homography->panel_height = wall->panel_height;
    homography->picture_width = camera->width;
    homography->picture_height = camera->height;
    return true;
}

void homography_from_indices(homography_t *homography, const int64_t rows_q40[3][3], const int32_t panel[2],
                             const int32_t picture[2])
{
    const real_t half = real_from_int(1, -1);
    real_t row[3][3];
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++)
            row[r][k] = real_from_int(rows_q40[r][k], -40);
        row[r][2] = real_sub(row[r][2], real_mul(half, real_add(row[r][0], row[r][1])));
    }
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < 2; r++)
            homography->row[r][k] = real_add(row[r][k], real_mul(half, row[2][k]));
        homography->row[2][k] = row[2][k];
        homography->weight[k] = real_from_int(k == 2, 0);
    }
    homography->panel_width = panel[0];
    homography->panel_height = panel[1];
    homography->picture_width = picture[0];
    homography->picture_height = picture[1];
}

bool homography_is_mirrored(const homography_t *homography)
{
    real_t cross[3]; /* the determinant is positive where the map keeps the sense of turn */
    vector_cross(cross, homography->row[0], homography->row[1]);
    return real_sign(vector_dot(cross, homography->row[2])) < 0;
}

int64_t homography_depth_um(const homography_t *homography, int32_t u_half, int32_t v_half)
{
    const real_t uv[3] = {real_from_int(u_half, -1), real_from_int(v_half, -1), real_from_int(1, 0)};
    const real_t weight = vector_dot(homography->weight, uv);
    return real_to_fixed(real_div(vector_dot(homography->row[2], uv), weight), 0, INT64_MAX);
}
