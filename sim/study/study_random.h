// SPDX-License-Identifier: Apache-2.0
// Random numbers of the study: splitmix64, the same on every machine.
#ifndef SIM_STUDY_STUDY_RANDOM_H
#define SIM_STUDY_STUDY_RANDOM_H

#include <math.h>
#include <stdint.h>

/** Any state is a good seed. */
typedef struct {
    uint64_t state;
} study_random_t;

static inline uint64_t study_random_next(study_random_t *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/** @return Uniform in (0, 1]. */
static inline double study_random_unit(study_random_t *random)
{
    return (double)((study_random_next(random) >> 11) + 1) / 9007199254740992.0;
}

/** @return Normal, mean 0 and deviation 1 (Box and Muller). */
static inline double study_random_normal(study_random_t *random)
{
    const double radius = sqrt(-2.0 * log(study_random_unit(random)));
    return radius * cos(6.283185307179586 * study_random_unit(random));
}

#endif
