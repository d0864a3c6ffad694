// SPDX-License-Identifier: Apache-2.0
// Short windows of XRGB texels without negative weights in AVX2, two pixels at once, one to each half of a vector: to
// be included by resample_window_xrgb_neon.c alone.
//
// pmaddubsw weighs pairs of rows: bytes without sign, which the weights are, by signed ones, which texels are less 128.
// So sums of the first pass are less 128 * FIRST_SUM_POSITIVE, and fit signed 16 bits; pmaddwd weighs pairs of columns.
#ifndef WARP_FIXED_RESAMPLE_WINDOW_AVX2_H
#define WARP_FIXED_RESAMPLE_WINDOW_AVX2_H

#include <immintrin.h>

#include "warp_fixed/window_texels_neon.h"

enum {
    /** What the first pass leaves out, times the second's sum; and for rounding. */
    START_LESS_128 = 128 * FIRST_SUM_POSITIVE * SECOND_SUM_POSITIVE + ROUNDING
};

static inline __m256i load_16_of_two(const uint8_t *a, const uint8_t *b)
{
    return _mm256_set_m128i(_mm_loadu_si128((const __m128i *)(const void *)b),
                            _mm_loadu_si128((const __m128i *)(const void *)a));
}

static inline __m256i load_8_of_two(const uint8_t *a, const uint8_t *b)
{
    return _mm256_set_m128i(_mm_loadl_epi64((const __m128i *)(const void *)b),
                            _mm_loadl_epi64((const __m128i *)(const void *)a));
}

/* Up to four texels less 128, of which `columns` count. */
NEON_INLINE __m256i load_texels(const uint8_t *a, const uint8_t *b, int32_t columns)
{
    const __m256i texels = columns > 2 ? load_16_of_two(a, b) : load_8_of_two(a, b);
    return _mm256_xor_si256(texels, _mm256_set1_epi8(INT8_MIN));
}

/* Numbers a and b of 16 bits in turn, all over each half. */
NEON_INLINE __m256i numbers_in_turn(__m256i numbers, int a, int b)
{
    const int bytes = 2 * a | (2 * a + 1) << 8 | 2 * b << 16 | (2 * b + 1) << 24;
    return _mm256_shuffle_epi8(numbers, _mm256_set1_epi32(bytes));
}

/*
 * Sums of up to four columns, two to a vector. The last of an odd number of rows comes twice, and counts once: the
 * weight after its own is 0.
 */
NEON_INLINE void weigh_columns(__m256i v[2], const one_window_t *a, const one_window_t *b, ptrdiff_t stride,
                               int32_t columns, int32_t ny)
{
    const __m256i weights = load_8_of_two(a->first, b->first);
    for (int32_t t = 0; t < ny; t += 2) {
        const ptrdiff_t row = t * stride, next = t + 1 < ny ? row + stride : row;
        const __m256i weight = _mm256_shuffle_epi8(weights, _mm256_set1_epi16((int16_t)(t | (t + 1) << 8)));
        const __m256i above = load_texels(a->texels + row, b->texels + row, columns);
        const __m256i below = load_texels(a->texels + next, b->texels + next, columns);
        const __m256i left = _mm256_maddubs_epi16(weight, _mm256_unpacklo_epi8(above, below));
        const __m256i right = _mm256_maddubs_epi16(weight, _mm256_unpackhi_epi8(above, below));
        v[0] = t == 0 ? left : _mm256_add_epi16(v[0], left);
        v[1] = t == 0 ? right : _mm256_add_epi16(v[1], right);
    }
}

/* Grey levels of two pixels, 32 bits each. */
NEON_INLINE __m256i two_positive_xrgb(one_window_t a, one_window_t b, ptrdiff_t stride, int32_t nx, int32_t ny)
{
    const __m256i weights = load_16_of_two(a.second, b.second);
    __m256i sums = _mm256_set1_epi32(START_LESS_128);
    for (int32_t u = 0; u < nx; u += 4, a.texels += 16, b.texels += 16) {
        __m256i v[2];
        weigh_columns(v, &a, &b, stride, nx - u, ny);
        if (nx - u > 2) {
            const __m256i even = _mm256_unpacklo_epi16(v[0], v[1]), odd = _mm256_unpackhi_epi16(v[0], v[1]);
            sums = _mm256_add_epi32(sums, _mm256_madd_epi16(even, numbers_in_turn(weights, u, u + 2)));
            sums = _mm256_add_epi32(sums, _mm256_madd_epi16(odd, numbers_in_turn(weights, u + 1, u + 3)));
        } else {
            const __m256i in_turn = _mm256_unpacklo_epi16(v[0], _mm256_unpackhi_epi64(v[0], v[0]));
            sums = _mm256_add_epi32(sums, _mm256_madd_epi16(in_turn, numbers_in_turn(weights, u, u + 1)));
        }
    }
    return _mm256_srli_epi32(sums, SUM_SHIFT);
}

/* Four pixels. */
NEON_INLINE uint8x16_t four_positive_xrgb(const one_window_t *origin, const window_step_t *step, ptrdiff_t stride,
                                          int32_t nx, int32_t ny)
{
    const __m256i a_c = two_positive_xrgb(nth_window(origin, step, 0), nth_window(origin, step, 2), stride, nx, ny);
    const __m256i b_d = two_positive_xrgb(nth_window(origin, step, 1), nth_window(origin, step, 3), stride, nx, ny);
    const __m256i levels = _mm256_packs_epi32(a_c, b_d);
    return (uint8x16_t)_mm_packus_epi16(_mm256_castsi256_si128(levels), _mm256_extracti128_si256(levels, 1));
}

#endif
