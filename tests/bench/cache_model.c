// SPDX-License-Identifier: Apache-2.0
// A cache of lines of 64 bytes that replaces the line used longest ago.
#include "tests/bench/cache_model.h"

#include <string.h>

void cache_init(cache_t *cache, int bytes, int ways)
{
    cache->sets = (uint64_t)(bytes / CACHE_LINE_BYTES / ways);
    cache->ways = ways;
    memset(cache->line, 0xff, sizeof cache->line); /* of no address */
}

bool cache_touch(cache_t *cache, uint64_t address)
{
    const uint64_t line = address / CACHE_LINE_BYTES;
    uint64_t *set = &cache->line[line % cache->sets * (uint64_t)cache->ways];
    if (set[0] == line)
        return true;
    int way = 1;
    while (way < cache->ways && set[way] != line)
        way++;
    const bool hit = way < cache->ways;
    memmove(&set[1], &set[0], (size_t)(hit ? way : cache->ways - 1) * sizeof *set);
    set[0] = line;
    return hit;
}
