// SPDX-License-Identifier: Apache-2.0
// Patches whose windows need no checks: those inside the picture, and copies of its edge continued by mirroring.
#include "warp_fixed/window_patch_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"

enum { MIRRORED_BYTES = 1 << 16, ALIGNMENT = 16 };

/* Texels that the windows of a patch read along one axis: [begin, end). */
typedef struct {
    int32_t begin, end;
} reach_t;

/* What a point needs added so that its whole part is the window's begin: see window_place(). */
static int32_t start_q18(const window_axis_t *axis)
{
    enum { PHASE_SHIFT = GRID_FRACTION_BITS - PHASE_BITS };
    return (1 << (PHASE_SHIFT - 1)) + (axis->lead - PHASES / 2) * (1 << PHASE_SHIFT);
}

/* Points lie between those of the corners, give or take the slack. */
static reach_t reach_of(const patch_t *patch, const int32_t *point_q18, int32_t start, int32_t taps)
{
    const int32_t right = patch->width - 1, below = (patch->height - 1) * PATCH_MAX_WIDTH;
    const int32_t corner[4] = {point_q18[0], point_q18[right], point_q18[below], point_q18[below + right]};
    int64_t least = corner[0], most = corner[0];
    for (int c = 1; c < 4; c++) {
        least = corner[c] < least ? corner[c] : least;
        most = corner[c] > most ? corner[c] : most;
    }
    least += start - PATCH_SLACK_Q18;
    most += start + PATCH_SLACK_Q18;
    return (reach_t){(int32_t)floor_shift(least, GRID_FRACTION_BITS),
                     (int32_t)floor_shift(most, GRID_FRACTION_BITS) + taps};
}

static bool is_inside(reach_t reach, int32_t size)
{
    return reach.begin >= 0 && reach.end <= size;
}

bool points_inside(const patch_t *patch, int32_t width, int32_t height)
{
    return is_inside(reach_of(patch, patch->x_q18, 0, 1), width) &&
           is_inside(reach_of(patch, patch->y_q18, 0, 1), height);
}

/* Copy that part of the picture, and its mirror images where it reaches beyond. */
static void copy_mirrored(uint8_t *to, ptrdiff_t to_stride, const texels_t *from, reach_t x, reach_t y)
{
    const int32_t bytes = from->texel_bytes;
    const int32_t first = clamp_i32(0, x.begin, x.end), last = clamp_i32(from->width, first, x.end);
    for (int32_t v = y.begin; v < y.end; v++, to += to_stride) {
        const uint8_t *row = from->data + mirror_index(v, from->height) * from->stride;
        for (int32_t u = x.begin; u < first; u++)
            memcpy(to + (u - x.begin) * bytes, row + mirror_index(u, from->width) * bytes, (size_t)bytes);
        if (first < last)
            memcpy(to + (first - x.begin) * bytes, row + first * bytes, (size_t)((last - first) * bytes));
        for (int32_t u = last; u < x.end; u++)
            memcpy(to + (u - x.begin) * bytes, row + mirror_index(u, from->width) * bytes, (size_t)bytes);
    }
}

static ptrdiff_t mirrored_stride(reach_t x, int32_t texel_bytes)
{
    return ((ptrdiff_t)(x.end - x.begin) * texel_bytes + ALIGNMENT - 1) & -ALIGNMENT;
}

/* What the pieces of a call share. */
typedef struct {
    const window_t *window;
    const texels_t *texels;
    weigh_patch_fn *weigh;
    int32_t taps[2], pixel_bytes;
} call_t;

static window_source_t source_from(const call_t *call, const uint8_t *data, ptrdiff_t stride, int32_t x, int32_t y)
{
    return (window_source_t){data, (int32_t)stride, start_q18(&call->window->x) - x * (1 << GRID_FRACTION_BITS),
                             start_q18(&call->window->y) - y * (1 << GRID_FRACTION_BITS)};
}

/* Fewer columns than a step has are done by a step beside the panel. */
static __attribute__((noinline)) void weigh_narrow(const call_t *call, const patch_t *patch,
                                                   const window_source_t *source)
{
    int32_t x_q18[PATCH_STEP], y_q18[PATCH_STEP];
    uint8_t pixels[PATCH_STEP * sizeof(uint32_t)];
    for (int32_t r = 0; r < patch->height; r++) {
        for (int32_t k = 0; k < PATCH_STEP; k++) {
            const int32_t point = r * PATCH_MAX_WIDTH + (k < patch->width ? k : 0);
            x_q18[k] = patch->x_q18[point];
            y_q18[k] = patch->y_q18[point];
        }
        const patch_t step = {pixels, 0, x_q18, y_q18, PATCH_STEP, 1};
        call->weigh(&step, call->window, source);
        memcpy(patch->out + r * patch->stride, pixels, (size_t)(patch->width * call->pixel_bytes));
    }
}

static void weigh_in(const call_t *call, const patch_t *patch, const window_source_t *source)
{
    if (patch->width < PATCH_STEP)
        weigh_narrow(call, patch, source);
    else
        call->weigh(patch, call->window, source);
}

/* Apart from its callers, whose frames would hold this buffer several times over. */
static __attribute__((noinline)) void weigh_mirrored(const call_t *call, const patch_t *patch, reach_t x, reach_t y)
{
    uint8_t mirrored[MIRRORED_BYTES];
    const ptrdiff_t stride = mirrored_stride(x, call->texels->texel_bytes);
    copy_mirrored(mirrored, stride, call->texels, x, y);
    const window_source_t source = source_from(call, mirrored, stride, x.begin, y.begin);
    weigh_in(call, patch, &source);
}

/* Halves, ten times at most, until what a piece reads is inside the picture or can be copied. */
static void weigh_pieces(const call_t *call, const patch_t *patch)
{
    const texels_t *texels = call->texels;
    const reach_t x = reach_of(patch, patch->x_q18, start_q18(&call->window->x), call->taps[0]);
    const reach_t y = reach_of(patch, patch->y_q18, start_q18(&call->window->y), call->taps[1]);
    if (is_inside(x, texels->width) && is_inside(y, texels->height)) {
        const window_source_t source = source_from(call, texels->data, texels->stride, 0, 0);
        weigh_in(call, patch, &source);
        return;
    }
    if (mirrored_stride(x, texels->texel_bytes) * (y.end - y.begin) <= MIRRORED_BYTES) {
        weigh_mirrored(call, patch, x, y);
        return;
    }
    patch_t half[2] = {*patch, *patch};
    if (patch->height > 1) {
        half[0].height /= 2;
        half[1].height -= half[0].height;
        half[1].out += half[0].height * patch->stride;
        half[1].x_q18 += half[0].height * PATCH_MAX_WIDTH;
        half[1].y_q18 += half[0].height * PATCH_MAX_WIDTH;
    } else {
        half[0].width /= 2;
        half[1].width -= half[0].width;
        half[1].out += half[0].width * call->pixel_bytes;
        half[1].x_q18 += half[0].width;
        half[1].y_q18 += half[0].width;
    }
    weigh_pieces(call, &half[0]);
    weigh_pieces(call, &half[1]);
}

static void clamp_points(int32_t *to, const int32_t *from, const patch_t *patch, int32_t size)
{
    for (int32_t r = 0; r < patch->height; r++)
        for (int32_t k = 0; k < patch->width; k++)
            to[r * PATCH_MAX_WIDTH + k] = clamp_i32(from[r * PATCH_MAX_WIDTH + k], 0, size << GRID_FRACTION_BITS);
}

static __attribute__((noinline)) void weigh_clamped(const call_t *call, const patch_t *patch)
{
    int32_t x_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
    patch_t clamped = *patch;
    clamp_points(x_q18, patch->x_q18, patch, call->texels->width);
    clamp_points(y_q18, patch->y_q18, patch, call->texels->height);
    clamped.x_q18 = x_q18;
    clamped.y_q18 = y_q18;
    weigh_pieces(call, &clamped);
}

void weigh_anywhere(const patch_t *patch, const window_t *window, const texels_t *texels, const int32_t taps[2],
                    int32_t pixel_bytes, weigh_patch_fn *weigh)
{
    if (patch->width == 0 || patch->height == 0)
        return;
    const call_t call = {window, texels, weigh, {taps[0], taps[1]}, pixel_bytes};
    const reach_t x = reach_of(patch, patch->x_q18, start_q18(&window->x), taps[0]);
    const reach_t y = reach_of(patch, patch->y_q18, start_q18(&window->y), taps[1]);
    if (patch->width < PATCH_STEP || !is_inside(x, texels->width) || !is_inside(y, texels->height)) {
        weigh_clamped(&call, patch);
        return;
    }
    const window_source_t source = source_from(&call, texels->data, texels->stride, 0, 0);
    weigh(patch, window, &source);
}
