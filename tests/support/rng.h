// SPDX-License-Identifier: Apache-2.0
// Random numbers in a range, for property tests.
#ifndef TESTS_SUPPORT_RNG_H
#define TESTS_SUPPORT_RNG_H

#include "sim/rng.h"

/** @return Uniform in [low, high], both included. */
static inline int64_t rng_int(rng_t *rng, int64_t low, int64_t high)
{
    return low + (int64_t)(rng_next(rng) % (uint64_t)(high - low + 1));
}

/** @return Uniform in [low, high). */
static inline double rng_double(rng_t *rng, double low, double high)
{
    return low + (high - low) * (double)(rng_next(rng) >> 11) / 9007199254740992.0;
}

#endif
