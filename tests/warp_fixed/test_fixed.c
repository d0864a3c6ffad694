// SPDX-License-Identifier: Apache-2.0
// The square root of the fixed-point formats: exact where it turns from one integer to the next.
#include "warp_fixed/fixed.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/support/rng.h"

static void check_root(uint64_t root)
{
    const uint64_t square = root * root;
    if (floor_sqrt(square) != root)
        fail_msg("floor_sqrt(%lu^2) is %u", (unsigned long)root, floor_sqrt(square));
    if (root > 0 && floor_sqrt(square - 1) != root - 1)
        fail_msg("floor_sqrt(%lu^2 - 1) is %u", (unsigned long)root, floor_sqrt(square - 1));
    if (floor_sqrt(square + 2 * root) != root)
        fail_msg("floor_sqrt(%lu^2 + %lu) is %u", (unsigned long)root, 2 * (unsigned long)root,
                 floor_sqrt(square + 2 * root));
}

static void roots_are_exact_next_to_every_kind_of_square(void **state)
{
    (void)state;
    for (uint64_t root = 0; root < 100000; root++)
        check_root(root);
    for (int bit = 0; bit < 32; bit++)
        for (int64_t near = -2; near <= 2; near++)
            if (((int64_t)1 << bit) + near >= 0)
                check_root((uint64_t)(((int64_t)1 << bit) + near));
    rng_t rng = {1};
    for (int n = 0; n < 1000000; n++)
        check_root(rng_next(&rng) >> (32 + n % 32));
    check_root(UINT32_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_exact_next_to_every_kind_of_square),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
