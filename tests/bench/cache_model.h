// SPDX-License-Identifier: Apache-2.0
// A cache of lines of 64 bytes that replaces the line used longest ago.
#ifndef TESTS_BENCH_CACHE_MODEL_H
#define TESTS_BENCH_CACHE_MODEL_H

#include <stdbool.h>
#include <stdint.h>

enum { CACHE_LINE_BYTES = 64, CACHE_MAX_BYTES = 1 << 20 };

typedef struct {
    uint64_t sets;
    int ways;
    uint64_t line[CACHE_MAX_BYTES / CACHE_LINE_BYTES]; /**< of each set in turn, the last used one first */
} cache_t;

/**
 * Make an empty cache.
 *
 * @param bytes  CACHE_MAX_BYTES at most, a power of two of sets of `ways` lines.
 */
void cache_init(cache_t *cache, int bytes, int ways);

/** Use the line that holds an address. @return true when it was there; false when it had to be fetched, and now is. */
bool cache_touch(cache_t *cache, uint64_t address);

#endif
