// SPDX-License-Identifier: Apache-2.0
// Tests of what is read off bus time: capture times, a board's own clock, and any stamps at all.
#include "tests/firmware/bus_time_bench.h"

static void test_old_pairs_are_ignored(void **state)
{
    (void)state;
    bench_t b = locked_bench(1, EXACT);
    const bus_time_t before = b.time;
    bus_time_pair(&b.time, b.time.paired_us, 7);
    bus_time_pair(&b.time, b.time.paired_us - 1, 7);
    assert_memory_equal(&b.time, &before, sizeof before);
}

static void test_an_own_clock_runs_on(void **state)
{
    (void)state;
    bus_time_t time = {.known = false};
    assert_int_equal(bus_time_from_local(&time, 12345), 12345);
    assert_int_equal(bus_time_error_us(&time, 0), UINT32_MAX);
    bus_time_begin(&time, 1000, 500);
    assert_true(time.known && time.locked && time.relocks == 0);
    for (int64_t now_us = 1000; now_us < INT64_C(1) << 46; now_us += INT64_C(3600000000) * 24) {
        bus_time_keep(&time, now_us);
        assert_int_equal(bus_time_from_local(&time, now_us), now_us - 500);
    }
    bus_time_begin(&time, 0, 0);
    assert_int_equal(time.relocks, 1);
}

/* A master that once followed another keeps the rate that it found, for years. */
static void test_a_rate_is_kept(void **state)
{
    (void)state;
    static const int64_t DAY_US = INT64_C(86400000000);
    bench_t b = locked_bench(3, EXACT);
    const int64_t begin_us = b.time.local_us, daily_us = DAY_US * b.time.rate_q32 / (INT64_C(1) << 32);
    const int64_t offset_us = bus_time_from_local(&b.time, begin_us) - begin_us;
    for (int day = 1; day <= 1000; day++) {
        const int64_t now_us = begin_us + day * DAY_US;
        bus_time_keep(&b.time, now_us);
        const int64_t expected_us = now_us + offset_us + day * daily_us;
        assert_true(llabs(bus_time_from_local(&b.time, now_us) - expected_us) <= 2 * day);
    }
}

/* No stamps can make it overflow: run with the sanitizer. */
static void test_any_stamps(void **state)
{
    (void)state;
    rng_t rng = {20240131};
    for (int round = 0; round < 2000; round++) {
        bus_time_t time = {.known = false};
        const int64_t limit_us = INT64_C(1) << (10 + rng_next(&rng) % 41);
        int64_t local_us = -limit_us;
        for (int i = 0; i < 60 && local_us < limit_us; i++) {
            local_us += (int64_t)(rng_next(&rng) % (uint64_t)(limit_us / (1 << rng_next(&rng) % 10)));
            bus_time_pair(&time, local_us, (int64_t)(rng_next(&rng) >> (16 + rng_next(&rng) % 40)));
            (void)bus_time_from_local(&time, local_us);
            assert_true(bus_time_error_us(&time, local_us) > 0);
            assert_true(llabs(time.rate_q32) <= INT64_C(500) * 4295);
        }
    }
}

static void test_capture_times_are_unwrapped_to_the_nearest(void **state)
{
    (void)state;
    static const uint64_t WRAP_US[] = {UINT64_C(1) << 32, 6553600};
    rng_t rng = {7};
    for (int i = 0; i < 100000; i++) {
        const uint64_t wrap_us = WRAP_US[i % 2];
        const int64_t near_us = (int64_t)(rng_next(&rng) % (UINT64_C(1) << 48));
        const int64_t away_us = (int64_t)(rng_next(&rng) % wrap_us) - (int64_t)wrap_us / 2;
        const int64_t moment_us = near_us + away_us;
        if (moment_us >= 0)
            assert_int_equal(bus_time_extend(near_us, (uint64_t)moment_us % wrap_us, wrap_us), moment_us);
    }
    assert_int_equal(bus_time_extend(-3, 6553599, 6553600), -1);
    assert_int_equal(bus_time_extend(-6553599, 6553599, 6553600), -6553601);
    assert_int_equal(bus_time_extend(6553599, 5, 6553600), 6553605);
    assert_int_equal(bus_time_extend(3, 6553590, 6553600), -10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_old_pairs_are_ignored),
        cmocka_unit_test(test_an_own_clock_runs_on),
        cmocka_unit_test(test_a_rate_is_kept),
        cmocka_unit_test(test_any_stamps),
        cmocka_unit_test(test_capture_times_are_unwrapped_to_the_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
