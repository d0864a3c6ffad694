// SPDX-License-Identifier: Apache-2.0
// Random numbers of the simulator and the evaluation: splitmix64, the same on every machine.
#ifndef SIM_RNG_H
#define SIM_RNG_H

#include <math.h>
#include <stdint.h>

/** Any state is a good seed. */
typedef struct {
    uint64_t state;
} rng_t;

static inline uint64_t rng_next(rng_t *rng)
{
    uint64_t z = rng->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/** @return Uniform in (0, 1]. */
static inline double rng_unit(rng_t *rng)
{
    return (double)((rng_next(rng) >> 11) + 1) / 9007199254740992.0;
}

/** @return Normal, mean 0 and deviation 1 (Box and Muller). */
static inline double rng_normal(rng_t *rng)
{
    const double radius = sqrt(-2.0 * log(rng_unit(rng)));
    return radius * cos(2.0 * M_PI * rng_unit(rng));
}

#endif
