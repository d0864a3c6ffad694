// SPDX-License-Identifier: Apache-2.0
// Part of neon_x86.h: numbers of half as many bits.
#ifndef WARP_FIXED_NEON_X86_NARROW_H
#define WARP_FIXED_NEON_X86_NARROW_H

#include "warp_fixed/neon_x86_products.h"

/* Bits n to n + 15 of each number: at the top, and down again with the sign, so that packing changes nothing. */
static inline uint8x8_t x86_sixteen_bits(__m128i a, int n)
{
    const __m128i bits = _mm_srai_epi32(_mm_slli_epi32(a, 16 - n), 16);
    return x86_low(_mm_packs_epi32(bits, bits));
}

#undef vshrn_n_s32
#undef vshrn_n_u32
#undef vrshrn_n_s32
#undef vmovn_s32
#undef vaddhn_s32
#undef vaddhn_u32
#undef vsubhn_s32
#undef vqshrun_n_s16
#undef vqrshrun_n_s16
#undef vshrn_n_u16
#undef vmovn_u16

static inline int16x4_t vshrn_n_s32(int32x4_t a, int n)
{
    return (int16x4_t)x86_sixteen_bits((__m128i)a, n);
}

static inline uint16x4_t vshrn_n_u32(uint32x4_t a, int n)
{
    return (uint16x4_t)x86_sixteen_bits((__m128i)a, n);
}

static inline int16x4_t vrshrn_n_s32(int32x4_t a, int n)
{
    return (int16x4_t)x86_sixteen_bits(_mm_add_epi32((__m128i)a, _mm_set1_epi32(1 << (n - 1))), n);
}

static inline int16x4_t vmovn_s32(int32x4_t a)
{
    return (int16x4_t)x86_sixteen_bits((__m128i)a, 0);
}

static inline int16x4_t vaddhn_s32(int32x4_t a, int32x4_t b)
{
    return vshrn_n_s32(x86_sum(a, b), 16);
}

static inline uint16x4_t vaddhn_u32(uint32x4_t a, uint32x4_t b)
{
    return vshrn_n_u32(a + b, 16);
}

static inline int16x4_t vsubhn_s32(int32x4_t a, int32x4_t b)
{
    return (int16x4_t)x86_sixteen_bits(_mm_sub_epi32((__m128i)a, (__m128i)b), 16);
}

static inline uint8x8_t x86_saturated(__m128i a)
{
    return x86_low(_mm_packus_epi16(a, a));
}

static inline uint8x8_t vqshrun_n_s16(int16x8_t a, int n)
{
    return x86_saturated(_mm_srai_epi16((__m128i)a, n));
}

/* The last bit is shifted out after rounding: so nothing overflows. */
static inline uint8x8_t vqrshrun_n_s16(int16x8_t a, int n)
{
    const __m128i twice = _mm_srai_epi16((__m128i)a, n - 1);
    return x86_saturated(_mm_srai_epi16(_mm_sub_epi16(twice, _mm_set1_epi16(-1)), 1));
}

static inline uint8x8_t vshrn_n_u16(uint16x8_t a, int n)
{
    return x86_saturated(_mm_and_si128(_mm_srli_epi16((__m128i)a, n), _mm_set1_epi16(UINT8_MAX)));
}

static inline uint8x8_t vmovn_u16(uint16x8_t a)
{
    return vshrn_n_u16(a, 0);
}

/* The lower halves of two numbers of 64 bits. */
static inline int32x2_t x86_lower_halves(__m128i a)
{
    return (int32x2_t)x86_low(_mm_shuffle_epi32(a, _MM_SHUFFLE(2, 0, 2, 0)));
}

#undef vmul_s32
#undef vshrn_n_s64
#undef vrshrn_n_s64

/* The lower half of a product is the same with and without signs. */
static inline int32x2_t vmul_s32(int32x2_t a, int32x2_t b)
{
    const __m128i x = x86_wide((uint8x8_t)a), y = x86_wide((uint8x8_t)b);
    return x86_lower_halves(_mm_mul_epu32(_mm_unpacklo_epi32(x, x), _mm_unpacklo_epi32(y, y)));
}

/* n <= 32: which bits come in from above does not matter. */
static inline int32x2_t vshrn_n_s64(int64x2_t a, int n)
{
    return x86_lower_halves(_mm_srli_epi64((__m128i)a, n));
}

static inline int32x2_t vrshrn_n_s64(int64x2_t a, int n)
{
    return x86_lower_halves(_mm_srli_epi64(_mm_add_epi64((__m128i)a, _mm_set1_epi64x(1LL << (n - 1))), n));
}

#ifdef __AVX2__
/* See x86_sixteen_bits(). */
static inline int16x8_t x86_eight_shifted(__m256i a, int n)
{
#ifdef __AVX512VL__
    return (int16x8_t)_mm256_cvtepi32_epi16(_mm256_srli_epi32(a, n));
#else
    const __m256i bits = _mm256_srai_epi32(_mm256_slli_epi32(a, 16 - n), 16);
    return (int16x8_t)_mm_packs_epi32(_mm256_castsi256_si128(bits), _mm256_extracti128_si256(bits, 1));
#endif
}
#endif

#endif
