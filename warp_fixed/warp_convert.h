// SPDX-License-Identifier: Apache-2.0
// Pictures and panels of other formats than their planes: taken apart before the warp, put together after it.
#ifndef WARP_FIXED_WARP_CONVERT_H
#define WARP_FIXED_WARP_CONVERT_H

#include "warp_fixed/warp.h"

/** Where rows of a plane are drawn: row j of the panel at row j - first_row of the image. */
typedef struct {
    image_t image;
    int32_t first_row;
} warp_target_t;

/** @return Must the present picture be taken apart? */
bool warp_converts(const warp_t *warp);

/** @return A plane of the present picture, as it came or as warp_take() will make it. */
image_t warp_converted_plane(warp_t *warp, int plane);

/**
 * Take a worker's rows of the picture apart: of a rectangle around all that is seen on the panel, as far out as windows
 * reach; or of all of the picture when it is filtered, fitted or reduced first. For a frame in which something is lit.
 */
void warp_take(warp_t *warp, worker_t worker);

/** @return Where a worker draws a plane's rows from first_row on: the panel, or rows of its own. */
warp_target_t warp_target(warp_t *warp, int plane, int32_t worker, int32_t first_row);

/** Put a worker's own rows, of a unit that begins at first_row of the panel, together in the panel. */
void warp_pack(warp_t *warp, int32_t worker, int32_t first_row);

#endif
