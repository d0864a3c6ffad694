// SPDX-License-Identifier: Apache-2.0
// The step k of a frame -> that of its chroma, along each axis.
#include "warp_fixed/chroma_step.h"

#include "warp_fixed/footprint_from_homography.h"
#include "warp_fixed/real_vector.h"

/* What x (axis 0) or y of the picture's point gains per pixel of these sizes to the right and down, squared and added;
 * all times one number. */
static real_t side_square(const homography_t *h, const real_t at[3], int axis, chroma_log2_t size)
{
    const int size_log2[2] = {size.x, size.y};
    const real_t value = vector_dot(h->row[axis], at), depth = vector_dot(h->row[2], at);
    real_t square = real_from_int(0, 0);
    for (int way = 0; way < 2; way++) {
        const real_t gain = real_sub(real_mul(h->row[axis][way], depth), real_mul(h->row[2][way], value));
        square = real_add(square, real_scale(real_mul(gain, gain), 2 * size_log2[way]));
    }
    return square;
}

static int32_t axis_step(const homography_t *h, const real_t at[3], int axis, int32_t k_q16, chroma_log2_t panel)
{
    const real_t whole = side_square(h, at, axis, (chroma_log2_t){0, 0});
    if (real_sign(whole) == 0)
        return k_q16;
    const real_t ratio = real_sqrt(real_div(side_square(h, at, axis, panel), whole));
    return (int32_t)real_to_fixed(real_mul(real_from_int(k_q16, 0), ratio), 0, FOOTPRINT_MAX_STEP_Q16);
}

chroma_step_t chroma_step(const homography_t *homography, int32_t k_q16, const int32_t pixel[2], chroma_log2_t panel,
                          chroma_log2_t picture)
{
    const real_t at[3] = {real_from_int(2 * (int64_t)pixel[0] + 1, -1), real_from_int(2 * (int64_t)pixel[1] + 1, -1),
                          real_from_int(1, 0)};
    return (chroma_step_t){axis_step(homography, at, 0, k_q16, panel) >> picture.x,
                           axis_step(homography, at, 1, k_q16, panel) >> picture.y};
}
