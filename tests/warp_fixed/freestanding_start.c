// SPDX-License-Identifier: Apache-2.0
// A program of nothing but warp_fixed: what links here runs on any board without an operating system or a library.
#include "warp_fixed/warp.h"

void *memcpy(void *restrict to, const void *restrict from, size_t count);
void *memmove(void *to, const void *from, size_t count);
void *memset(void *to, int value, size_t count);
int memcmp(const void *a, const void *b, size_t count);
void _start(void);

void *memcpy(void *restrict to, const void *restrict from, size_t count)
{
    uint8_t *out = to;
    const uint8_t *in = from;
    while (count-- > 0)
        *out++ = *in++;
    return to;
}

void *memmove(void *to, const void *from, size_t count)
{
    uint8_t *out = to;
    const uint8_t *in = from;
    if (out <= in)
        return memcpy(to, from, count);
    while (count-- > 0)
        out[count] = in[count];
    return to;
}

void *memset(void *to, int value, size_t count)
{
    uint8_t *out = to;
    while (count-- > 0)
        *out++ = (uint8_t)value;
    return to;
}

int memcmp(const void *a, const void *b, size_t count)
{
    const uint8_t *left = a, *right = b;
    for (size_t i = 0; i < count; i++)
        if (left[i] != right[i])
            return left[i] < right[i] ? -1 : 1;
    return 0;
}

static warp_t warp;
static image_t panel, picture;

void _start(void)
{
    static const wall_corners_t corners;
    static const camera_t camera;
    static const pose_t pose;
    static const uint8_t border[3];
    wall_t wall;
    homography_t homography;
    warp_init(&warp, *warp_method_default(), false, border);
    if (wall_from_corners(&wall, &corners) == WALL_OK && homography_from_pose(&homography, &camera, &wall, &pose))
        (void)warp_frame(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture);
    for (;;) {
    }
}
