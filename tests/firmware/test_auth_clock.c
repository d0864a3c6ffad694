// SPDX-License-Identifier: Apache-2.0
// Tests of the least that bus time can be.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/auth_clock.h"
#include "tests/support/rng.h"

static const int64_t hour_us = 3600000000;

static void test_later_messages_move_it(void **state)
{
    (void)state;
    auth_clock_t clock = {.bus_us = 5000000, .local_us = 100};
    assert_int_equal(auth_clock_least_us(&clock, 100), 5000000);
    auth_clock_hear(&clock, 4000000, 1000100); /* made long ago */
    assert_in_range(auth_clock_least_us(&clock, 1000100), 5998900, 5999500);
    auth_clock_hear(&clock, 6000000, 1000100);
    assert_int_equal(auth_clock_least_us(&clock, 1000100), 6000000);
    assert_int_equal(auth_clock_least_us(&clock, 1000090), 5999990); /* a frame stamped before */
    assert_int_equal(auth_clock_least_us(&(auth_clock_t){.bus_us = 5, .local_us = 100}, 50), 0);
}

/* Whatever the clocks do, it is never more than bus time, and with messages little less. */
static void test_it_is_never_too_much(void **state)
{
    (void)state;
    rng_t random = {3};
    for (int t = 0; t < 200; t++) {
        const double rate = 1.0 + (rng_unit(&random) - 0.5) * 2.0 * AUTH_CLOCK_MAX_PPM / 1e6;
        const double offset = rng_unit(&random) * 1e12;
        double bus = offset;
        auth_clock_t clock = {.bus_us = (uint64_t)bus};
        for (int64_t local_us = 0; local_us < hour_us; local_us += 1 + (int64_t)(rng_unit(&random) * 2e8)) {
            bus = offset + (double)local_us * rate;
            const uint64_t least = auth_clock_least_us(&clock, local_us);
            if ((double)least > bus + 1)
                fail_msg("round %d, rate %.7f: %.0f after %.0f", t, rate, (double)least, bus);
            auth_clock_hear(&clock, (uint64_t)(bus - rng_unit(&random) * 3000), local_us); /* up to 3 ms late */
            if ((double)auth_clock_least_us(&clock, local_us) < bus - 3001)
                fail_msg("round %d, rate %.7f: more than 3 ms too little at %.0f", t, rate, bus);
        }
    }
}

static void test_a_silence_widens_the_window_ahead(void **state)
{
    (void)state;
    const auth_clock_t clock = {.bus_us = 1000000, .local_us = 0};
    const can_auth_window_t now = auth_clock_window(&clock, 0), later = auth_clock_window(&clock, hour_us);
    assert_int_equal(now.past_us, AUTH_CLOCK_PAST_US);
    assert_int_equal(now.future_us, AUTH_CLOCK_AHEAD_US);
    const double most_us = 1e6 + (double)hour_us * (1 + AUTH_CLOCK_MAX_PPM / 1e6);
    assert_true((double)(later.now_us + later.future_us) >= most_us);
    assert_true((double)(later.now_us + later.future_us) <= most_us + 2 * AUTH_CLOCK_AHEAD_US);
}

/* A message that is stamped too early does not make later ones old: once bus time is known to a tenth of a second, no
 * more than that is believed. */
static void test_an_early_stamp_does_no_harm(void **state)
{
    (void)state;
    auth_clock_t clock;
    auth_clock_begin(&clock, 1000000, 0);
    assert_int_equal(auth_clock_window(&clock, 0).future_us, AUTH_CLOCK_FIRST_US);
    auth_clock_hear(&clock, 1000000, 0);
    const can_auth_window_t window = auth_clock_window(&clock, 0);
    assert_int_equal(window.future_us, AUTH_CLOCK_AHEAD_US);
    auth_clock_hear(&clock, window.now_us + window.future_us, 0); /* the most that is believed */
    assert_true(auth_clock_window(&clock, 1000).now_us - AUTH_CLOCK_PAST_US <= 1001000);
}

static void test_signed_is_bus_time_where_it_can_be(void **state)
{
    (void)state;
    const auth_clock_t clock = {.bus_us = 9000000, .local_us = 0};
    assert_int_equal(auth_clock_sign_us(&clock, 9000300, 0), 9000300);
    assert_int_equal(auth_clock_sign_us(&clock, 8999999, 0), 9000000);
    assert_int_equal(auth_clock_sign_us(&clock, -5, 0), 9000000);
    assert_int_equal(auth_clock_sign_us(&clock, 9000000 + AUTH_CLOCK_AHEAD_US + 1, 0), 9000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_later_messages_move_it),
        cmocka_unit_test(test_it_is_never_too_much),
        cmocka_unit_test(test_a_silence_widens_the_window_ahead),
        cmocka_unit_test(test_an_early_stamp_does_no_harm),
        cmocka_unit_test(test_signed_is_bus_time_where_it_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
