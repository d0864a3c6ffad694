// SPDX-License-Identifier: Apache-2.0
// One table of weights for every interpolating and averaging kernel, by side of the footprint and phase.
#include "warp_fixed/window_weights.h"

#include <stddef.h>

/*
 * Positions t here are in 1/128 px from a texel's centre, so that phases and half sides are whole.
 * Values and integrals are exact integers on a scale of the kernel's own; only their ratios are used.
 */
typedef struct {
    int32_t half_width;             /* of the kernel's support, 1/128 px */
    bool positive;                  /* no weight is negative */
    int64_t (*value)(int64_t t);    /* kernel */
    int64_t (*integral)(int64_t t); /* running integral from 0, or NULL when it is only interpolated with */
} kernel_t;

enum { ONE = PHASES };

static int64_t box_value(int64_t t)
{
    return t >= -ONE / 2 && t < ONE / 2;
}

static int64_t box_integral(int64_t t)
{
    return clamp_i64(t, -ONE / 2, ONE / 2);
}

static int64_t tent_value(int64_t t)
{
    return clamp_i64(ONE - (t < 0 ? -t : t), 0, ONE);
}

/* Keys 1981, a = -1/2, times 2 * 128^3: 3 t^3 - 5 t^2 + 2 up to 1, -t^3 + 5 t^2 - 8 t + 4 up to 2. */
static int64_t keys_value(int64_t t)
{
    const int64_t a = t < 0 ? -t : t;
    if (a >= 2 * ONE)
        return 0;
    if (a >= ONE)
        return ((-a + 5 * ONE) * a - 8 * ONE * ONE) * a + 4 * ONE * ONE * ONE;
    return (3 * a - 5 * ONE) * a * a + 2 * ONE * ONE * ONE;
}

/* Its integral times 24 * 128^4: 9 t^4 - 20 t^3 + 24 t up to 1, -3 t^4 + 20 t^3 - 48 t^2 + 48 t - 4 up to 2. */
static int64_t keys_integral(int64_t t)
{
    const int64_t a = clamp_i64(t < 0 ? -t : t, 0, 2 * ONE);
    const int64_t cube = (int64_t)ONE * ONE * ONE;
    const int64_t size = a < ONE ? ((9 * a - 20 * ONE) * a * a + 24 * cube) * a
                                 : (((-3 * a + 20 * ONE) * a - 48 * ONE * ONE) * a + 48 * cube) * a - 4 * cube * ONE;
    return t < 0 ? -size : size;
}

/* The cubic B-spline times 6 * 128^3: 3 t^3 - 6 t^2 + 4 up to 1, (2 - t)^3 up to 2. */
static int64_t spline_value(int64_t t)
{
    const int64_t a = clamp_i64(t < 0 ? -t : t, 0, 2 * ONE), rest = 2 * ONE - a;
    return a < ONE ? (3 * a - 6 * ONE) * a * a + 4 * ONE * ONE * ONE : rest * rest * rest;
}

/* Its integral times 24 * 128^4: 3 t^4 - 8 t^3 + 16 t up to 1, 12 - (2 - t)^4 up to 2. */
static int64_t spline_integral(int64_t t)
{
    const int64_t a = clamp_i64(t < 0 ? -t : t, 0, 2 * ONE), rest = 2 * ONE - a;
    const int64_t cube = (int64_t)ONE * ONE * ONE;
    const int64_t size =
        a < ONE ? ((3 * a - 8 * ONE) * a * a + 16 * cube) * a : 12 * cube * ONE - rest * rest * rest * rest;
    return t < 0 ? -size : size;
}

static const kernel_t *kernel_of(warp_resampler_t resampler)
{
    static const kernel_t tent = {ONE, false, tent_value, NULL};
    static const kernel_t keys = {2 * ONE, false, keys_value, keys_integral};
    static const kernel_t spline = {2 * ONE, true, spline_value, spline_integral};
    static const kernel_t box = {ONE / 2, true, box_value, box_integral};
    switch (resampler) {
    case WARP_LINEAR:
        return &tent;
    case WARP_CUBIC:
    case WARP_MEAN_CUBIC:
        return &keys;
    case WARP_SPLINE:
    case WARP_MEAN_SPLINE:
        return &spline;
    case WARP_AREA:
        return &box;
    case WARP_NEAREST:
    case WARP_AUTO:
    case WARP_LS:
        break;
    }
    return NULL;
}

/* Round exact[i] / sum(exact) * sum to integers whose sum is exact: largest remainders first, then lower index. */
static void round_to_sum(int16_t *rounded, const int64_t *exact, int32_t taps, int32_t sum)
{
    int64_t total = 0, rest[WINDOW_MAX_TAPS];
    for (int32_t i = 0; i < taps; i++)
        total += exact[i];
    int32_t missing = sum;
    for (int32_t i = 0; i < taps; i++) {
        const int64_t scaled = exact[i] * sum;
        int64_t quotient = scaled / total;
        rest[i] = scaled - quotient * total;
        if (rest[i] < 0) {
            rest[i] += total;
            quotient--;
        }
        rounded[i] = (int16_t)quotient;
        missing -= (int32_t)quotient;
    }
    for (; missing > 0; missing--) { /* fewer than taps */
        int32_t largest = 0;
        for (int32_t i = 1; i < taps; i++)
            if (rest[i] > rest[largest])
                largest = i;
        rounded[largest]++;
        rest[largest] = -1;
    }
}

/* Side of a table entry in 1/64 px: see WINDOW_SIDES. */
static int32_t side_q6(int32_t side)
{
    if (side < 64)
        return side;
    const int32_t octave = (side - 64) / 32;
    return (64 + 2 * ((side - 64) % 32)) << octave;
}

static bool is_short(int32_t taps)
{
    return taps <= WINDOW_SHORT_TAPS;
}

/* Entries from row to row. */
static int32_t row_of(int32_t taps)
{
    return is_short(taps) ? WINDOW_SHORT_TAPS : taps;
}

/* Of windows of texels. */
static int32_t first_shift_of(int32_t taps)
{
    return is_short(taps) ? 0 : LONG_FIRST_SHIFT;
}

/* The first texel's centre is at s/2 + h - row/128 before the point. */
static void fill_row(window_weights_t *weights, const kernel_t *kernel, int32_t side, int32_t row)
{
    const int32_t s = side_q6(side), taps = weights->taps[side];
    const size_t at = weights->at[side] + (size_t)row * (size_t)row_of(taps);
    int64_t exact[WINDOW_MAX_TAPS];
    for (int32_t i = 0; i < taps; i++) {
        const int64_t t = kernel->half_width + s - ONE + row - ONE * i;
        exact[i] = s == 0 ? kernel->value(t) : kernel->integral(t + s) - kernel->integral(t - s);
        weights->negative |= exact[i] < 0;
    }
    int32_t first_sum = (kernel->positive ? FIRST_SUM_POSITIVE : FIRST_SUM) << first_shift_of(taps);
    int32_t second_sum = kernel->positive ? SECOND_SUM_POSITIVE : SECOND_SUM;
    if (weights->of_coefficients)
        first_sum = second_sum = 1 << COEFFICIENT_SUM_LOG2;
    round_to_sum(&weights->first[at], exact, taps, first_sum);
    round_to_sum(&weights->second[at], exact, taps, second_sum);
    for (int32_t i = taps; i < row_of(taps); i++)
        weights->first[at + (size_t)i] = weights->second[at + (size_t)i] = 0;
}

/* Those of short windows, `count` of them. */
static void fill_bytes(window_weights_t *weights, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        weights->first_bytes[i] = (uint8_t)(weights->negative ? -weights->first[i] : weights->first[i]);
    if (!weights->negative || weights->taps[0] != CUBIC_TAPS)
        return;
    for (uint32_t row = 0; row < PHASES; row++)
        for (uint32_t t = 0; t < CUBIC_TAPS; t++) {
            const uint32_t at = row * WINDOW_SHORT_TAPS + t;
            const int16_t weight = weights->first[at];
            weights->first_bytes[at + CUBIC_TAPS] = (uint8_t)(weight < 0 ? -weight : weight);
        }
}

/* @return What follows a row of zeros. */
static uint32_t skip_zeros(window_weights_t *weights, uint32_t at)
{
    const uint32_t end = at + WINDOW_SHORT_TAPS;
    for (; at < end; at++)
        weights->first[at] = weights->second[at] = 0;
    return end;
}

void window_weights_init(window_weights_t *weights, warp_resampler_t resampler, bool of_coefficients)
{
    const kernel_t *kernel = kernel_of(resampler);
    if (kernel == NULL)
        return;
    weights->resampler = resampler;
    weights->of_coefficients = of_coefficients;
    weights->negative = false;
    weights->half_width = kernel->half_width;
    const int32_t sides = warp_averages(resampler) ? WINDOW_SIDES : 1;
    uint32_t at = 0, in_bytes = 0;
    for (int32_t side = 0; side < sides; side++) {
        const int32_t support = 2 * kernel->half_width + 2 * side_q6(side); /* 1/128 px */
        const int32_t taps = (support + ONE - 1) / ONE;
        weights->taps[side] = (uint8_t)taps;
        weights->at[side] = at;
        at += (uint32_t)row_of(taps) * PHASES;
        if (side == 0)
            at = skip_zeros(weights, at);
        in_bytes = is_short(taps) ? at : in_bytes; /* short sides come first */
        for (int32_t row = 0; row < PHASES; row++)
            fill_row(weights, kernel, side, row);
    }
    if (!of_coefficients)
        fill_bytes(weights, in_bytes);
}

/* The table entry nearest to a side of at most WINDOW_MAX_SIDE px. */
static uint16_t nearest_side(uint32_t side_q16)
{
    if (side_q16 < 1u << 16)
        return (uint16_t)((side_q16 + (1u << 9)) >> 10);
    const int octave = 15 - __builtin_clz(side_q16);
    const uint32_t step_log2 = 11 + (uint32_t)octave;
    const uint32_t steps = (side_q16 - (1u << (16 + octave)) + (1u << (step_log2 - 1))) >> step_log2;
    return (uint16_t)(64u + 32u * (uint32_t)octave + steps);
}

/* sqrt(w^2 - 1). A function of its own: gcc would put it after the code that goes on with it, and jump back. */
static __attribute__((noinline)) uint32_t widening_q16(uint32_t width_q16)
{
    const uint64_t square = (uint64_t)width_q16 * width_q16, one = (uint64_t)1 << 32;
    return square > one ? floor_sqrt(square - one) : 0;
}

window_side_t window_side(warp_resampler_t resampler, uint32_t width_q16)
{
    if (!warp_averages(resampler))
        return (window_side_t){0, 0};
    const uint32_t largest = WINDOW_MAX_SIDE << 16;
    uint8_t level = 0;
    while (level < 2 && width_q16 > largest) {
        width_q16 >>= 3;
        level++;
    }
    if (resampler != WARP_AREA)
        width_q16 = widening_q16(width_q16);
    return (window_side_t){nearest_side(width_q16 < largest ? width_q16 : largest), level};
}

window_axis_t window_axis(const window_weights_t *weights, uint16_t side)
{
    const uint32_t at = weights->at[side];
    const int32_t taps = weights->taps[side];
    return (window_axis_t){
        .resampler = weights->resampler,
        .negative = weights->negative,
        .first = &weights->first[at],
        .second = &weights->second[at],
        .first_bytes = !weights->of_coefficients && is_short(taps) ? &weights->first_bytes[at] : NULL,
        .taps = taps,
        .row = row_of(taps),
        .lead = ONE - weights->half_width - side_q6(side),
        .first_shift = weights->of_coefficients ? COEFFICIENT_SUM_LOG2 : first_shift_of(taps),
    };
}
