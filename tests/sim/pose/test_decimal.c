// SPDX-License-Identifier: Apache-2.0
// Tests of decimal text to integers: exactness, rounding, refusals.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "sim/pose/decimal.h"
#include "tests/support/rng.h"

static void check(const char *text, int places, int64_t expected)
{
    int64_t value = 12345;
    if (decimal_from_text(text, places, &value) != DECIMAL_OK)
        fail_msg("\"%s\": refused, expected %lld", text, (long long)expected);
    if (value != expected)
        fail_msg("\"%s\" to %d places: %lld, expected %lld", text, places, (long long)value, (long long)expected);
}

static void test_numbers_are_read_exactly(void **state)
{
    (void)state;
    check("0", 6, 0);
    check("-0.0", 6, 0);
    check("1", 0, 1);
    check("+1.5", 1, 15);
    check("-7989.829770", 6, -7989829770);
    check(".5", 3, 500);
    check("5.", 3, 5000);
    check("1e3", 2, 100000);
    check("12.5E-1", 2, 125);
    check("-1e+2", 0, -100);
    check("000000000000000000000000000001.25", 2, 125);
    check("0.000000000000000000000000000001", 18, 0);
    check("999999999999999999", 0, INT64_C(999999999999999999));
    check("0.1", 17, INT64_C(10000000000000000));
    check("123456789012345678901234567890e-20", 6, INT64_C(1234567890123457));
    check("0e999999999999", 6, 0);
    check("1e-999999999999", 6, 0);
}

static void test_rounding_is_to_nearest_ties_away_from_zero(void **state)
{
    (void)state;
    check("0.4999999999999999999999", 0, 0);
    check("0.5", 0, 1);
    check("-0.5", 0, -1);
    check("-0.49", 0, 0);
    check("1.4500", 1, 15);
    check("1.4499999", 1, 14);
    check("0.00000049", 6, 0);
    check("0.0000005", 6, 1);
    check("9.96", 1, 100);
}

static void test_random_numbers_of_six_places(void **state)
{
    (void)state;
    rng_t rng = {.state = 7};
    for (int round = 0; round < 20000; round++) {
        const int64_t expected = rng_int(&rng, -(INT64_C(1) << 39), INT64_C(1) << 39);
        const uint64_t size = (uint64_t)(expected < 0 ? -expected : expected);
        char text[64];
        snprintf(text, sizeof text, "%s%llu.%06llu", expected < 0 ? "-" : "", (unsigned long long)(size / 1000000),
                 (unsigned long long)(size % 1000000));
        check(text, 6, expected);
    }
}

static void test_other_text_is_refused(void **state)
{
    (void)state;
    static const char *const WRONG[] = {"",     " ",   " 1",       "1 ",   "-",   "+-1", ".",   "e5",
                                        "1e",   "1e+", "1.2.3",    "1,",   "nan", "NaN", "inf", "-inf",
                                        "0x10", "1f",  "infinity", "1e5x", "--1", "1\n"};
    for (size_t i = 0; i < sizeof WRONG / sizeof WRONG[0]; i++) {
        int64_t value = 12345;
        if (decimal_from_text(WRONG[i], 6, &value) != DECIMAL_NOT_A_NUMBER)
            fail_msg("\"%s\" was taken for a number", WRONG[i]);
        assert_true(value == 12345);
    }
    static const char *const LARGE[] = {"1e12", "1000000000000", "-1e999999999999", "123456789012345678901234567890"};
    for (size_t i = 0; i < sizeof LARGE / sizeof LARGE[0]; i++) {
        int64_t value = 12345;
        if (decimal_from_text(LARGE[i], 6, &value) != DECIMAL_TOO_LARGE)
            fail_msg("\"%s\" was not too large", LARGE[i]);
        assert_true(value == 12345);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_are_read_exactly),
        cmocka_unit_test(test_rounding_is_to_nearest_ties_away_from_zero),
        cmocka_unit_test(test_random_numbers_of_six_places),
        cmocka_unit_test(test_other_text_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
