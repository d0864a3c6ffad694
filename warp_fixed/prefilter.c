// SPDX-License-Identifier: Apache-2.0
// The low-pass filter before resampling: separable, its cut-off 1 / (2 k) from the step k.
#include "warp_fixed/prefilter.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/real.h"

enum { EXPONENT_BITS = 24, WEIGHT_BITS = 30 };

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

/* Weights in proportion to exact_q30, of distance 0 to radius, whose sum over both sides is exact. */
static void weights_to_sum(int16_t *weight, const int64_t *exact_q30, int32_t radius, int32_t sum)
{
    int64_t total = exact_q30[0];
    for (int32_t d = 1; d <= radius; d++)
        total += 2 * exact_q30[d];
    int32_t rest = sum;
    for (int32_t d = 1; d <= radius; d++) {
        weight[d] = (int16_t)((exact_q30[d] * sum + total / 2) / total);
        rest -= 2 * weight[d];
    }
    weight[0] = (int16_t)rest;
}

void prefilter_gauss(fir_t *fir, int32_t k_q16)
{
    /* 4 sqrt(ln 2) / pi in Q32, and pi^2 / (2 ln(2)^2) in Q32. */
    const int64_t cut_per_k_q32 = 4552843378, c_q32 = 44114228550;
    const int32_t radius = (int32_t)(cut_per_k_q32 * k_q16 >> 48);

    real_t root[EXPONENT_BITS]; /* 2^-(1/2), 2^-(1/4), ... */
    real_t next = real_from_int(1, -1);
    for (int b = 0; b < EXPONENT_BITS; b++)
        root[b] = next = real_sqrt(next);

    const real_t k = real_from_int(k_q16, -16);
    const real_t c_over_k2 = real_div(real_from_int(c_q32, -32), real_mul(k, k));
    int64_t exact_q30[PREFILTER_MAX_RADIUS + 1];
    for (int32_t d = 0; d <= radius; d++) {
        const real_t exponent = real_mul(c_over_k2, real_from_int((int64_t)d * d, 0));
        exact_q30[d] = power_of_half_q30(real_to_fixed(exponent, EXPONENT_BITS, INT64_MAX), root);
    }
    fir->radius = radius;
    fir->first_shift = radius > PREFILTER_SHORT_RADIUS ? LONG_FIRST_SHIFT : 0;
    weights_to_sum(fir->first, exact_q30, radius, FIRST_SUM << fir->first_shift);
    weights_to_sum(fir->second, exact_q30, radius, SECOND_SUM);
}

void prefilter_init(prefilter_t *prefilter)
{
    prefilter->k_q16 = 0;
}

/* First pass of row y into the middle of sums, then its ends mirrored. */
static int16_t *sums_of_row(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int32_t y)
{
    const fir_t *fir = &prefilter->fir;
    const int32_t channels = (int32_t)picture->format, width = picture->width;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + 1];
    for (int32_t d = -fir->radius; d <= fir->radius; d++)
        rows[d + fir->radius] = image_row(picture, mirror_index(y + d, picture->height));
    int16_t *middle = prefilter->sums + PREFILTER_MAX_RADIUS * channels;
    kernels->prefilter_columns(middle, rows, fir, width * channels);
    for (int32_t d = 1; d <= fir->radius; d++) {
        for (int32_t channel = 0; channel < channels; channel++) {
            middle[-d * channels + channel] = middle[mirror_index(-d, width) * channels + channel];
            middle[(width - 1 + d) * channels + channel] =
                middle[mirror_index(width - 1 + d, width) * channels + channel];
        }
    }
    return middle;
}

image_t prefilter_picture(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int32_t k_q16)
{
    if (k_q16 <= 1 << 16)
        return *picture;
    const int32_t k = k_q16 < PREFILTER_MAX_K_Q16 ? k_q16 : PREFILTER_MAX_K_Q16;
    if (k != prefilter->k_q16) {
        prefilter_gauss(&prefilter->fir, k);
        prefilter->k_q16 = k;
    }
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const image_t filtered = {prefilter->pixels, picture->width, picture->height, count, picture->format};
    for (int32_t y = 0; y < picture->height; y++) {
        const int16_t *sums = sums_of_row(prefilter, kernels, picture, y);
        kernels->prefilter_row(image_row(&filtered, y), sums, &prefilter->fir, count, channels);
    }
    return filtered;
}
