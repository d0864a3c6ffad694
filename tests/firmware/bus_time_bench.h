// SPDX-License-Identifier: Apache-2.0
// A master's clock and a board's, for tests of bus time: pairs of stamps with jitter, drift and outliers.
#ifndef TESTS_FIRMWARE_BUS_TIME_BENCH_H
#define TESTS_FIRMWARE_BUS_TIME_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "firmware/bus_time.h"
#include "tests/support/rng.h"

enum {
    PERIOD_US = 125000,
    PAIRS_OF_AN_HOUR = 27000,
    LOCK_LATE_ALIKE = 160,
    LOCK_EITHER_WAY = 400,
    MINUTE_US = 60000000
};

/* How the stamps of a pair are off: uniformly in a range of the given width. */
typedef enum {
    EXACT,
    LATE_ALIKE, /**< sender's and receiver's by 0 to 200 us */
    EITHER_WAY  /**< the receiver's by -200 to 200 us, the sender's not at all */
} jitter_t;

/* A master's clock that is bus time, and a board's. */
typedef struct {
    bus_time_t time;
    rng_t rng;
    jitter_t jitter;
    int32_t drift_ppb; /* of the board */
    int64_t offset_us; /* of the board */
    int64_t now_us;    /* bus time */
} bench_t;

static inline int64_t local_at(const bench_t *b, int64_t bus_us)
{
    return bus_us + b->offset_us + bus_us / 1000 * b->drift_ppb / 1000000;
}

static inline int64_t uniform(bench_t *b, int64_t low, int64_t high)
{
    return low + (int64_t)(rng_next(&b->rng) % (uint64_t)(high - low + 1));
}

static inline int64_t error_at(const bench_t *b, int64_t bus_us)
{
    return llabs(bus_time_from_local(&b->time, local_at(b, bus_us)) - bus_us);
}

static inline bench_t new_bench(uint64_t seed, jitter_t jitter)
{
    bench_t b = {.rng = {seed}, .jitter = jitter, .now_us = 1000000};
    b.drift_ppb = (int32_t)uniform(&b, -50000, 50000);
    b.offset_us = uniform(&b, 0, INT64_C(4000000000));
    return b;
}

static inline void pair_off_by(bench_t *b, int64_t off_us)
{
    const int64_t sent = b->jitter == LATE_ALIKE ? uniform(b, 0, 200) : 0;
    const int64_t heard = b->jitter == LATE_ALIKE   ? uniform(b, 0, 200)
                          : b->jitter == EITHER_WAY ? uniform(b, -200, 200)
                                                    : 0;
    bus_time_pair(&b->time, local_at(b, b->now_us) + heard, b->now_us + sent + off_us);
    b->now_us += PERIOD_US + uniform(b, 0, 16000);
}

static inline void pairs(bench_t *b, int count)
{
    for (int i = 0; i < count; i++)
        pair_off_by(b, 0);
}

static inline int pairs_until_lock(bench_t *b)
{
    int count = 0;
    for (; !b->time.locked && count < 1000; count++)
        pair_off_by(b, 0);
    return count;
}

/* Right, and honest about it? */
static inline void check_now(const bench_t *b, uint64_t seed, int64_t limit_us)
{
    const int64_t error_us = error_at(b, b->now_us);
    const uint32_t claimed_us = bus_time_error_us(&b->time, local_at(b, b->now_us));
    if (error_us > limit_us || error_us > claimed_us)
        fail_msg("seed %llu, jitter %d, drift %d ppb: %lld us off, claimed %u, expected at most %lld",
                 (unsigned long long)seed, (int)b->jitter, b->drift_ppb, (long long)error_us, claimed_us,
                 (long long)limit_us);
}

static inline bench_t locked_bench(uint64_t seed, jitter_t jitter)
{
    static const int lock_within[] = {BUS_TIME_LEAST_PAIRS, LOCK_LATE_ALIKE, LOCK_EITHER_WAY};
    bench_t b = new_bench(seed, jitter);
    const int count = pairs_until_lock(&b);
    if (count > lock_within[jitter])
        fail_msg("seed %llu, jitter %d: locked after %d pairs", (unsigned long long)seed, (int)jitter, count);
    check_now(&b, seed, 100);
    return b;
}

#endif
