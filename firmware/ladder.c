// SPDX-License-Identifier: Apache-2.0
// The cheaper methods that stand in for a method when a board is too slow for it, and what each costs.
#include "firmware/ladder.h"

/*
 * Instructions of XRGB frames with NEON loops, in tenths, as tests/bench/baseline.csv (make bench-arm) had them once;
 * test_ladder.c says when their ratios are off by more than 1.3. Per lit pixel the case and the grid, over the 49.3 %
 * of the panel that are lit in the pose strong, and over the 87.8 % of mild; the mean. A tap of a filter: cases gauss
 * and kaiser, of 7. Coefficients and fit are in no case; they were counted in the same way.
 */
enum { TENTHS_PER_UNIT = 10000, TAP_PICTURE_PIXEL = 26, SPLINE_PICTURE_PIXEL = 571, LS_PICTURE_PIXEL = 800 };

static const uint16_t lit_pixel[] = {
    [WARP_NEAREST] = 134, [WARP_LINEAR] = 253, [WARP_CUBIC] = 410,      [WARP_SPLINE] = 570,
    [WARP_LS] = 1107,     [WARP_AREA] = 379,   [WARP_MEAN_CUBIC] = 629, [WARP_MEAN_SPLINE] = 833,
};

/* Half lengths for k = 1, Q8 (fir_design.h): 4 sigma, sigma = sqrt(ln 2) / pi; 6; butter's is cut at about 8. */
static const uint16_t half_length_q8[] = {
    [WARP_FILTER_NONE] = 0, [WARP_FILTER_GAUSS] = 271, [WARP_FILTER_KAISER] = 1536, [WARP_FILTER_BUTTER] = 2048};

/* @return WARP_AUTO for nothing: no step down leads there. */
static warp_resampler_t below(const warp_method_t *method)
{
    if (method->filter != WARP_FILTER_NONE) /* area costs more than a short filter and nearest */
        return method->resampler == WARP_NEAREST ? WARP_LINEAR : WARP_AREA;
    switch (method->resampler) {
    case WARP_AUTO:
    case WARP_LS:
    case WARP_MEAN_SPLINE:
        return WARP_MEAN_CUBIC;
    case WARP_MEAN_CUBIC:
        return WARP_AREA;
    case WARP_SPLINE:
        return WARP_CUBIC;
    case WARP_AREA:
    case WARP_CUBIC:
        return WARP_LINEAR;
    case WARP_LINEAR:
        return WARP_NEAREST;
    case WARP_NEAREST:
        break;
    }
    return WARP_AUTO;
}

static const warp_method_t *without_filter(warp_resampler_t resampler)
{
    int i = 0;
    while (warp_methods[i].filter != WARP_FILTER_NONE || warp_methods[i].resampler != resampler)
        i++; /* every resampler is there without a filter */
    return &warp_methods[i];
}

ladder_t ladder_of(const warp_method_t *method)
{
    ladder_t ladder = {.steps = 1, .method = {method}};
    warp_resampler_t next = below(method);
    while (next != WARP_AUTO && ladder.steps < LADDER_STEPS) {
        const warp_method_t *step = without_filter(next);
        ladder.method[ladder.steps++] = step;
        next = below(step);
    }
    return ladder;
}

bool ladder_needs_step(const ladder_t *ladder)
{
    const warp_method_t *best = ladder->method[0]; /* the only one that filters or chooses */
    return best->filter != WARP_FILTER_NONE || best->resampler == WARP_AUTO;
}

/* In tenths of an instruction. */
static uint64_t per_picture_pixel(const warp_method_t *method, warp_resampler_t resampler, uint32_t k_q16)
{
    uint64_t cost = warp_splines(resampler) ? SPLINE_PICTURE_PIXEL : resampler == WARP_LS ? LS_PICTURE_PIXEL : 0;
    const uint32_t k_most_q16 = 64u << 16;
    if (method->filter != WARP_FILTER_NONE && k_q16 > 1u << 16) {
        const uint64_t k = k_q16 < k_most_q16 ? k_q16 : k_most_q16;
        const uint64_t half_length = (half_length_q8[method->filter] * k + (1u << 24) - 1) >> 24;
        cost += TAP_PICTURE_PIXEL * (2 * half_length + 1);
    }
    return cost;
}

uint32_t ladder_cost(const warp_method_t *method, const ladder_frame_t *frame)
{
    const bool is_auto = method->resampler == WARP_AUTO;
    /* As if it had chosen the spline before: rather too much than too little. */
    const warp_resampler_t resampler =
        is_auto ? warp_resampler_for_step(WARP_MEAN_SPLINE, frame->k_q16) : method->resampler;
    uint64_t tenths = (uint64_t)frame->lit_pixels * lit_pixel[resampler];
    if (frame->lit_pixels > 0)
        tenths += (uint64_t)frame->picture_pixels * per_picture_pixel(method, resampler, (uint32_t)frame->k_q16);
    return (uint32_t)(tenths / TENTHS_PER_UNIT) + 1; /* <= 2^23.1 * (5660 + 1280 + 84 * 1025) / 10^4 < 2^27 */
}
