// SPDX-License-Identifier: Apache-2.0
// Nearest neighbour: addresses of four pixels at a time.
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

enum { STEP = 4 };

/* Offsets of four pixels from the picture's first, bytes. */
typedef struct {
    int32x4_t last_x, last_y, stride;
    int32_t pixel_log2;
} places_t;

static inline places_t places_in(const image_t *picture, int32_t pixel_log2)
{
    return (places_t){vdupq_n_s32(picture->width - 1), vdupq_n_s32(picture->height - 1), vdupq_n_s32(picture->stride),
                      pixel_log2};
}

static inline uint32x4_t offsets(const places_t *places, const int32_t *x_q18, const int32_t *y_q18)
{
    const int32x4_t zero = vdupq_n_s32(0);
    const int32x4_t u = vshrq_n_s32(vld1q_s32(x_q18), GRID_FRACTION_BITS);
    const int32x4_t v = vshrq_n_s32(vld1q_s32(y_q18), GRID_FRACTION_BITS);
    const int32x4_t x = vshlq_s32(vminq_s32(vmaxq_s32(u, zero), places->last_x), vdupq_n_s32(places->pixel_log2));
    const int32x4_t y = vminq_s32(vmaxq_s32(v, zero), places->last_y);
    return vreinterpretq_u32_s32(vmlaq_s32(x, y, places->stride));
}

/* Whether every offset fits 32 bits; no picture without huge gaps between its rows is larger. */
static inline int offsets_fit(const image_t *picture)
{
    return (int64_t)picture->stride * picture->height <= INT32_MAX;
}

void resample_nearest_gray_neon(uint8_t *restrict out, const image_t *picture, const int32_t *restrict x_q18,
                                const int32_t *restrict y_q18, int32_t count)
{
    const places_t places = places_in(picture, 0);
    const uint8_t *data = picture->data;
    int32_t k = 0;
    for (; offsets_fit(picture) && k + STEP <= count; k += STEP) {
        const uint64x2_t pairs = vreinterpretq_u64_u32(offsets(&places, x_q18 + k, y_q18 + k));
        const uint64_t first = vgetq_lane_u64(pairs, 0), second = vgetq_lane_u64(pairs, 1);
        out[k] = data[(uint32_t)first];
        out[k + 1] = data[first >> 32];
        out[k + 2] = data[(uint32_t)second];
        out[k + 3] = data[second >> 32];
    }
    resample_nearest_gray_scalar(out + k, picture, x_q18 + k, y_q18 + k, count - k);
}

void resample_nearest_xrgb_neon(uint8_t *restrict out, const image_t *picture, const int32_t *restrict x_q18,
                                const int32_t *restrict y_q18, int32_t count)
{
    const places_t places = places_in(picture, 2);
    const uint8_t *data = picture->data;
    int32_t k = 0;
    for (; offsets_fit(picture) && k + STEP <= count; k += STEP) {
        const uint64x2_t pairs = vreinterpretq_u64_u32(offsets(&places, x_q18 + k, y_q18 + k));
        const uint64_t first = vgetq_lane_u64(pairs, 0), second = vgetq_lane_u64(pairs, 1);
        uint32_t pixels[STEP];
        memcpy(&pixels[0], data + (uint32_t)first, sizeof *pixels);
        memcpy(&pixels[1], data + (first >> 32), sizeof *pixels);
        memcpy(&pixels[2], data + (uint32_t)second, sizeof *pixels);
        memcpy(&pixels[3], data + (second >> 32), sizeof *pixels);
        memcpy(out + (ptrdiff_t)k * 4, pixels, sizeof pixels);
    }
    resample_nearest_xrgb_scalar(out + (ptrdiff_t)k * 4, picture, x_q18 + k, y_q18 + k, count - k);
}
