// SPDX-License-Identifier: Apache-2.0
// Real numbers on integers: a 63-bit signed mantissa and an exponent, the same bits on every machine.
//
// For the geometry that is done once per wall or once per frame. Every result is within 2^-61 of its own size of the
// exact one, so a chain of some hundred operations without cancellation keeps 50 bits. Pixels never see this type.
#ifndef WARP_FIXED_REAL_H
#define WARP_FIXED_REAL_H

#include <stdbool.h>
#include <stdint.h>

/** mantissa * 2^exponent; 2^62 <= |mantissa| < 2^63, or both zero. Make one with the functions below only. */
typedef struct {
    int64_t mantissa;
    int32_t exponent;
} real_t;

/** @return value * 2^exponent, exactly. |value| < 2^63; |exponent| <= 2^20. */
real_t real_from_int(int64_t value, int32_t exponent);

real_t real_add(real_t a, real_t b);
real_t real_sub(real_t a, real_t b);
real_t real_mul(real_t a, real_t b);

/** @return a / b. b must not be zero (ask real_sign() first). 64 steps of long division. */
real_t real_div(real_t a, real_t b);

/** @return The square root of a >= 0. 63 steps. */
real_t real_sqrt(real_t a);

real_t real_neg(real_t a);
real_t real_abs(real_t a);

/** @return a * 2^shift, exactly. */
real_t real_scale(real_t a, int32_t shift);

/** @return -1, 0 or 1. */
int real_sign(real_t a);

/** @return Is a < b? */
bool real_less(real_t a, real_t b);

/**
 * @return a * 2^fraction_bits rounded to the nearest integer (ties away from zero), saturated to
 *         [-limit, limit]; limit > 0.
 */
int64_t real_to_fixed(real_t a, int32_t fraction_bits, int64_t limit);

#endif
