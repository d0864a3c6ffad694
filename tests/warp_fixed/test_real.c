// SPDX-License-Identifier: Apache-2.0
// Reals on integers against long double (64-bit mantissa) and against exact cases.
#include "warp_fixed/real.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "tests/support/rng.h"

static long double value_of(real_t a)
{
    return ldexpl((long double)a.mantissa, a.exponent);
}

static real_t random_real(rng_t *rng)
{
    const int64_t bits = (int64_t)(rng_next(rng) >> rng_int(rng, 1, 62));
    return real_from_int(rng_int(rng, 0, 1) == 1 ? bits : -bits, (int32_t)rng_int(rng, -90, 90));
}

static void check(uint64_t seed, const char *operation, real_t got, long double expected, long double scale)
{
    if (fabsl(value_of(got) - expected) > ldexpl(scale, -61))
        fail_msg("seed %lu: %s gives %.21Lg, expected %.21Lg", (unsigned long)seed, operation, value_of(got), expected);
    if (got.mantissa == 0 ? got.exponent != 0 : llabs(got.mantissa) >> 62 != 1)
        fail_msg("seed %lu: %s is not normalised", (unsigned long)seed, operation);
}

static void operations_keep_61_bits(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 200000; seed++) {
        rng_t rng = {seed};
        const real_t a = random_real(&rng), b = random_real(&rng);
        const long double x = value_of(a), y = value_of(b);
        check(seed, "sum", real_add(a, b), x + y, fabsl(x + y) + fmaxl(fabsl(x), fabsl(y)) / 8);
        check(seed, "difference", real_sub(a, b), x - y, fabsl(x - y) + fmaxl(fabsl(x), fabsl(y)) / 8);
        check(seed, "product", real_mul(a, b), x * y, fabsl(x * y));
        check(seed, "root", real_sqrt(real_abs(a)), sqrtl(fabsl(x)), sqrtl(fabsl(x)));
        if (real_sign(b) != 0)
            check(seed, "quotient", real_div(a, b), x / y, fabsl(x / y));
        assert_int_equal(real_less(a, b), x < y);
        assert_int_equal(real_sign(a), (x > 0) - (x < 0));
    }
}

static void small_integers_are_exact(void **state)
{
    (void)state;
    for (int a = -40; a <= 40; a++) {
        for (int b = -40; b <= 40; b++) {
            const real_t x = real_from_int(a, 0), y = real_from_int(b, 0);
            assert_int_equal(real_to_fixed(real_add(x, y), 0, 10000), a + b);
            assert_int_equal(real_to_fixed(real_mul(x, y), 0, 10000), a * b);
            if (b != 0)
                assert_int_equal(real_to_fixed(real_div(real_mul(x, y), y), 4, 10000), 16 * a);
        }
        assert_int_equal(real_to_fixed(real_sqrt(real_from_int(a * a, 0)), 0, 10000), a < 0 ? -a : a);
    }
}

static void fixed_point_rounds_and_saturates(void **state)
{
    (void)state;
    assert_int_equal(real_to_fixed(real_from_int(5, -1), 0, 100), 3);
    assert_int_equal(real_to_fixed(real_from_int(-5, -1), 0, 100), -3);
    assert_int_equal(real_to_fixed(real_from_int(9, -2), 0, 100), 2);
    assert_int_equal(real_to_fixed(real_from_int(1, 80), 0, 100), 100);
    assert_int_equal(real_to_fixed(real_from_int(-1, 80), 0, 100), -100);
    assert_int_equal(real_to_fixed(real_from_int(1, -80), 10, 100), 0);
    assert_int_equal(real_to_fixed(real_from_int(INT64_MAX, 0), 0, INT64_MAX), INT64_MAX);
    assert_int_equal(real_to_fixed(real_from_int(0, 0), 60, 100), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations_keep_61_bits),
        cmocka_unit_test(small_integers_are_exact),
        cmocka_unit_test(fixed_point_rounds_and_saturates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
