// SPDX-License-Identifier: Apache-2.0
// Part of neon_x86.h: products, and numbers of twice as many bits.
#ifndef WARP_FIXED_NEON_X86_PRODUCTS_H
#define WARP_FIXED_NEON_X86_PRODUCTS_H

#include "warp_fixed/neon_x86_halves.h"

/* Bytes as the upper halves of 16 bits: products of two such, shifted right by 16, are those of the bytes. */
static inline __m128i x86_bytes_above(uint8x8_t a)
{
    return _mm_unpacklo_epi8(_mm_setzero_si128(), x86_wide(a));
}

static inline __m128i x86_bytes(uint8x8_t a)
{
    return _mm_unpacklo_epi8(x86_wide(a), _mm_setzero_si128());
}

static inline __m128i x86_high_bytes(uint8x16_t a)
{
    return _mm_unpackhi_epi8((__m128i)a, _mm_setzero_si128());
}

#undef vmovl_u8
#undef vmovl_high_u8
#undef vaddl_u8
#undef vaddl_high_u8
#undef vmull_u8
#undef vmull_s8
#undef vmlal_u8
#undef vmlsl_u8
#undef vmlal_s8
#undef vmull_high_u8
#undef vmlal_high_u8

static inline uint16x8_t vmovl_u8(uint8x8_t a)
{
    return (uint16x8_t)x86_bytes(a);
}

static inline uint16x8_t vmovl_high_u8(uint8x16_t a)
{
    return (uint16x8_t)x86_high_bytes(a);
}

static inline uint16x8_t vaddl_u8(uint8x8_t a, uint8x8_t b)
{
    return vmovl_u8(a) + vmovl_u8(b);
}

static inline uint16x8_t vaddl_high_u8(uint8x16_t a, uint8x16_t b)
{
    return vmovl_high_u8(a) + vmovl_high_u8(b);
}

static inline uint16x8_t vmull_u8(uint8x8_t a, uint8x8_t b)
{
    return (uint16x8_t)_mm_mullo_epi16(x86_bytes(a), x86_bytes(b));
}

static inline int16x8_t vmull_s8(int8x8_t a, int8x8_t b)
{
    return (int16x8_t)_mm_mulhi_epi16(x86_bytes_above((uint8x8_t)a), x86_bytes_above((uint8x8_t)b));
}

static inline uint16x8_t vmlal_u8(uint16x8_t sums, uint8x8_t a, uint8x8_t b)
{
    return sums + vmull_u8(a, b);
}

static inline uint16x8_t vmlsl_u8(uint16x8_t sums, uint8x8_t a, uint8x8_t b)
{
    return sums - vmull_u8(a, b);
}

static inline int16x8_t vmlal_s8(int16x8_t sums, int8x8_t a, int8x8_t b)
{
    return (int16x8_t)_mm_add_epi16((__m128i)sums, (__m128i)vmull_s8(a, b));
}

static inline uint16x8_t vmull_high_u8(uint8x16_t a, uint8x16_t b)
{
    return (uint16x8_t)_mm_mullo_epi16(x86_high_bytes(a), x86_high_bytes(b));
}

static inline uint16x8_t vmlal_high_u8(uint16x8_t sums, uint8x16_t a, uint8x16_t b)
{
    return sums + vmull_high_u8(a, b);
}

/* Numbers of 16 bits, and zeros in turn: what pmaddwd makes of two such are their products. */
static inline __m128i x86_numbers(int16x4_t a)
{
    return _mm_unpacklo_epi16(x86_wide((uint8x8_t)a), _mm_setzero_si128());
}

static inline __m128i x86_high_numbers(int16x8_t a)
{
    return _mm_unpackhi_epi16((__m128i)a, _mm_setzero_si128());
}

static inline int32x4_t x86_sum(int32x4_t a, int32x4_t b)
{
    return (int32x4_t)_mm_add_epi32((__m128i)a, (__m128i)b);
}

#undef vmull_s16
#undef vmull_u16
#undef vmlal_s16
#undef vmlal_u16
#undef vmull_lane_s16
#undef vmull_lane_u16
#undef vmlal_lane_s16
#undef vmlal_lane_u16
#undef vmull_n_s16
#undef vmlal_n_s16
#undef vmull_high_s16
#undef vmlal_high_s16
#undef vmlal_high_u16
#undef vmlal_high_n_s16

static inline int32x4_t vmull_s16(int16x4_t a, int16x4_t b)
{
    return (int32x4_t)_mm_madd_epi16(x86_numbers(a), x86_numbers(b));
}

static inline uint32x4_t vmull_u16(uint16x4_t a, uint16x4_t b)
{
    const __m128i x = x86_wide((uint8x8_t)a), y = x86_wide((uint8x8_t)b);
    return (uint32x4_t)_mm_unpacklo_epi16(_mm_mullo_epi16(x, y), _mm_mulhi_epu16(x, y));
}

static inline int32x4_t vmlal_s16(int32x4_t sums, int16x4_t a, int16x4_t b)
{
    return x86_sum(sums, vmull_s16(a, b));
}

static inline uint32x4_t vmlal_u16(uint32x4_t sums, uint16x4_t a, uint16x4_t b)
{
    return sums + vmull_u16(a, b);
}

static inline int32x4_t vmull_lane_s16(int16x4_t a, int16x4_t b, int lane)
{
    return vmull_s16(a, (int16x4_t){b[lane], b[lane], b[lane], b[lane]});
}

static inline uint32x4_t vmull_lane_u16(uint16x4_t a, uint16x4_t b, int lane)
{
    return vmull_u16(a, (uint16x4_t){b[lane], b[lane], b[lane], b[lane]});
}

static inline int32x4_t vmlal_lane_s16(int32x4_t sums, int16x4_t a, int16x4_t b, int lane)
{
    return x86_sum(sums, vmull_lane_s16(a, b, lane));
}

static inline uint32x4_t vmlal_lane_u16(uint32x4_t sums, uint16x4_t a, uint16x4_t b, int lane)
{
    return sums + vmull_lane_u16(a, b, lane);
}

static inline int32x4_t vmull_n_s16(int16x4_t a, int16_t b)
{
    return (int32x4_t)_mm_madd_epi16(x86_numbers(a), _mm_set1_epi32((uint16_t)b));
}

static inline int32x4_t vmlal_n_s16(int32x4_t sums, int16x4_t a, int16_t b)
{
    return x86_sum(sums, vmull_n_s16(a, b));
}

static inline int32x4_t vmull_high_s16(int16x8_t a, int16x8_t b)
{
    return (int32x4_t)_mm_madd_epi16(x86_high_numbers(a), x86_high_numbers(b));
}

static inline int32x4_t vmlal_high_s16(int32x4_t sums, int16x8_t a, int16x8_t b)
{
    return x86_sum(sums, vmull_high_s16(a, b));
}

static inline uint32x4_t vmlal_high_u16(uint32x4_t sums, uint16x8_t a, uint16x8_t b)
{
    const __m128i x = (__m128i)a, y = (__m128i)b;
    return sums + (uint32x4_t)_mm_unpackhi_epi16(_mm_mullo_epi16(x, y), _mm_mulhi_epu16(x, y));
}

static inline int32x4_t vmlal_high_n_s16(int32x4_t sums, int16x8_t a, int16_t b)
{
    const __m128i products = _mm_madd_epi16(x86_high_numbers(a), _mm_set1_epi32((uint16_t)b));
    return x86_sum(sums, (int32x4_t)products);
}

/* See two_weighed() in neon.h. */
static inline uint32x4_t x86_two_weighed(uint16x8_t v, uint16x8_t weights, int pair)
{
    const __m128i a_b = (__m128i)v, in_turn = _mm_unpacklo_epi16(a_b, _mm_unpackhi_epi64(a_b, a_b));
    const __m128i w = (__m128i)weights;
    switch (pair) {
    case 0:
        return (uint32x4_t)_mm_madd_epi16(in_turn, _mm_shuffle_epi32(w, _MM_SHUFFLE(0, 0, 0, 0)));
    case 1:
        return (uint32x4_t)_mm_madd_epi16(in_turn, _mm_shuffle_epi32(w, _MM_SHUFFLE(1, 1, 1, 1)));
    case 2:
        return (uint32x4_t)_mm_madd_epi16(in_turn, _mm_shuffle_epi32(w, _MM_SHUFFLE(2, 2, 2, 2)));
    default:
        return (uint32x4_t)_mm_madd_epi16(in_turn, _mm_shuffle_epi32(w, _MM_SHUFFLE(3, 3, 3, 3)));
    }
}

#ifdef __AVX2__
/* Eight values and zeros in turn: see x86_numbers(). */
static inline __m256i x86_eight_numbers(int16x8_t a)
{
    return _mm256_cvtepu16_epi32((__m128i)a);
}

static inline __m256i x86_eight_products(int16x8_t a, int16_t b)
{
    return _mm256_madd_epi16(x86_eight_numbers(a), _mm256_set1_epi32((uint16_t)b));
}

static inline __m256i x86_add_eight_products(__m256i sums, int16x8_t a, int16_t b)
{
#if defined(__AVX512VNNI__) && defined(__AVX512VL__)
    return _mm256_dpwssd_epi32(sums, x86_eight_numbers(a), _mm256_set1_epi32((uint16_t)b));
#else
    return _mm256_add_epi32(sums, x86_eight_products(a, b));
#endif
}
#endif

#ifdef __SSE4_1__
#undef vmull_s32

static inline int64x2_t vmull_s32(int32x2_t a, int32x2_t b)
{
    const __m128i x = x86_wide((uint8x8_t)a), y = x86_wide((uint8x8_t)b);
    return (int64x2_t)_mm_mul_epi32(_mm_unpacklo_epi32(x, x), _mm_unpacklo_epi32(y, y));
}
#endif

#endif
