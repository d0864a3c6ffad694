// SPDX-License-Identifier: Apache-2.0
// Tests of the tracker's clock: jitter is taken off, drift is followed, jumps begin anew.
#include "sim/trackers/tracker_clock.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/rng.h"

static void test_the_first_packet_is_taken_as_it_comes(void **state)
{
    (void)state;
    tracker_clock_t clock = {.running = false};
    assert_int_equal(tracker_clock_local_us(&clock, 100, 5000), 5000);
    assert_int_equal(tracker_clock_local_us(&clock, 1100, 6400), 6000); /* 400 us late */
    assert_int_equal(tracker_clock_local_us(&clock, 2100, 6800), 6800); /* 200 us earlier than the first */
    assert_int_equal(tracker_clock_local_us(&clock, 3100, 9000), 7800);
}

/* 200 Hz for 120 s, 0.5 to 3 ms on the way: never later than the arrival, and right within what is lost while two spans
 * pass (1 ms), less the 0.5 ms that every packet takes. */
static void check_drift(int64_t ppm, uint64_t seed)
{
    rng_t rng = {seed};
    tracker_clock_t clock = {.running = false};
    for (int64_t n = 0; n < 200 * 120; n++) {
        const int64_t true_us = 1000000 + n * 5000;
        const int64_t tracker_us = INT64_C(1718806554000000) + n * 5000 + n * 5000 * ppm / 1000000;
        const int64_t arrived_us = true_us + 500 + (int64_t)(rng_next(&rng) % 2501);
        const int64_t found_us = tracker_clock_local_us(&clock, tracker_us, arrived_us);
        assert_true(found_us <= arrived_us);
        if (n >= 200 && llabs(found_us - true_us - 500) > 1100)
            fail_msg("%lld ppm, seed %llu, packet %lld: %lld us off", (long long)ppm, (unsigned long long)seed,
                     (long long)n, (long long)(found_us - true_us - 500));
    }
}

static void test_drift_and_jitter(void **state)
{
    (void)state;
    check_drift(0, 76);
    check_drift(100, 77);
    check_drift(-100, 78);
}

static void test_jumps_begin_anew(void **state)
{
    (void)state;
    tracker_clock_t clock = {.running = false};
    const int64_t day_us = INT64_C(86400000000);
    tracker_clock_local_us(&clock, day_us - 5000, 1000000);
    assert_int_equal(tracker_clock_local_us(&clock, 0, 1005500), 1005500); /* midnight */
    assert_int_equal(tracker_clock_local_us(&clock, 5000, 1012000), 1010500);
    assert_int_equal(tracker_clock_local_us(&clock, day_us, 1015000), 1015000);
    assert_int_equal(tracker_clock_local_us(&clock, INT64_C(1) << 60, 1016000), 1016000);
    assert_int_equal(tracker_clock_local_us(&clock, 0, 1017000), 1017000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_packet_is_taken_as_it_comes),
        cmocka_unit_test(test_drift_and_jitter),
        cmocka_unit_test(test_jumps_begin_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
