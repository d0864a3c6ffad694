// SPDX-License-Identifier: Apache-2.0
// Names of the methods: a prefilter and a way to resample.
#include "warp_fixed/method.h"

#include <stddef.h>

#include "warp_fixed/same_text.h"

const warp_method_t warp_methods[WARP_METHODS] = {
    {"none+nearest", WARP_FILTER_NONE, WARP_NEAREST},
    {"none+linear", WARP_FILTER_NONE, WARP_LINEAR},
    {"none+cubic", WARP_FILTER_NONE, WARP_CUBIC},
    {"none+spline", WARP_FILTER_NONE, WARP_SPLINE},
    {"gauss+nearest", WARP_FILTER_GAUSS, WARP_NEAREST},
    {"gauss+linear", WARP_FILTER_GAUSS, WARP_LINEAR},
    {"gauss+cubic", WARP_FILTER_GAUSS, WARP_CUBIC},
    {"gauss+spline", WARP_FILTER_GAUSS, WARP_SPLINE},
    {"kaiser+nearest", WARP_FILTER_KAISER, WARP_NEAREST},
    {"kaiser+linear", WARP_FILTER_KAISER, WARP_LINEAR},
    {"kaiser+cubic", WARP_FILTER_KAISER, WARP_CUBIC},
    {"kaiser+spline", WARP_FILTER_KAISER, WARP_SPLINE},
    {"butter+nearest", WARP_FILTER_BUTTER, WARP_NEAREST},
    {"butter+linear", WARP_FILTER_BUTTER, WARP_LINEAR},
    {"butter+cubic", WARP_FILTER_BUTTER, WARP_CUBIC},
    {"butter+spline", WARP_FILTER_BUTTER, WARP_SPLINE},
    {"ls", WARP_FILTER_NONE, WARP_LS},
    {"auto", WARP_FILTER_NONE, WARP_AUTO},
    {"area", WARP_FILTER_NONE, WARP_AREA},
    {"mean+spline", WARP_FILTER_NONE, WARP_MEAN_SPLINE},
    {"mean+cubic", WARP_FILTER_NONE, WARP_MEAN_CUBIC},
};

const warp_method_t *warp_method_from_name(const char *name)
{
    for (int i = 0; i < WARP_METHODS; i++)
        if (same_text(warp_methods[i].name, name))
            return &warp_methods[i];
    return NULL;
}

const warp_method_t *warp_method_default(void)
{
    return &warp_methods[WARP_METHODS - 1];
}

warp_resampler_t warp_resampler_for_step(warp_resampler_t last, int32_t k_q16)
{
    const bool spline = last == WARP_MEAN_SPLINE;
    if (k_q16 == 0)
        return spline ? WARP_MEAN_SPLINE : WARP_MEAN_CUBIC;
    const int32_t limit_q16 = spline ? WARP_AUTO_CUBIC_K_Q16 : WARP_AUTO_SPLINE_K_Q16;
    return k_q16 <= limit_q16 ? WARP_MEAN_SPLINE : WARP_MEAN_CUBIC;
}
