// SPDX-License-Identifier: Apache-2.0
// The cache model against a plain one that remembers when each line was used.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "tests/bench/cache_model.h"
#include "tests/support/rng.h"

enum { L1_BYTES = 32 << 10, L1_WAYS = 2, LINES = 4096, TOUCHES = 200000 };

static cache_t cache;

static int misses_of_walk(int bytes, int step)
{
    int misses = 0;
    for (int address = 0; address < bytes; address += step)
        misses += !cache_touch(&cache, (uint64_t)address);
    return misses;
}

static void what_fits_stays(void **state)
{
    (void)state;
    cache_init(&cache, L1_BYTES, L1_WAYS);
    assert_int_equal(misses_of_walk(L1_BYTES, 4), L1_BYTES / CACHE_LINE_BYTES);
    assert_int_equal(misses_of_walk(L1_BYTES, 4), 0);
}

static void more_than_fits_is_gone_when_it_comes_again(void **state)
{
    (void)state;
    cache_init(&cache, L1_BYTES, L1_WAYS);
    misses_of_walk(2 * L1_BYTES, CACHE_LINE_BYTES);
    assert_int_equal(misses_of_walk(2 * L1_BYTES, CACHE_LINE_BYTES), 2 * L1_BYTES / CACHE_LINE_BYTES);
}

static void three_lines_of_one_set_of_two(void **state)
{
    (void)state;
    const uint64_t a = 64, b = a + L1_BYTES / L1_WAYS, c = b + L1_BYTES / L1_WAYS;
    cache_init(&cache, L1_BYTES, L1_WAYS);
    assert_false(cache_touch(&cache, a));
    assert_false(cache_touch(&cache, b));
    assert_true(cache_touch(&cache, a + 63));
    assert_false(cache_touch(&cache, c)); /* b goes */
    assert_true(cache_touch(&cache, a));
    assert_false(cache_touch(&cache, b)); /* c goes */
    assert_false(cache_touch(&cache, c));
}

/* Which of a set's lines were used, and when: the `ways` newest are in the cache. */
static void random_addresses(int bytes, int ways, uint64_t seed)
{
    static int used_at[LINES];
    rng_t rng = {seed};
    cache_init(&cache, bytes, ways);
    for (int line = 0; line < LINES; line++)
        used_at[line] = 0;
    const int sets = bytes / CACHE_LINE_BYTES / ways;
    for (int touch = 1; touch <= TOUCHES; touch++) {
        const int line = (int)rng_int(&rng, 0, LINES - 1);
        int newer = 0;
        for (int other = line % sets; other < LINES; other += sets)
            newer += used_at[other] > used_at[line];
        const bool expected = used_at[line] > 0 && newer < ways;
        const uint64_t address = (uint64_t)(line * CACHE_LINE_BYTES + rng_int(&rng, 0, CACHE_LINE_BYTES - 1));
        if (cache_touch(&cache, address) != expected) {
            print_message("%d bytes, %d ways, seed %d, touch %d: expected a %s\n", bytes, ways, (int)seed, touch,
                          expected ? "hit" : "miss");
            fail();
        }
        used_at[line] = touch;
    }
}

static void lines_used_longest_ago_go(void **state)
{
    (void)state;
    random_addresses(L1_BYTES, L1_WAYS, 1);
    random_addresses(64 << 10, 16, 2);
    random_addresses(16 << 10, 4, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_stays),
        cmocka_unit_test(more_than_fits_is_gone_when_it_comes_again),
        cmocka_unit_test(three_lines_of_one_set_of_two),
        cmocka_unit_test(lines_used_longest_ago_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
