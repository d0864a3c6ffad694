// SPDX-License-Identifier: Apache-2.0
// Names of the methods: a prefilter and a way to resample.
#ifndef WARP_FIXED_METHOD_H
#define WARP_FIXED_METHOD_H

#include <stdbool.h>
#include <stdint.h>

typedef enum { WARP_FILTER_NONE, WARP_FILTER_GAUSS, WARP_FILTER_KAISER, WARP_FILTER_BUTTER } warp_filter_t;

typedef enum {
    WARP_NEAREST,     /**< the picture pixel under the point */
    WARP_LINEAR,      /**< bilinear */
    WARP_CUBIC,       /**< Keys' cubic convolution, a = -1/2 */
    WARP_SPLINE,      /**< interpolating cubic B-spline */
    WARP_LS,          /**< least-squares cubic spline for the step k */
    WARP_AREA,        /**< mean over the pixel's footprint of the picture as squares */
    WARP_MEAN_CUBIC,  /**< mean over the footprint, less the picture pixels' own, of the cubic surface */
    WARP_MEAN_SPLINE, /**< the same of the spline surface */
    WARP_AUTO         /**< mean+spline or mean+cubic, by the step k: warp_resampler_for_step() */
} warp_resampler_t;

/** @return true for those that average over footprints. WARP_AUTO itself does not: ask for its choice. */
static inline bool warp_averages(warp_resampler_t resampler)
{
    return resampler == WARP_AREA || resampler == WARP_MEAN_CUBIC || resampler == WARP_MEAN_SPLINE;
}

/** @return true for those that resample spline coefficients. WARP_AUTO itself does not: ask for its choice. */
static inline bool warp_splines(warp_resampler_t resampler)
{
    return resampler == WARP_SPLINE || resampler == WARP_MEAN_SPLINE;
}

enum { WARP_AUTO_SPLINE_K_Q16 = 65536, WARP_AUTO_CUBIC_K_Q16 = 73728 };

/**
 * What WARP_AUTO resamples a frame with. While the picture is magnified all over the wall (k <= 1), mean+spline is some
 * 0.1 dB nearer to a finer original; with a larger k mean+cubic is within 0.02 dB of it at half the work. Between 1 and
 * 1.125 the last frame's choice stays, so that a viewer at the limit sees no flicker.
 *
 * @param last   Of the frame before; anything else than WARP_MEAN_SPLINE counts as WARP_MEAN_CUBIC.
 * @param k_q16  The frame's step k; 0, when no pixel lands in the picture, changes nothing.
 */
warp_resampler_t warp_resampler_for_step(warp_resampler_t last, int32_t k_q16);

/** One row of the table of methods. */
typedef struct {
    const char *name; /**< as in room files and on command lines */
    warp_filter_t filter;
    warp_resampler_t resampler;
} warp_method_t;

enum { WARP_METHODS = 21 };

/** Every method of this build. The last one is the default. */
extern const warp_method_t warp_methods[WARP_METHODS];

/** @return The method of that name, or NULL. */
const warp_method_t *warp_method_from_name(const char *name);

/** @return mean+cubic. */
const warp_method_t *warp_method_default(void);

#endif
