// SPDX-License-Identifier: Apache-2.0
// Low-pass filters for a step k: cut-off 1 / (2 k) cycles per pixel, designed in integers, so the same taps everywhere.
#include "warp_fixed/fir_design.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/real.h"

enum {
    EXPONENT_BITS = 24,
    WEIGHT_BITS = 30,
    DFT_LOG2 = 11,
    DFT_POINTS = 1 << DFT_LOG2,
    SERIES_TERMS = 24 /* of cos on [0, 1] and of I0 on [0, 5]: the last is below 2^-50 */
};

/* pi in Q60. */
static real_t pi(void)
{
    return real_from_int(3622009729038561421, -60);
}

/* Weights in proportion to exact_q30, of distance 0 to radius, whose sum over both sides is exact. */
static void weights_to_sum(int16_t *weight, const int64_t *exact_q30, int32_t radius, int32_t sum)
{
    int64_t total = exact_q30[0];
    for (int32_t d = 1; d <= radius; d++)
        total += 2 * exact_q30[d];
    int32_t rest = sum;
    for (int32_t d = 1; d <= radius; d++) {
        const int64_t scaled = 2 * exact_q30[d] * sum + total;
        const int64_t rounded = (scaled - (scaled < 0 ? 2 * total - 1 : 0)) / (2 * total); /* floor(x + 1/2) */
        weight[d] = (int16_t)rounded;
        rest -= 2 * weight[d];
    }
    weight[0] = (int16_t)rest;
}

/* 2^-(exponent / 2^24) in Q30: the product of 2^-(2^-b) over the set bits b of the fraction. */
static int64_t power_of_half_q30(int64_t exponent_q24, const real_t root[EXPONENT_BITS])
{
    const int64_t whole = exponent_q24 >> EXPONENT_BITS;
    if (whole > WEIGHT_BITS)
        return 0;
    real_t power = real_from_int(1, -(int32_t)whole);
    for (int b = 0; b < EXPONENT_BITS; b++)
        if ((exponent_q24 >> (EXPONENT_BITS - 1 - b) & 1) != 0)
            power = real_mul(power, root[b]);
    return real_to_fixed(power, WEIGHT_BITS, INT64_MAX);
}

/* exp(-n^2 / (2 sigma^2)) = 2^-(c n^2 / k^2) with c = pi^2 / (2 ln(2)^2). @return the radius. */
static int32_t gauss_q30(int64_t *exact_q30, int32_t k_q16)
{
    /* 4 sqrt(ln 2) / pi in Q32, and c in Q32. */
    const int64_t cut_per_k_q32 = 4552843378, c_q32 = 44114228550;
    const int32_t radius = (int32_t)(cut_per_k_q32 * k_q16 >> 48);

    real_t root[EXPONENT_BITS]; /* 2^-(1/2), 2^-(1/4), ... */
    real_t next = real_from_int(1, -1);
    for (int b = 0; b < EXPONENT_BITS; b++)
        root[b] = next = real_sqrt(next);

    const real_t k = real_from_int(k_q16, -16);
    const real_t c_over_k2 = real_div(real_from_int(c_q32, -32), real_mul(k, k));
    for (int32_t d = 0; d <= radius; d++) {
        const real_t exponent = real_mul(c_over_k2, real_from_int((int64_t)d * d, 0));
        exact_q30[d] = power_of_half_q30(real_to_fixed(exponent, EXPONENT_BITS, INT64_MAX), root);
    }
    return radius;
}

/* cos(x) for 0 <= x <= pi: the Taylor series at x / 4, then cos 2x = 2 cos^2 x - 1 twice. */
static real_t cosine(real_t x)
{
    const real_t one = real_from_int(1, 0), quarter = real_scale(x, -2), square = real_mul(quarter, quarter);
    real_t term = one, sum = one;
    for (int n = 1; n <= SERIES_TERMS; n += 2) {
        term = real_neg(real_div(real_mul(term, square), real_from_int((int64_t)n * (n + 1), 0)));
        sum = real_add(sum, term);
    }
    for (int doubling = 0; doubling < 2; doubling++)
        sum = real_sub(real_scale(real_mul(sum, sum), 1), one);
    return sum;
}

/* I0(x), from x^2: the sum of (x^2 / 4)^m / (m!)^2. per_square[m - 1] = 1 / m^2, for a division costs ten products. */
static real_t bessel_i0(real_t square, const real_t per_square[SERIES_TERMS])
{
    const real_t quarter = real_scale(square, -2);
    real_t term = real_from_int(1, 0), sum = term;
    for (int m = 1; m <= SERIES_TERMS; m++) {
        term = real_mul(real_mul(term, quarter), per_square[m - 1]);
        sum = real_add(sum, term);
    }
    return sum;
}

/*
 * sin(pi n / k) / (pi n) * I0(5 sqrt(1 - (n / L)^2)) / I0(5), L = ceil(6 k). Sines by the recurrence
 * s(n + 1) = 2 cos(a) s(n) - s(n - 1), whose error grows with n^2: at n = 384 it is below 2^-40.
 */
static int32_t kaiser_q30(int64_t *exact_q30, int32_t k_q16)
{
    const int32_t half_length = (int32_t)(((int64_t)6 * k_q16 + 65535) >> 16);
    const real_t one = real_from_int(1, 0), angle = real_div(pi(), real_from_int(k_q16, -16));
    const real_t cos_a = cosine(angle), beta_square = real_from_int(25, 0);
    real_t per_square[SERIES_TERMS];
    for (int m = 1; m <= SERIES_TERMS; m++)
        per_square[m - 1] = real_div(one, real_from_int((int64_t)m * m, 0));
    const real_t over_i0 = real_div(one, bessel_i0(beta_square, per_square));
    real_t last = real_from_int(0, 0), sine = real_sqrt(real_sub(one, real_mul(cos_a, cos_a)));
    exact_q30[0] = real_to_fixed(real_div(one, real_from_int(k_q16, -16)), WEIGHT_BITS, INT64_MAX);
    for (int32_t n = 1; n <= half_length; n++) {
        const real_t part = real_div(real_from_int(n, 0), real_from_int(half_length, 0));
        const real_t argument = real_mul(beta_square, real_sub(one, real_mul(part, part)));
        const real_t window = real_mul(bessel_i0(argument, per_square), over_i0);
        const real_t sinc = real_div(sine, real_mul(pi(), real_from_int(n, 0)));
        exact_q30[n] = real_to_fixed(real_mul(sinc, window), WEIGHT_BITS, INT64_MAX);
        const real_t next = real_sub(real_scale(real_mul(cos_a, sine), 1), last);
        last = sine;
        sine = next;
    }
    return half_length;
}

/* 1 / sqrt(1 + x^8) in Q30; with r = min(x, 1/x) it is 1 / sqrt(1 + r^8), times r^4 where x > 1. 0 <= x <= 64, Q26. */
static int64_t butter_response_q30(int64_t x_q26)
{
    const int64_t one_q26 = 1 << 26;
    const bool inverted = x_q26 > one_q26;
    const uint64_t r_q32 = (uint64_t)(inverted ? (one_q26 << 32) / x_q26 : x_q26 << 6);
    uint64_t power_q32 = r_q32;
    uint64_t fourth_q32 = 0;
    for (int squaring = 0; squaring < 3; squaring++) {
        fourth_q32 = power_q32;
        power_q32 = (uint64_t)((uint128_t)power_q32 * power_q32 >> 32);
    }
    const uint64_t root_q31 = floor_sqrt(((1ull << 32) + power_q32) << 30);
    const uint64_t response_q32 = (1ull << 63) / root_q31;
    return round_shift((int64_t)(inverted ? (uint64_t)((uint128_t)response_q32 * fourth_q32 >> 32) : response_q32), 2);
}

/* h(n) = (|H(0)| + (-1)^n |H(1/2)| + 2 sum |H(f)| cos(2 pi f n)) / 2048. */
static int32_t butter_q30(int64_t *exact_q30, int32_t k_q16)
{
    enum { QUARTER = DFT_POINTS / 4, NYQUIST = DFT_POINTS / 2 };
    const int32_t radius = (int32_t)(((int64_t)8 * k_q16 + 65535) >> 16);
    int64_t cos_q30[NYQUIST + 1], response_q30[NYQUIST + 1];
    const real_t cos_a = cosine(real_scale(pi(), 1 - DFT_LOG2));
    real_t last = cos_a, here = real_from_int(1, 0); /* cos(-a) and cos(0) */
    for (int32_t j = 0; j <= NYQUIST; j++) {
        cos_q30[j] = real_to_fixed(here, WEIGHT_BITS, INT64_MAX);
        const real_t next = real_sub(real_scale(real_mul(cos_a, here), 1), last);
        last = here;
        here = next;
        response_q30[j] = butter_response_q30((int64_t)j * k_q16); /* 2 k j / 2048 */
    }
    for (int32_t n = 0; n <= radius; n++) {
        int64_t sum_q44 = (response_q30[0] + (n % 2 == 0 ? response_q30[NYQUIST] : -response_q30[NYQUIST])) << 14;
        for (int32_t m = 1; m < NYQUIST; m++) {
            const int32_t j = (int32_t)((int64_t)m * n % DFT_POINTS);
            sum_q44 += response_q30[m] * cos_q30[j <= NYQUIST ? j : DFT_POINTS - j] >> 15; /* twice, from Q60 */
        }
        exact_q30[n] = round_shift(sum_q44, 44 + DFT_LOG2 - WEIGHT_BITS);
    }
    return radius;
}

/* Weights of distance 0 to radius convolved with those that make B-spline coefficients. @return the new radius. */
static int32_t to_splines_q30(int64_t *exact_q30, int32_t radius)
{
    enum { TAIL = 8 };
    static const int64_t inverse_q30[TAIL + 1] = {1859775393, -498325315, 133525866, -35778148, 9586726,
                                                  -2568755,   688296,     -184428,   49417};
    int64_t before_q30[PREFILTER_MAX_RADIUS + 1];
    for (int32_t d = 0; d <= radius; d++)
        before_q30[d] = exact_q30[d];
    for (int32_t d = 0; d <= radius + TAIL; d++) {
        int64_t sum_q60 = 0; /* below 3 * 2^60 */
        for (int32_t n = -TAIL; n <= TAIL; n++) {
            const int32_t from = d - n < 0 ? n - d : d - n;
            if (from <= radius)
                sum_q60 += before_q30[from] * inverse_q30[n < 0 ? -n : n];
        }
        exact_q30[d] = round_shift(sum_q60, WEIGHT_BITS);
    }
    return radius + TAIL;
}

static int32_t low_pass_q30(int64_t *exact_q30, warp_filter_t filter, int32_t k_q16)
{
    switch (filter) {
    case WARP_FILTER_GAUSS:
        return gauss_q30(exact_q30, k_q16);
    case WARP_FILTER_KAISER:
        return kaiser_q30(exact_q30, k_q16);
    case WARP_FILTER_BUTTER:
        return butter_q30(exact_q30, k_q16);
    case WARP_FILTER_NONE:
        break;
    }
    exact_q30[0] = (int64_t)1 << WEIGHT_BITS;
    return 0;
}

void fir_design(fir_t *fir, warp_filter_t filter, int32_t k_q16, bool splines)
{
    int64_t exact_q30[PREFILTER_MAX_RADIUS + 1];
    fir->radius = low_pass_q30(exact_q30, filter, k_q16);
    if (splines)
        fir->radius = to_splines_q30(exact_q30, fir->radius);
    weights_to_sum(fir->weight, exact_q30, fir->radius, 1 << FILTER_SUM_LOG2);
}
