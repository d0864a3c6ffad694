// SPDX-License-Identifier: Apache-2.0
// Linear interpolation of XRGB in AVX2, eight pixels at once: to be included by resample_linear_neon.c alone.
//
// A pixel's 2 x 2 texels are 16 bytes. pmaddubsw weighs pairs of bytes, which have no sign, by signed ones. A weight of
// the first pass may be 128, which is no signed byte; its negative is: so these weights are negated, and with them the
// sums of both passes.
#ifndef WARP_FIXED_RESAMPLE_LINEAR_AVX2_H
#define WARP_FIXED_RESAMPLE_LINEAR_AVX2_H

#include <immintrin.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_ahead.h"

/* 32 bits for each of eight pixels: the two bytes of the first pass, twice, and the two numbers of the second. */
typedef struct {
    __m256i first, second;
} linear_weights_t;

/* Of phase p: bytes -(128 - p) and -p as one number are 128 - 255 p; 32767 - w and w as one are 32767 + 65535 w. */
static inline linear_weights_t linear_weights(__m256i x_q18, __m256i y_q18)
{
    const __m256i mask = _mm256_set1_epi32(PHASES - 1);
    const __m256i p_x = _mm256_and_si256(_mm256_srli_epi32(x_q18, GRID_FRACTION_BITS - PHASE_BITS), mask);
    const __m256i p_y = _mm256_and_si256(_mm256_srli_epi32(y_q18, GRID_FRACTION_BITS - PHASE_BITS), mask);
    const __m256i twice = _mm256_or_si256(p_y, _mm256_slli_epi32(p_y, 16));
    const __m256i w = _mm256_sub_epi32(_mm256_slli_epi32(p_x, 8), _mm256_srli_epi32(p_x, 6));
    return (linear_weights_t){
        .first = _mm256_sub_epi16(_mm256_set1_epi16(128), _mm256_mullo_epi16(twice, _mm256_set1_epi16(255))),
        .second = _mm256_add_epi32(_mm256_sub_epi32(_mm256_slli_epi32(w, 16), w), _mm256_set1_epi32(SECOND_SUM)),
    };
}

/* Two texels, four times over: then a blend puts them where they belong, and nothing is shuffled. */
static inline __m256i load_pair(const uint8_t *texels)
{
    return _mm256_broadcastq_epi64(_mm_loadl_epi64((const __m128i *)(const void *)texels));
}

/* Texels of the pixels at a and b, a half each. */
static inline __m256i load_squares(const uint8_t *above, const uint8_t *below, size_t a, size_t b)
{
    const __m256i left = _mm256_blend_epi32(load_pair(above + a), load_pair(below + a), 0x0c);
    const __m256i right = _mm256_blend_epi32(load_pair(above + b), load_pair(below + b), 0xc0);
    return _mm256_blend_epi32(left, right, 0xf0);
}

/* Grey levels of two pixels, 32 bits each. Weights of a pixel fill its half. */
static inline __m256i weigh_squares(__m256i texels, __m256i first, __m256i second)
{
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15));
    const __m256i v = _mm256_maddubs_epi16(_mm256_shuffle_epi8(texels, order), first);
    const __m256i rounding = _mm256_set1_epi32(1 << (SUM_SHIFT - 1));
    return _mm256_srli_epi32(_mm256_sub_epi32(rounding, _mm256_madd_epi16(v, second)), SUM_SHIFT);
}

static inline __m256i load_points(const int32_t *point_q18, int32_t start_q18)
{
    return _mm256_add_epi32(_mm256_loadu_si256((const __m256i *)(const void *)point_q18), _mm256_set1_epi32(start_q18));
}

/* Pixels k and k + 4 come together, since shuffles stay in a half. */
static inline void eight_xrgb(uint8_t *out, const window_source_t *from, const int32_t *x_q18, const int32_t *y_q18,
                              ptrdiff_t ahead)
{
    const __m256i x = load_points(x_q18, from->x_start_q18), y = load_points(y_q18, from->y_start_q18);
    const __m256i row = _mm256_mullo_epi32(_mm256_srai_epi32(y, GRID_FRACTION_BITS), _mm256_set1_epi32(from->stride));
    const __m256i texel = _mm256_add_epi32(_mm256_slli_epi32(_mm256_srai_epi32(x, GRID_FRACTION_BITS), 2), row);
    uint32_t at[8];
    store_numbers(at, (uint32x4_t)_mm256_castsi256_si128(texel));
    store_numbers(at + 4, (uint32x4_t)_mm256_extracti128_si256(texel, 1));
    prefetch_rows(from->data, ahead + (ptrdiff_t)at[0], from->stride, 2);
    prefetch_rows(from->data, ahead + (ptrdiff_t)at[4], from->stride, 2);

    const uint8_t *above = from->data, *below = from->data + from->stride;
    const linear_weights_t w = linear_weights(x, y);
    const __m256i a = weigh_squares(load_squares(above, below, at[0], at[4]), _mm256_shuffle_epi32(w.first, 0x00),
                                    _mm256_shuffle_epi32(w.second, 0x00));
    const __m256i b = weigh_squares(load_squares(above, below, at[1], at[5]), _mm256_shuffle_epi32(w.first, 0x55),
                                    _mm256_shuffle_epi32(w.second, 0x55));
    const __m256i c = weigh_squares(load_squares(above, below, at[2], at[6]), _mm256_shuffle_epi32(w.first, 0xaa),
                                    _mm256_shuffle_epi32(w.second, 0xaa));
    const __m256i d = weigh_squares(load_squares(above, below, at[3], at[7]), _mm256_shuffle_epi32(w.first, 0xff),
                                    _mm256_shuffle_epi32(w.second, 0xff));
    const __m256i pixels = _mm256_packus_epi16(_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d));
    _mm256_storeu_si256((__m256i *)(void *)out, pixels);
}

#endif
