// SPDX-License-Identifier: Apache-2.0
// Names of the methods: a prefilter and a way to resample.
#ifndef WARP_FIXED_METHOD_H
#define WARP_FIXED_METHOD_H

typedef enum { WARP_FILTER_NONE, WARP_FILTER_GAUSS, WARP_FILTER_KAISER, WARP_FILTER_BUTTER } warp_filter_t;

typedef enum {
    WARP_NEAREST,   /**< the picture pixel under the point */
    WARP_LINEAR,    /**< bilinear */
    WARP_CUBIC,     /**< Keys' cubic convolution, a = -1/2 */
    WARP_AREA,      /**< mean over the pixel's footprint of the picture as squares */
    WARP_MEAN_CUBIC /**< mean over the footprint, less the picture pixels' own, of the cubic surface */
} warp_resampler_t;

/** One row of the table of methods. */
typedef struct {
    const char *name; /**< as in room files and on command lines */
    warp_filter_t filter;
    warp_resampler_t resampler;
} warp_method_t;

enum { WARP_METHODS = 14 };

/** Every method of this build. The last one is the default. */
extern const warp_method_t warp_methods[WARP_METHODS];

/** @return The method of that name, or NULL. */
const warp_method_t *warp_method_from_name(const char *name);

/** @return mean+cubic. */
const warp_method_t *warp_method_default(void);

#endif
