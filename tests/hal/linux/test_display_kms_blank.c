// SPDX-License-Identifier: Apache-2.0
// The next vertical blank: follows the driver's time stamps, whatever the mode says, and survives wrong ones.
#include "hal/linux/display_kms_blank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>

#include "tests/support/rng.h"

static const int64_t NOMINAL_NS = 16666667, START_NS = INT64_C(123456789012345);

static void without_stamps_the_mode_says_it(void **state)
{
    (void)state;
    kms_blank_t blank;
    kms_blank_init(&blank, NOMINAL_NS, START_NS, 5);
    assert_int_equal(kms_blank_after(&blank, START_NS), START_NS + NOMINAL_NS);
    assert_int_equal(kms_blank_after(&blank, START_NS - 1), START_NS);
    assert_int_equal(kms_blank_after(&blank, START_NS + NOMINAL_NS - 1), START_NS + NOMINAL_NS);
    assert_int_equal(kms_blank_after(&blank, START_NS + NOMINAL_NS), START_NS + 2 * NOMINAL_NS);
    assert_int_equal(kms_blank_after(&blank, START_NS + 1000 * NOMINAL_NS + 7), START_NS + 1001 * NOMINAL_NS);
}

/* A pixel clock up to 1 % off, stamps 20 us off, now and then a few blanks without one, numbers that wrap. */
static void a_clock_that_is_off_is_followed(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        rng_t rng = {seed};
        const int64_t period_ns = NOMINAL_NS + (int64_t)(rng_next(&rng) % 320000) - 160000;
        uint32_t number = UINT32_MAX - 100;
        int64_t true_ns = START_NS;
        kms_blank_t blank;
        kms_blank_init(&blank, NOMINAL_NS, true_ns, number);
        for (int i = 0; i < 400; i++) {
            const uint32_t passed = rng_next(&rng) % 8 == 0 ? 3 : 1;
            true_ns += passed * period_ns;
            number += passed;
            kms_blank_add(&blank, true_ns + (int64_t)(rng_next(&rng) % 40001) - 20000, number);
        }
        const int64_t off_ns = kms_blank_after(&blank, true_ns + period_ns / 2) - (true_ns + period_ns);
        if (llabs(off_ns) > 60000)
            fail_msg("seed %d, period %d ns: next blank %d ns off", (int)seed, (int)period_ns, (int)off_ns);
    }
}

static void wrong_stamps_do_not_change_the_period(void **state)
{
    (void)state;
    kms_blank_t blank;
    kms_blank_init(&blank, NOMINAL_NS, START_NS, 5);
    kms_blank_add(&blank, START_NS - 1, 6); /* from before */
    assert_int_equal(kms_blank_after(&blank, START_NS), START_NS + NOMINAL_NS);
    kms_blank_add(&blank, START_NS + 3 * NOMINAL_NS / 2, 6); /* half a period late */
    assert_int_equal(blank.period_ns, NOMINAL_NS);
    assert_int_equal(blank.last_ns, START_NS + 3 * NOMINAL_NS / 2);
    kms_blank_add(&blank, START_NS + 2 * NOMINAL_NS, 6);       /* the same number again */
    kms_blank_add(&blank, START_NS + 90 * NOMINAL_NS, 5);      /* numbers begin anew */
    kms_blank_add(&blank, START_NS + 5000 * NOMINAL_NS, 4905); /* after a long time without */
    assert_int_equal(blank.period_ns, NOMINAL_NS);
    assert_int_equal(kms_blank_after(&blank, START_NS + 5000 * NOMINAL_NS), START_NS + 5001 * NOMINAL_NS);
    kms_blank_add(&blank, INT64_MAX / 2, 4906);
    assert_int_equal(blank.period_ns, NOMINAL_NS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_stamps_the_mode_says_it),
        cmocka_unit_test(a_clock_that_is_off_is_followed),
        cmocka_unit_test(wrong_stamps_do_not_change_the_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
