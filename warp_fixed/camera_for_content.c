// SPDX-License-Identifier: Apache-2.0
// The camera through which a picture that was drawn from one eye serves another eye, for content at a known depth.
#include "warp_fixed/camera_for_content.h"

#include "warp_fixed/real_vector.h"
#include "warp_fixed/rotation_from_quaternion.h"

bool camera_for_content(camera_t *corrected, const camera_t *camera, const pose_t *drawn, const int64_t eye_nm[3],
                        int64_t depth_um)
{
    real_t rotation[3][3];
    if (depth_um <= 0 || !rotation_from_quaternion(rotation, drawn->quaternion_q30))
        return false;
    real_t moved[3], part[3]; /* c, and c / d */
    const real_t depth_nm = real_from_int(depth_um * 1000, 0), one = real_from_int(1, 0);
    const real_t most = real_from_int(CAMERA_FOR_CONTENT_DEPTHS, 0);
    for (int a = 0; a < 3; a++)
        moved[a] = real_from_int(eye_nm[a] - drawn->eye_nm[a], 0);
    for (int a = 0; a < 3; a++) {
        part[a] = real_div(vector_dot(rotation[a], moved), depth_nm);
        if (real_less(most, real_abs(part[a])))
            return false;
    }
    const real_t zoom = real_sub(one, part[2]);
    if (real_less(zoom, real_div(one, most)))
        return false;
    *corrected = *camera;
    for (int a = 0; a < 2; a++) { /* below 2^60: a focal length of 10^11 px is none */
        const real_t focal = real_from_int(camera->focal_upx[a], 0);
        corrected->focal_upx[a] = real_to_fixed(real_mul(focal, zoom), 0, INT64_C(1) << 60);
        corrected->principal_upx[a] += real_to_fixed(real_mul(focal, part[a]), 0, INT64_C(1) << 60);
    }
    return true;
}
