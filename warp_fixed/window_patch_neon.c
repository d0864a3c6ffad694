// SPDX-License-Identifier: Apache-2.0
// Patches whose windows need no checks: those inside the picture, and copies of its edge continued by mirroring.
#include "warp_fixed/window_patch_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_copy_neon.h"

enum { EDGE_WIDTH = 32 };

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

bool points_inside(const patch_t *patch, int32_t width, int32_t height)
{
    return reach_is_inside(reach_of(patch, patch->x_q18, 0, 1), width) &&
           reach_is_inside(reach_of(patch, patch->y_q18, 0, 1), height);
}

/* What the pieces of a call share. */
typedef struct {
    const window_t *window;
    const texels_t *texels;
    const patch_loop_t *loop;
} call_t;

static reach_t columns_of(const call_t *call, const patch_t *patch)
{
    return reach_of(patch, patch->x_q18, start_q18(&call->window->x), call->loop->taps_x);
}

static reach_t rows_of(const call_t *call, const patch_t *patch)
{
    return reach_of(patch, patch->y_q18, start_q18(&call->window->y), call->loop->taps_y);
}

static window_source_t source_from(const call_t *call, const uint8_t *data, ptrdiff_t stride, int32_t x, int32_t y)
{
    return (window_source_t){data, (int32_t)stride, start_q18(&call->window->x) - x * (1 << GRID_FRACTION_BITS),
                             start_q18(&call->window->y) - y * (1 << GRID_FRACTION_BITS)};
}

/* Fewer columns than a step has: one pixel fills it up, and the step is written beside the panel. */
static __attribute__((noinline)) void weigh_narrow(const call_t *call, const patch_t *patch,
                                                   const window_source_t *source)
{
    int32_t x_q18[PATCH_MAX_STEP], y_q18[PATCH_MAX_STEP];
    uint8_t pixels[PATCH_MAX_STEP * sizeof(uint32_t)];
    for (int32_t r = 0; r < patch->height; r++) {
        for (int32_t k = 0; k < call->loop->step; k++) {
            const int32_t point = r * PATCH_MAX_WIDTH + (k < patch->width ? k : 0);
            x_q18[k] = patch->x_q18[point];
            y_q18[k] = patch->y_q18[point];
        }
        const patch_t step = {pixels, 0, x_q18, y_q18, call->loop->step, 1};
        call->loop->weigh(&step, call->window, source);
        memcpy(patch->out + r * patch->stride, pixels, (size_t)(patch->width * call->loop->pixel_bytes));
    }
}

/* Whole steps; the last columns are done again with those before them. */
static void weigh_in(const call_t *call, const patch_t *patch, const window_source_t *source)
{
    const int32_t step = call->loop->step, rest = patch->width % step, from = patch->width - step;
    if (from < 0) {
        weigh_narrow(call, patch, source);
        return;
    }
    patch_t steps = *patch;
    steps.width -= rest;
    call->loop->weigh(&steps, call->window, source);
    if (rest != 0) {
        const patch_t last = {patch->out + from * call->loop->pixel_bytes,
                              patch->stride,
                              patch->x_q18 + from,
                              patch->y_q18 + from,
                              step,
                              patch->height};
        call->loop->weigh(&last, call->window, source);
    }
}

/* Apart from its callers, whose frames would hold this buffer several times over. */
static __attribute__((noinline)) void weigh_copy(const call_t *call, const patch_t *patch, reach_t x, reach_t y)
{
    uint8_t copy[COPY_ROWS * COPY_STRIDE];
    copy_texels(copy, call->texels, call->loop, x, y);
    const window_source_t source = source_from(call, copy, COPY_STRIDE, x.begin, y.begin);
    weigh_in(call, patch, &source);
}

/* Two halves of a patch of more than one pixel; the longer side is cut. */
static void halve(patch_t half[2], const patch_t *patch, int32_t pixel_bytes)
{
    half[0] = half[1] = *patch;
    if (patch->height >= patch->width) {
        const int32_t rows = patch->height / 2;
        half[0].height = rows;
        half[1].height -= rows;
        half[1].out += rows * patch->stride;
        half[1].x_q18 += rows * PATCH_MAX_WIDTH;
        half[1].y_q18 += rows * PATCH_MAX_WIDTH;
    } else {
        const int32_t columns = patch->width / 2;
        half[0].width = columns;
        half[1].width -= columns;
        half[1].out += columns * pixel_bytes;
        half[1].x_q18 += columns;
        half[1].y_q18 += columns;
    }
}

/* A patch whose points are in the picture, in halves, ten times at most, until what a piece reads can be copied. */
static void weigh_copies(const call_t *call, const patch_t *patch, reach_t x, reach_t y)
{
    if (copy_fits(call->texels, call->loop, x, y)) {
        weigh_copy(call, patch, x, y);
        return;
    }
    patch_t half[2];
    halve(half, patch, call->loop->pixel_bytes);
    for (int i = 0; i < 2; i++)
        weigh_copies(call, &half[i], columns_of(call, &half[i]), rows_of(call, &half[i]));
}

/* @return Points clamped to the picture: those of the patch if they are in it, else in `to`. */
static const int32_t *clamp_points(int32_t *to, const int32_t *from, const patch_t *patch, int32_t size)
{
    if (reach_is_inside(reach_of(patch, from, 0, 1), size))
        return from;
    const int32_t most = size << GRID_FRACTION_BITS;
    for (int32_t r = 0; r < patch->height; r++, from += PATCH_MAX_WIDTH) {
        int32_t *row = to + r * PATCH_MAX_WIDTH, k = 0;
        for (; k + 4 <= patch->width; k += 4)
            vst1q_s32(row + k, vminq_s32(vmaxq_s32(vld1q_s32(from + k), vdupq_n_s32(0)), vdupq_n_s32(most)));
        for (; k < patch->width; k++)
            row[k] = clamp_i32(from[k], 0, most);
    }
    return to;
}

static __attribute__((noinline)) void weigh_edge(const call_t *call, const patch_t *patch)
{
    int32_t x_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
    patch_t clamped = *patch;
    clamped.x_q18 = clamp_points(x_q18, patch->x_q18, patch, call->texels->width);
    clamped.y_q18 = clamp_points(y_q18, patch->y_q18, patch, call->texels->height);
    weigh_copies(call, &clamped, columns_of(call, &clamped), rows_of(call, &clamped));
}

/* Halves, so that little of a patch counts as edge. */
static void weigh_pieces(const call_t *call, const patch_t *patch)
{
    const texels_t *texels = call->texels;
    const reach_t x = columns_of(call, patch), y = rows_of(call, patch);
    const bool inside = reach_is_inside(x, texels->width) && reach_is_inside(y, texels->height);
    const bool copied = call->loop->centred || call->loop->pair_step != 0;
    if (inside && copied) {
        weigh_copies(call, patch, x, y);
    } else if (inside) {
        const window_source_t source = source_from(call, texels->data, texels->stride, 0, 0);
        weigh_in(call, patch, &source);
    } else if (patch->width <= EDGE_WIDTH) {
        weigh_edge(call, patch);
    } else {
        patch_t half[2];
        halve(half, patch, call->loop->pixel_bytes);
        weigh_pieces(call, &half[0]);
        weigh_pieces(call, &half[1]);
    }
}

void weigh_anywhere(const patch_t *patch, const window_t *window, const texels_t *texels, const patch_loop_t *loop)
{
    const call_t call = {window, texels, loop};
    if (patch->width > 0 && patch->height > 0)
        weigh_pieces(&call, patch);
}
