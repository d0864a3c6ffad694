// SPDX-License-Identifier: Apache-2.0
// Three-vectors of reals.
#ifndef WARP_FIXED_REAL_VECTOR_H
#define WARP_FIXED_REAL_VECTOR_H

#include "warp_fixed/real.h"

static inline real_t vector_dot(const real_t a[3], const real_t b[3])
{
    return real_add(real_add(real_mul(a[0], b[0]), real_mul(a[1], b[1])), real_mul(a[2], b[2]));
}

/** out = a - b; out may be a or b. */
static inline void vector_sub(real_t out[3], const real_t a[3], const real_t b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = real_sub(a[i], b[i]);
}

/** out = a x b; out must be neither. */
static inline void vector_cross(real_t out[3], const real_t a[3], const real_t b[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = real_sub(real_mul(a[j], b[k]), real_mul(a[k], b[j]));
    }
}

#endif
