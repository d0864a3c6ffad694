// SPDX-License-Identifier: Apache-2.0
// Part of neon_x86.h: short vectors and their places in long ones, and what is loaded and stored.
#ifndef WARP_FIXED_NEON_X86_HALVES_H
#define WARP_FIXED_NEON_X86_HALVES_H

#include <immintrin.h>
#include <stdint.h>

/** @return A short vector, and above it anything: gcc would otherwise clear the upper half. */
static inline __m128i x86_wide(uint8x8_t half)
{
#ifdef __clang__
    return _mm_set_epi64x(0, (long long)half);
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

#undef vdup_n_u8
#undef vld1_dup_u8

static inline uint8x8_t vdup_n_u8(uint8_t a)
{
    return x86_low(_mm_set1_epi8((char)a));
}

static inline uint8x8_t vld1_dup_u8(const uint8_t *from)
{
    return vdup_n_u8(*from);
}

#undef vld1q_s16_x3
#undef vld1q_s16_x4

/* SIMDe copies number by number. */
static inline int16x8x3_t vld1q_s16_x3(const int16_t *from)
{
    return (int16x8x3_t){{vld1q_s16(from), vld1q_s16(from + 8), vld1q_s16(from + 16)}};
}

static inline int16x8x4_t vld1q_s16_x4(const int16_t *from)
{
    return (int16x8x4_t){{vld1q_s16(from), vld1q_s16(from + 8), vld1q_s16(from + 16), vld1q_s16(from + 24)}};
}

#undef vst1_u8
#undef vst1q_u32

/* What is stored here is read number by number: see store_numbers() in neon.h. */
static inline void vst1_u8(uint8_t *to, uint8x8_t a)
{
    _mm_storel_epi64((__m128i *)(void *)to, x86_wide(a));
    __asm__("" : "+m"(*(uint8_t(*)[8])to));
}

static inline void vst1q_u32(uint32_t *to, uint32x4_t a)
{
    _mm_storeu_si128((__m128i *)(void *)to, (__m128i)a);
    __asm__("" : "+m"(*(uint32_t(*)[4])to));
}

#endif
