// SPDX-License-Identifier: Apache-2.0
// Where a patch's loop reads some rows later: fetched ahead, since a row is done sooner than memory answers.
#ifndef WARP_FIXED_WINDOW_AHEAD_H
#define WARP_FIXED_WINDOW_AHEAD_H

#include "warp_fixed/window_patch_neon.h"

enum { ROWS_AHEAD = 4 /**< as measured on Zen 4: 2 are too few, 6 no better */ };

/**
 * How far from the windows of row r those lie that come ROWS_AHEAD rows later. After the last row comes the patch to
 * the right, most often: it begins where this one ends.
 *
 * @return Bytes in the source, more or less: rows of a patch are nearly alike. They may lead outside. 0 where the patch
 *         has fewer rows than that.
 */
static inline ptrdiff_t bytes_ahead(const patch_t *patch, int32_t r, const window_source_t *source, int texel_log2)
{
    if (patch->height < ROWS_AHEAD)
        return 0;
    const int32_t from = r * PATCH_MAX_WIDTH, below = r + ROWS_AHEAD, beside = below - patch->height;
    const int32_t to = beside < 0 ? below * PATCH_MAX_WIDTH : beside * PATCH_MAX_WIDTH + patch->width - 1;
    const ptrdiff_t x = (patch->x_q18[to] >> GRID_FRACTION_BITS) - (patch->x_q18[from] >> GRID_FRACTION_BITS);
    const ptrdiff_t y = (patch->y_q18[to] >> GRID_FRACTION_BITS) - (patch->y_q18[from] >> GRID_FRACTION_BITS);
    return y * source->stride + x * (1 << texel_log2);
}

/**
 * Ask for a cache line of each of so many rows, the first `offset` bytes from data; all may lie outside. Nothing on
 * AArch64: it would cost instructions, and what it saves is not measured there.
 */
NEON_INLINE void prefetch_rows(const uint8_t *data, ptrdiff_t offset, ptrdiff_t stride, int32_t rows)
{
#ifdef __SSE2__
    for (int32_t t = 0; t < rows; t++)
        __builtin_prefetch((const void *)((uintptr_t)data + (uintptr_t)(offset + t * stride)));
#else
    (void)data;
    (void)offset;
    (void)stride;
    (void)rows;
#endif
}

#endif
