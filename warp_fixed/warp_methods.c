// SPDX-License-Identifier: Apache-2.0
// Which methods a warp is ready for: their tables of weights, side by side.
#include "warp_fixed/warp.h"

/* What the method resamples texels with, if it ever does: filters let the picture through while k <= 1. */
static warp_resampler_t of_texels(warp_method_t method)
{
    return method.resampler == WARP_AUTO ? WARP_MEAN_CUBIC : method.resampler;
}

static warp_resampler_t of_coefficients(warp_method_t method)
{
    return method.resampler == WARP_AUTO ? WARP_MEAN_SPLINE : method.resampler;
}

/* Does it ever resample coefficients, or filter for WARP_NEAREST? */
static bool filters(warp_method_t method)
{
    return method.filter != WARP_FILTER_NONE || warp_splines(of_coefficients(method));
}

/* Which table that is, or the number of tables when there is none. */
static int32_t find_table(const warp_t *warp, warp_resampler_t resampler, bool of_coefficients)
{
    int32_t i = 0;
    while (i < warp->tables &&
           (warp->table[i].resampler != resampler || warp->table[i].of_coefficients != of_coefficients))
        i++;
    return i;
}

/* Is it there, or is there nothing to build? */
static bool has_table(const warp_t *warp, warp_resampler_t resampler, bool of_coefficients)
{
    return resampler == WARP_NEAREST || resampler == WARP_LS ||
           find_table(warp, resampler, of_coefficients) < warp->tables;
}

/* Build that table, if need be. @return false when there is no room. */
static bool add_table(warp_t *warp, warp_resampler_t resampler, bool of_coefficients)
{
    if (has_table(warp, resampler, of_coefficients))
        return true;
    const int32_t i = warp->tables;
    if (i == WARP_TABLES)
        return false;
    warp->table[i].resampler = resampler;
    warp->table[i].of_coefficients = of_coefficients;
    window_weights_init(&warp->table[i].weights, resampler, of_coefficients);
    warp->tables++;
    return true;
}

static bool has_memory(const warp_t *warp, warp_method_t method)
{
    return warp->fits ? !filters(method) : method.resampler != WARP_LS;
}

bool warp_has_method(const warp_t *warp, warp_method_t method)
{
    return has_memory(warp, method) && (warp_splines(of_texels(method)) || has_table(warp, of_texels(method), false)) &&
           (!filters(method) || has_table(warp, of_coefficients(method), true));
}

bool warp_add_method(warp_t *warp, warp_method_t method)
{
    const int32_t tables = warp->tables;
    if (!has_memory(warp, method))
        return false;
    const bool added = (warp_splines(of_texels(method)) || add_table(warp, of_texels(method), false)) &&
                       (!filters(method) || add_table(warp, of_coefficients(method), true));
    if (!added)
        warp->tables = tables;
    return added;
}

void warp_use_method(warp_t *warp, warp_method_t method)
{
    warp->method = method;
    warp->resampler = method.resampler;
    warp->filters = filters(method);
    warp->texel_table = find_table(warp, of_texels(method), false);
    warp->coefficient_table = find_table(warp, of_coefficients(method), true);
}

void warp_init(warp_t *warp, warp_method_t method, bool step_all, const uint8_t border[3])
{
    warp->step_all = step_all;
    for (int channel = 0; channel < 3; channel++)
        warp->border[channel] = border[2 - channel];
    warp->border[3] = 0;
    warp->tables = 0;
    warp->step_known = true;
    warp->step = (footprint_step_t){.in_q16 = 0};
    warp->fits = method.resampler == WARP_LS;
    if (warp->fits)
        ls_init(&warp->ls);
    else
        prefilter_init(&warp->prefilter);
    const bool ready = warp_add_method(warp, method);
    (void)ready; /* one method never needs more than two tables */
    warp_use_method(warp, method);
}

void warp_set_ls_weights(warp_t *warp, const ls_weights_t *weights)
{
    if (warp->fits)
        ls_set_weights(&warp->ls, weights);
}
