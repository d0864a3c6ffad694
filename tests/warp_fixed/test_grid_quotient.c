// SPDX-License-Identifier: Apache-2.0
// The grid's reciprocal, made by products: the same as a division's.
#include "warp_fixed/grid_quotient.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/rng.h"

enum { MOST_BITS = 60 };

static void check_reciprocal(uint64_t w)
{
    const int zeros = __builtin_clzll(w);
    const int64_t expected = (int64_t)(((uint64_t)1 << 63) / (w << zeros >> 32));
    const reciprocal_t found = reciprocal_of((int64_t)w);
    if (found.reciprocal != expected || found.zeros != zeros)
        fail_msg("reciprocal_of(%lu) is %ld, %d zeros, not %ld, %d", (unsigned long)w, (long)found.reciprocal,
                 found.zeros, (long)expected, zeros);
}

/* It is made of the upper 32 bits below the first zero: all of these, 2^31 of them, were tried once. */
static void reciprocals_are_those_of_a_division(void **state)
{
    (void)state;
    rng_t rng = {1};
    for (uint64_t near = 0; near < 200000; near++) {
        check_reciprocal(((uint64_t)1 << 31) + near);
        check_reciprocal(((uint64_t)1 << 32) - 1 - near);
    }
    for (int bits = 1; bits <= MOST_BITS; bits++)
        check_reciprocal((uint64_t)1 << (bits - 1));
    for (int n = 0; n < 4000000; n++)
        check_reciprocal(((uint64_t)1 << 63 | rng_next(&rng)) >> (4 + n % MOST_BITS));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reciprocals_are_those_of_a_division),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
