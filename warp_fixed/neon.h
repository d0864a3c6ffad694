// SPDX-License-Identifier: Apache-2.0
// NEON intrinsics: the CPU's own on AArch64, SIMDe's portable ones elsewhere, so that one source runs everywhere.
//
// Debian 12's SIMDe is 0.7.4, which lacks some intrinsics of AArch64: what is used must be in it. Integers only.
#ifndef WARP_FIXED_NEON_H
#define WARP_FIXED_NEON_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __aarch64__
#include <arm_neon.h>
#else
#define SIMDE_ENABLE_NATIVE_ALIASES
#ifdef __clang__
#define SIMDE_X86_MMX_NO_NATIVE /* what clang makes with MMX leaves the x87 unable to do long doubles */
#endif
#ifdef __SSE2__
#include <immintrin.h> /* before SIMDe, whose 0.8.2 makes macros of names in it */
#endif
#include <simde/arm/neon.h>
#ifdef __SSE2__
#include "warp_fixed/neon_x86.h"
#endif
#endif

/**
 * For what is made anew for each constant that it is called with. Builds that are not optimised, or sanitized, do
 * without: compiling SIMDe's functions so many times would take them minutes.
 */
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define NEON_INLINE static inline __attribute__((always_inline))
#else
#define NEON_INLINE static inline
#endif

/**
 * Store what is to be read number by number.
 *
 * gcc would move every lane to its register by itself, some by way of another vector, instead of loading two at once:
 * it must not know what is in memory.
 */
static inline void store_numbers(uint32_t to[4], uint32x4_t numbers)
{
    vst1q_u32(to, numbers);
    __asm__("" : "+m"(*(uint32_t(*)[4])to));
}

/** @return A stored number as an offset; gcc would extend it anew in every address, which costs a cycle each. */
static inline size_t stored_offset(const uint32_t *number)
{
    size_t offset = *number;
    __asm__("" : "+r"(offset));
    return offset;
}

/** The same of eight numbers of 16 bits. */
static inline void store_short_numbers(uint16_t to[8], uint16x8_t numbers)
{
    vst1q_u16(to, numbers);
    __asm__("" : "+m"(*(uint16_t(*)[8])to));
}

static inline size_t stored_short_offset(const uint16_t *number)
{
    size_t offset = *number;
    __asm__("" : "+r"(offset));
    return offset;
}

/** @return A stored number that may be negative. */
static inline ptrdiff_t stored_signed_offset(const uint16_t *number)
{
    ptrdiff_t offset = (int16_t)*number;
    __asm__("" : "+r"(offset));
    return offset;
}

/** @return The same address, in a register: gcc would make each load add its parts up anew. */
static inline const uint8_t *kept_address(const uint8_t *address)
{
    __asm__("" : "+r"(address));
    return address;
}

/** @return Eight bytes whose lanes are going to be splatted; gcc would load each lane by itself. */
static inline uint8x8_t load_to_splat(const uint8_t *bytes)
{
    uint8x8_t vector = vld1_u8(bytes);
#ifdef __aarch64__
    __asm__("" : "+w"(vector));
#endif
    return vector;
}

/** @return Four bytes, at any address; what follows them in the vector is not to be used. */
static inline uint8x16_t load_word(const uint8_t *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
#if defined(__aarch64__) && !defined(__clang__)
    uint8x16_t vector; /* gcc would make a vector of zeros for each word first */
    __asm__("" : "=w"(vector) : "0"(vcreate_u8(word)));
    return vector;
#else
    return vreinterpretq_u8_u32(vsetq_lane_u32(word, vdupq_n_u32(0), 0));
#endif
}

/** @return Four bytes, each of them in all lanes of one vector. */
static inline uint8x16x4_t load_4_splats(const uint8_t *bytes)
{
#ifdef __aarch64__
    return vld4q_dup_u8(bytes);
#else
    return (uint8x16x4_t){{vdupq_n_u8(bytes[0]), vdupq_n_u8(bytes[1]), vdupq_n_u8(bytes[2]), vdupq_n_u8(bytes[3])}};
#endif
}

/** @return The same in short vectors, which cost fewer micro-operations. */
static inline uint8x8x4_t load_4_short_splats(const uint8_t *bytes)
{
#ifdef __aarch64__
    return vld4_dup_u8(bytes);
#else
    return (uint8x8x4_t){{vdup_n_u8(bytes[0]), vdup_n_u8(bytes[1]), vdup_n_u8(bytes[2]), vdup_n_u8(bytes[3])}};
#endif
}

/** @return x * 2^shift, lane by lane, rounded half up and saturated. */
static inline int32x4_t shift_saturated(int32x4_t x, int32x4_t shift)
{
#ifdef __aarch64__
    return vqrshlq_s32(x, shift);
#else
    const int64x2_t low = vrshlq_s64(vmovl_s32(vget_low_s32(x)), vmovl_s32(vget_low_s32(shift)));
    const int64x2_t high = vrshlq_s64(vmovl_s32(vget_high_s32(x)), vmovl_s32(vget_high_s32(shift)));
    return vcombine_s32(vqmovn_s64(low), vqmovn_s64(high));
#endif
}

/** @return (a + b + 2^15) / 2^16 rounded down, lane by lane; the sum must fit 32 bits. */
static inline int16x4_t add_rounded_high(int32x4_t a, int32x4_t b)
{
#ifdef __aarch64__
    return vraddhn_s32(a, b);
#else
    return vrshrn_n_s32(vaddq_s32(a, b), 16);
#endif
}

/** @return Half of each of four numbers, rounded half up, modulo 2^32. */
static inline int32x4_t rounded_halves(int64x2_t low, int64x2_t high)
{
#ifdef __aarch64__
    return vrshrn_high_n_s64(vrshrn_n_s64(low, 1), high, 1);
#else
    return vcombine_s32(vrshrn_n_s64(low, 1), vrshrn_n_s64(high, 1));
#endif
}

/** @return a b / 2^32, rounded down, lane by lane; a or b is above -2^31. */
static inline int32x4_t upper_product(int32x4_t a, int32x4_t b)
{
#ifdef __aarch64__ /* half of floor(2 a b / 2^32) */
    return vshrq_n_s32(vqdmulhq_s32(a, b), 1);
#else
    const int64x2_t low = vmull_s32(vget_low_s32(a), vget_low_s32(b));
    const int64x2_t high = vmull_s32(vget_high_s32(a), vget_high_s32(b));
    return vcombine_s32(vshrn_n_s64(low, 32), vshrn_n_s64(high, 32));
#endif
}

/** @return sum + the same. */
static inline int32x4_t add_upper_product(int32x4_t sum, int32x4_t a, int32x4_t b)
{
#ifdef __aarch64__
    return vsraq_n_s32(sum, vqdmulhq_s32(a, b), 1);
#else
    return vaddq_s32(sum, upper_product(a, b));
#endif
}

/** @return a weights[2 pair] + b weights[2 pair + 1]: v is a, four values, and b. All are below 2^15. */
NEON_INLINE uint32x4_t two_weighed(uint16x8_t v, uint16x8_t weights, int pair)
{
#ifdef __SSE2__
    return x86_two_weighed(v, weights, pair);
#else
    const uint16x4_t a = vget_low_u16(v), b = vget_high_u16(v);
    const uint16x4_t left = vget_low_u16(weights), right = vget_high_u16(weights);
    switch (pair) {
    case 0:
        return vmlal_lane_u16(vmull_lane_u16(a, left, 0), b, left, 1);
    case 1:
        return vmlal_lane_u16(vmull_lane_u16(a, left, 2), b, left, 3);
    case 2:
        return vmlal_lane_u16(vmull_lane_u16(a, right, 0), b, right, 1);
    default:
        return vmlal_lane_u16(vmull_lane_u16(a, right, 2), b, right, 3);
    }
#endif
}

#endif
