// SPDX-License-Identifier: Apache-2.0
// Real numbers on integers: a 63-bit signed mantissa and an exponent, the same bits on every machine.
#include "warp_fixed/real.h"

#include "warp_fixed/fixed.h"

enum { MANTISSA_BITS = 63 };

/* Sums are rounded here: wide carries the exact result of an operation, or all that matters of it. */
static real_t normalised(int128_t wide, int32_t exponent)
{
    if (wide == 0)
        return (real_t){0, 0};
    const bool negative = wide < 0;
    uint128_t size = (uint128_t)(negative ? -wide : wide);

    const uint64_t high = (uint64_t)(size >> 64);
    const int bits = high != 0 ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll((uint64_t)size);
    int shift = bits - MANTISSA_BITS;
    if (shift > 0) {
        size += (uint128_t)1 << (shift - 1);
        size >>= shift;
        if ((uint64_t)size >> MANTISSA_BITS != 0) { /* rounded up to the next power of two */
            size >>= 1;
            shift++;
        }
    } else {
        size <<= -shift;
    }
    const int64_t mantissa = (int64_t)size;
    return (real_t){negative ? -mantissa : mantissa, exponent + shift};
}

real_t real_from_int(int64_t value, int32_t exponent)
{
    return normalised(value, exponent);
}

real_t real_add(real_t a, real_t b)
{
    if (a.mantissa == 0)
        return b;
    if (b.mantissa == 0)
        return a;
    const real_t large = a.exponent >= b.exponent ? a : b;
    const real_t small = a.exponent >= b.exponent ? b : a;
    const int32_t distance = large.exponent - small.exponent;
    if (distance > MANTISSA_BITS + 1) /* less than a quarter of the last bit */
        return large;
    /* 63 + 60 bits at most: what lies below is under 2^-4 of the last bit when distance > 60. */
    const int lift = distance < 60 ? distance : 60;
    const int128_t sum = (int128_t)large.mantissa * ((int64_t)1 << lift) + (small.mantissa >> (distance - lift));
    return normalised(sum, large.exponent - lift);
}

real_t real_sub(real_t a, real_t b)
{
    return real_add(a, real_neg(b));
}

real_t real_mul(real_t a, real_t b)
{
    return normalised((int128_t)a.mantissa * b.mantissa, a.exponent + b.exponent);
}

real_t real_div(real_t a, real_t b)
{
    const bool negative = (a.mantissa < 0) != (b.mantissa < 0);
    uint64_t remainder = (uint64_t)(a.mantissa < 0 ? -a.mantissa : a.mantissa);
    const uint64_t divisor = (uint64_t)(b.mantissa < 0 ? -b.mantissa : b.mantissa);
    int128_t quotient = 0; /* of |a| * 2^64 / |b|: 65 bits */
    if (remainder >= divisor) {
        quotient = 1;
        remainder -= divisor;
    }
    for (int i = 0; i < 64; i++) { /* remainder < divisor < 2^63, so doubling fits */
        remainder <<= 1;
        quotient *= 2;
        if (remainder >= divisor) {
            remainder -= divisor;
            quotient += 1;
        }
    }
    return normalised(negative ? -quotient : quotient, a.exponent - b.exponent - 64);
}

real_t real_sqrt(real_t a)
{
    if (a.mantissa <= 0)
        return (real_t){0, 0};
    /* a = m * 2^e with e even and 2^124 <= m < 2^126; the root of m has 63 bits. */
    const int lift = 62 + (a.exponent & 1);
    uint128_t rest = (uint128_t)(uint64_t)a.mantissa << lift;
    uint128_t root = 0;
    for (uint128_t bit = (uint128_t)1 << 124; bit != 0; bit >>= 2) {
        if (rest >= root + bit) {
            rest -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return normalised((int128_t)root, (a.exponent - lift) / 2);
}

real_t real_neg(real_t a)
{
    return (real_t){-a.mantissa, a.exponent};
}

real_t real_abs(real_t a)
{
    return a.mantissa < 0 ? real_neg(a) : a;
}

real_t real_scale(real_t a, int32_t shift)
{
    return a.mantissa == 0 ? a : (real_t){a.mantissa, a.exponent + shift};
}

int real_sign(real_t a)
{
    return (a.mantissa > 0) - (a.mantissa < 0);
}

bool real_less(real_t a, real_t b)
{
    return real_sub(a, b).mantissa < 0;
}

int64_t real_to_fixed(real_t a, int32_t fraction_bits, int64_t limit)
{
    const int32_t shift = -(a.exponent + fraction_bits);
    const int64_t size = a.mantissa < 0 ? -a.mantissa : a.mantissa;
    int64_t fixed = limit;
    if (shift > MANTISSA_BITS || size == 0)
        fixed = 0;
    else if (shift >= 1)
        fixed = (int64_t)(((uint64_t)size + ((uint64_t)1 << (shift - 1))) >> shift);
    else if (shift == 0)
        fixed = size;
    fixed = fixed < limit ? fixed : limit;
    return a.mantissa < 0 ? -fixed : fixed;
}
