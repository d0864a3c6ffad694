// SPDX-License-Identifier: Apache-2.0
// Tests of random numbers: no two alike, and every bit of them changes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "hal/hal_random.h"

enum { NUMBERS = 64 };

static void test_numbers_differ(void **state)
{
    (void)state;
    uint64_t number[NUMBERS], ever = 0, always = UINT64_MAX;
    for (int i = 0; i < NUMBERS; i++) {
        assert_int_equal(hal_random(&number[i]), HAL_OK);
        ever |= number[i];
        always &= number[i];
        for (int k = 0; k < i; k++)
            assert_true(number[k] != number[i]);
    }
    assert_true(ever == UINT64_MAX); /* by chance not so: once in 10^17 */
    assert_true(always == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers_differ)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
