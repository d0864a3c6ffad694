// SPDX-License-Identifier: Apache-2.0
// Copies of the part of a picture that the windows of a patch read, continued by mirroring and laid out for the loop.
#ifndef WARP_FIXED_WINDOW_COPY_NEON_H
#define WARP_FIXED_WINDOW_COPY_NEON_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/window_patch_neon.h"

enum { COPY_ROWS = 72, COPY_VECTOR = 16 };

/** Texels that windows read along one axis: [begin, end). */
typedef struct {
    int32_t begin, end;
} reach_t;

static inline bool reach_is_inside(reach_t reach, int32_t size)
{
    return reach.begin >= 0 && reach.end <= size;
}

/** @return How many vectors of COPY_VECTOR bytes a row of these texels takes. */
static inline int32_t copy_vectors(const texels_t *texels, reach_t x)
{
    return ((x.end - x.begin) * texels->texel_bytes + COPY_VECTOR - 1) / COPY_VECTOR;
}

/** @return Have these texels room in a copy for that loop? */
static inline bool copy_fits(const texels_t *texels, const patch_loop_t *loop, reach_t x, reach_t y)
{
    const int32_t bytes = copy_vectors(texels, x) * COPY_VECTOR;
    return (loop->pair_step != 0 ? 2 * bytes : bytes) <= COPY_STRIDE && y.end - y.begin <= COPY_ROWS;
}

/**
 * Make the copy that a loop reads.
 *
 * @param[out] copy  COPY_ROWS * COPY_STRIDE bytes. Texel (x.begin, y.begin) comes first.
 * @param      x, y  Not empty; copy_fits(). For a loop of pairs y has two rows at least, and one that is nowhere
 *                   the upper one of a pair makes no row of the copy.
 */
void copy_texels(uint8_t *copy, const texels_t *texels, const patch_loop_t *loop, reach_t x, reach_t y);

#endif
