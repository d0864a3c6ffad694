// SPDX-License-Identifier: Apache-2.0
// A band of the panel's rows: sides of its blocks, then its pixels. Parts of warp_work().
#ifndef WARP_FIXED_WARP_BAND_H
#define WARP_FIXED_WARP_BAND_H

#include "warp_fixed/warp.h"
#include "warp_fixed/warp_convert.h"

/** Sides of the blocks of a plane's band; marks in the worker's scratch which levels they read. For resamplers that
 * average. */
void warp_band_measure(warp_t *warp, int plane, int32_t worker, int32_t band);

/** Write every pixel of a band. What they read must have been made. */
void warp_band_draw(warp_t *warp, int plane, int32_t worker, int32_t band, const warp_target_t *target);

#endif
