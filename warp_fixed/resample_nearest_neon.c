// SPDX-License-Identifier: Apache-2.0
// Nearest neighbour: eight pixels at a time.
#include <stdbool.h>
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"
#include "warp_fixed/window_patch_neon.h"

enum { STEP = 8 };

/* What the pixels of a picture share. */
typedef struct {
    const uint8_t *data;
    int32_t last_x, last_y, stride;
    int pixel_log2;
} pixels_t;

/* Offsets of four pixels. */
NEON_INLINE uint32x4_t offsets(const pixels_t *from, const int32_t *x_q18, const int32_t *y_q18, bool inside)
{
    int32x4_t x = vshrq_n_s32(vld1q_s32(x_q18), GRID_FRACTION_BITS);
    int32x4_t y = vshrq_n_s32(vld1q_s32(y_q18), GRID_FRACTION_BITS);
    if (!inside) {
        x = vminq_s32(vmaxq_s32(x, vdupq_n_s32(0)), vdupq_n_s32(from->last_x));
        y = vminq_s32(vmaxq_s32(y, vdupq_n_s32(0)), vdupq_n_s32(from->last_y));
    }
    return vreinterpretq_u32_s32(vmlaq_n_s32(vshlq_s32(x, vdupq_n_s32(from->pixel_log2)), y, from->stride));
}

NEON_INLINE void copy_four(uint8_t *out, const pixels_t *from, uint32x4_t offset)
{
    uint32_t at[4];
    vst1q_u32(at, offset);
    const size_t size = (size_t)1 << from->pixel_log2;
    uint32_t pixel[4]; /* all of them are read before any is written: stores go in pairs */
    for (int i = 0; i < 4; i++)
        memcpy(&pixel[i], from->data + at[i], size);
    for (int i = 0; i < 4; i++)
        memcpy(out + (i << from->pixel_log2), &pixel[i], size);
}

NEON_INLINE void copy_eight(uint8_t *out, const pixels_t *from, const int32_t *x_q18, const int32_t *y_q18, bool inside)
{
    copy_four(out, from, offsets(from, x_q18, y_q18, inside));
    copy_four(out + (4 << from->pixel_log2), from, offsets(from, x_q18 + 4, y_q18 + 4, inside));
}

/* Rows of at least STEP pixels; where need be, the last step begins within the one before. */
NEON_INLINE void copy_patch(const patch_t *patch, const pixels_t *from, bool inside)
{
    const int32_t width = patch->width, height = patch->height, rest = width % STEP, back = STEP - rest;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width - rest; x_q18 < end; x_q18 += STEP, y_q18 += STEP) {
            copy_eight(out, from, x_q18, y_q18, inside);
            out += STEP << from->pixel_log2;
        }
        if (rest != 0)
            copy_eight(out - (back << from->pixel_log2), from, x_q18 - back, y_q18 - back, inside);
    }
}

NEON_INLINE void nearest(const patch_t *patch, const image_t *picture, int pixel_log2)
{
    const pixels_t from = {picture->data, picture->width - 1, picture->height - 1, picture->stride, pixel_log2};
    if (points_inside(patch, picture->width, picture->height))
        copy_patch(patch, &from, true);
    else
        copy_patch(patch, &from, false);
}

static bool suits(const patch_t *patch, const image_t *picture)
{
    return patch->width >= STEP && patch->height > 0 && offsets_fit(picture->stride, picture->height);
}

void resample_nearest_gray_neon(const patch_t *patch, const image_t *picture)
{
    if (suits(patch, picture))
        nearest(patch, picture, 0);
    else
        resample_nearest_gray_scalar(patch, picture);
}

void resample_nearest_chroma_neon(const patch_t *patch, const image_t *picture)
{
    if (suits(patch, picture))
        nearest(patch, picture, 1);
    else
        resample_nearest_chroma_scalar(patch, picture);
}

void resample_nearest_xrgb_neon(const patch_t *patch, const image_t *picture)
{
    if (suits(patch, picture))
        nearest(patch, picture, 2);
    else
        resample_nearest_xrgb_scalar(patch, picture);
}
