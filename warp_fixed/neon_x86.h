// SPDX-License-Identifier: Apache-2.0
// NEON intrinsics for which SIMDe 0.7.4 and gcc 12 make long code on x86, in SSE2: to be included by neon.h alone.
//
// gcc widens eight bytes in two halves, and moves vectors of 64 bits through memory or other registers to make 128 of
// them. What each function returns is what Arm's manual says, for all values.
#ifndef WARP_FIXED_NEON_X86_H
#define WARP_FIXED_NEON_X86_H

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

/** @return A short vector, and above it anything: gcc would otherwise clear the upper half. */
static inline __m128i x86_wide(uint8x8_t half)
{
#ifdef __clang__
    return _mm_set_epi64x(0, (int64_t)half);
#else
    __m128i wide;
    __asm__("" : "=x"(wide) : "0"(half));
    return wide;
#endif
}

static inline uint8x8_t x86_low(__m128i wide)
{
#ifdef __clang__
    return (uint8x8_t)_mm_cvtsi128_si64(wide);
#else
    uint8x8_t low;
    __asm__("" : "=x"(low) : "0"(wide));
    return low;
#endif
}

static inline uint8x8_t x86_high(__m128i wide)
{
    return x86_low(_mm_unpackhi_epi64(wide, wide));
}

static inline __m128i x86_combined(uint8x8_t low, uint8x8_t high)
{
    return _mm_unpacklo_epi64(x86_wide(low), x86_wide(high));
}

#undef vget_low_u8
#undef vget_low_s16
#undef vget_low_u16
#undef vget_low_s32
#undef vget_high_u8
#undef vget_high_s16
#undef vget_high_u16
#undef vget_high_s32
#undef vcombine_u8
#undef vcombine_s16
#undef vcombine_u16
#undef vcombine_s32
#undef vcombine_s64
#undef vld1_u8

static inline uint8x8_t vget_low_u8(uint8x16_t a)
{
    return x86_low((__m128i)a);
}

static inline int16x4_t vget_low_s16(int16x8_t a)
{
    return (int16x4_t)x86_low((__m128i)a);
}

static inline uint16x4_t vget_low_u16(uint16x8_t a)
{
    return (uint16x4_t)x86_low((__m128i)a);
}

static inline int32x2_t vget_low_s32(int32x4_t a)
{
    return (int32x2_t)x86_low((__m128i)a);
}

static inline uint8x8_t vget_high_u8(uint8x16_t a)
{
    return x86_high((__m128i)a);
}

static inline int16x4_t vget_high_s16(int16x8_t a)
{
    return (int16x4_t)x86_high((__m128i)a);
}

static inline uint16x4_t vget_high_u16(uint16x8_t a)
{
    return (uint16x4_t)x86_high((__m128i)a);
}

static inline int32x2_t vget_high_s32(int32x4_t a)
{
    return (int32x2_t)x86_high((__m128i)a);
}

static inline uint8x16_t vcombine_u8(uint8x8_t low, uint8x8_t high)
{
    return (uint8x16_t)x86_combined(low, high);
}

static inline int16x8_t vcombine_s16(int16x4_t low, int16x4_t high)
{
    return (int16x8_t)x86_combined((uint8x8_t)low, (uint8x8_t)high);
}

static inline uint16x8_t vcombine_u16(uint16x4_t low, uint16x4_t high)
{
    return (uint16x8_t)x86_combined((uint8x8_t)low, (uint8x8_t)high);
}

static inline int32x4_t vcombine_s32(int32x2_t low, int32x2_t high)
{
    return (int32x4_t)x86_combined((uint8x8_t)low, (uint8x8_t)high);
}

static inline int64x2_t vcombine_s64(int64x1_t low, int64x1_t high)
{
    return (int64x2_t)x86_combined((uint8x8_t)low, (uint8x8_t)high);
}

static inline uint8x8_t vld1_u8(const uint8_t *from)
{
    return x86_low(_mm_loadl_epi64((const __m128i *)(const void *)from));
}

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

#undef vshrn_n_s64
#undef vrshrn_n_s64

/* n <= 32: which bits come in from above does not matter. */
static inline int32x2_t vshrn_n_s64(int64x2_t a, int n)
{
    return x86_lower_halves(_mm_srli_epi64((__m128i)a, n));
}

static inline int32x2_t vrshrn_n_s64(int64x2_t a, int n)
{
    return x86_lower_halves(_mm_srli_epi64(_mm_add_epi64((__m128i)a, _mm_set1_epi64x((long long)1 << (n - 1))), n));
}

#ifdef __SSE4_1__
#undef vmul_s32
#undef vmull_s32

static inline int32x2_t vmul_s32(int32x2_t a, int32x2_t b)
{
    return (int32x2_t)x86_low(_mm_mullo_epi32(x86_wide((uint8x8_t)a), x86_wide((uint8x8_t)b)));
}

static inline int64x2_t vmull_s32(int32x2_t a, int32x2_t b)
{
    const __m128i x = x86_wide((uint8x8_t)a), y = x86_wide((uint8x8_t)b);
    return (int64x2_t)_mm_mul_epi32(_mm_unpacklo_epi32(x, x), _mm_unpacklo_epi32(y, y));
}
#endif

#endif
