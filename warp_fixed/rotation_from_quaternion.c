// SPDX-License-Identifier: Apache-2.0
// Orientation of the viewer -> the rotation R_c of eq 3, world to camera frame.
#include "warp_fixed/rotation_from_quaternion.h"

bool rotation_from_quaternion(real_t rotation[3][3], const int32_t quaternion_q30[4])
{
    real_t q[4], square = real_from_int(0, 0);
    for (int i = 0; i < 4; i++) {
        q[i] = real_from_int(quaternion_q30[i], -30);
        square = real_add(square, real_mul(q[i], q[i]));
    }
    if (real_sign(square) == 0)
        return false;
    const real_t w = q[0], v[3] = {q[1], q[2], q[3]};
    const real_t two = real_from_int(2, 0);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const real_t bc = real_add(real_mul(v[b], v[b]), real_mul(v[c], v[c]));
        const real_t ab = real_mul(v[a], v[b]), wc = real_mul(w, v[c]);
        rotation[a][a] = real_div(real_sub(square, real_mul(two, bc)), square);
        /* The quaternion's matrix has 2 (ab - wc) at (a, b) and 2 (ab + wc) at (b, a); this is its transpose. */
        rotation[b][a] = real_div(real_mul(two, real_sub(ab, wc)), square);
        rotation[a][b] = real_div(real_mul(two, real_add(ab, wc)), square);
    }
    return true;
}
