// SPDX-License-Identifier: Apache-2.0
// Vectors of random and extreme values, and what a NEON intrinsic should make of them, lane by lane.
#ifndef TESTS_SUPPORT_LANES_H
#define TESTS_SUPPORT_LANES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/rng.h"
#include "warp_fixed/neon.h"

enum { LANES_ROUNDS = 20000 };

typedef union {
    uint8_t u8[16];
    int8_t s8[16];
    uint16_t u16[8];
    int16_t s16[8];
    uint32_t u32[4];
    int32_t s32[4];
    int64_t s64[2];
    uint8x16_t vector;
} lanes_t;

/* What a round has to work on. Signed sums that overflow wrap: so they are made of unsigned ones here. */
typedef struct {
    uint64_t seed;
    lanes_t a, b, c;
    lanes_t expected;
} round_t;

static inline lanes_t random_lanes(rng_t *rng)
{
    static const uint16_t extremes[] = {0, 1, 0x7f, 0x80, 0xff, 0x7fff, 0x8000, 0xffff, 0x8080, 0xff00};
    lanes_t lanes;
    for (int i = 0; i < 8; i++)
        lanes.u16[i] = rng_int(rng, 0, 1) ? extremes[rng_int(rng, 0, 9)] : (uint16_t)rng_next(rng);
    return lanes;
}

static inline round_t new_round(uint64_t seed)
{
    rng_t rng = {seed};
    round_t round = {.seed = seed};
    round.a = random_lanes(&rng);
    round.b = random_lanes(&rng);
    round.c = random_lanes(&rng);
    return round;
}

static inline void check_bytes(const round_t *round, const char *name, const void *vector, size_t bytes)
{
    const uint8_t *got = vector;
    for (size_t i = 0; i < bytes; i++)
        if (got[i] != round->expected.u8[i])
            fail_msg("%s, seed %lu: byte %zu is %u, expected %u", name, (unsigned long)round->seed, i, got[i],
                     round->expected.u8[i]);
}

static inline void check(const round_t *round, const char *name, uint8x16_t vector)
{
    check_bytes(round, name, &vector, sizeof vector);
}

static inline void check_half(const round_t *round, const char *name, uint8x8_t vector)
{
    check_bytes(round, name, &vector, sizeof vector);
}

#endif
