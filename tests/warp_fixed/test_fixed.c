// SPDX-License-Identifier: Apache-2.0
// The square root of the fixed-point formats, exact where it turns from one integer to the next, and mirroring.
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

/* One after the other, texels of the mirrored picture run forth and back. */
static void mirroring_goes_on_for_ever(void **state)
{
    (void)state;
    for (int32_t size = 1; size <= 9; size++) {
        const int32_t first = -50 * 2 * size;
        int32_t expected = 0, by = 1;
        for (int32_t i = first; i < -first; i++) {
            if (mirror_index(i, size) != expected)
                fail_msg("texel %d of %d is texel %d, not %d", i, size, mirror_index(i, size), expected);
            if (expected + by < 0 || expected + by == size)
                by = -by;
            else
                expected += by;
        }
        assert_int_equal(mirror_index(INT32_MAX, size),
                         (INT32_MAX / size) % 2 == 0 ? INT32_MAX % size : size - 1 - INT32_MAX % size);
        assert_int_equal(mirror_index(INT32_MIN, size), mirror_index(INT32_MAX, size));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_exact_next_to_every_kind_of_square),
        cmocka_unit_test(mirroring_goes_on_for_ever),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
