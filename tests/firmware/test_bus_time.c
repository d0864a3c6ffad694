// SPDX-License-Identifier: Apache-2.0
// Tests of the line through pairs of stamps: jitter, drift, losses, outliers, jumps and silence.
#include "tests/firmware/bus_time_bench.h"

/* From the lock on; of 1000 pairs so many are lost and so many off by up to 20 ms. */
static void check_run(uint64_t seed, jitter_t jitter, int count, int per_mille)
{
    bench_t b = locked_bench(seed, jitter);
    for (int i = 0; i < count; i++) {
        const int64_t fate = uniform(&b, 0, 999);
        if (fate < per_mille)
            b.now_us += PERIOD_US;
        else
            pair_off_by(&b, fate < 2 * per_mille ? uniform(&b, -20000, 20000) : 0);
        check_now(&b, seed, 100);
        assert_true(b.time.locked);
    }
    assert_int_equal(b.time.relocks, 0);
}

static void test_an_hour_within_100_us(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        check_run(seed, EXACT, PAIRS_OF_AN_HOUR, 10);
        check_run(seed, LATE_ALIKE, PAIRS_OF_AN_HOUR, 10);
        check_run(seed, EITHER_WAY, PAIRS_OF_AN_HOUR, 10);
    }
}

static void test_many_seeds_around_the_lock(void **state)
{
    (void)state;
    for (uint64_t seed = 1000; seed < 3000; seed++) {
        check_run(seed, LATE_ALIKE, 300, 10);
        check_run(seed, EITHER_WAY, 300, 10);
    }
}

static void test_exact_stamps_leave_two_microseconds(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        bench_t b = locked_bench(seed, EXACT);
        pairs(&b, 300);
        check_now(&b, seed, 2);
        const int64_t rate_ppb = -b.time.rate_q32 * 1000000000 / (INT64_C(1) << 32);
        if (llabs(rate_ppb - b.drift_ppb) > 50)
            fail_msg("seed %llu: drift %d ppb, found %lld", (unsigned long long)seed, b.drift_ppb, (long long)rate_ppb);
    }
}

static void test_two_of_the_first_five_may_be_wrong(void **state)
{
    (void)state;
    for (int n = 0; n < 2 << BUS_TIME_MEDIAN; n++) {
        const int wrong = n / 2, sign = n % 2 == 0 ? 1 : -1;
        if (__builtin_popcount((unsigned)wrong) > 2)
            continue;
        bench_t b = new_bench((uint64_t)wrong + 1, EXACT);
        for (int i = 0; i < BUS_TIME_MEDIAN; i++)
            pair_off_by(&b, (wrong >> i & 1) == 0 ? 0 : sign * 20000);
        assert_true(b.time.known);
        if (error_at(&b, b.now_us) > 50)
            fail_msg("pairs %#x wrong: %lld us off", (unsigned)wrong, (long long)error_at(&b, b.now_us));
    }
}

static void test_three_strays_do_not_count_and_four_are_a_jump(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        bench_t b = locked_bench(seed, LATE_ALIKE);
        for (int i = 1; i < BUS_TIME_STEP_PAIRS; i++)
            pair_off_by(&b, 5000);
        check_now(&b, seed, 100);
        assert_true(b.time.locked);
        pairs(&b, 1);
        for (int i = 0; i < BUS_TIME_STEP_PAIRS; i++)
            pair_off_by(&b, -5000);
        assert_false(b.time.locked);
        assert_int_equal(bus_time_error_us(&b.time, local_at(&b, b.now_us)), UINT32_MAX);
        b.now_us -= 5000; /* the master's clock from here on */
        b.offset_us += 5000;
        assert_int_equal(b.time.relocks, 0);
        pairs(&b, BUS_TIME_MEDIAN);
        assert_int_equal(b.time.relocks, 1);
        assert_true(pairs_until_lock(&b) <= LOCK_LATE_ALIKE);
        check_now(&b, seed, 100);
    }
}

static void test_silence_is_held_over(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        bench_t b = locked_bench(seed, LATE_ALIKE);
        pairs(&b, 256);
        for (int second = 0; second < 10; second++) {
            b.now_us += 1000000;
            check_now(&b, seed, 100);
        }
        b.now_us += MINUTE_US / 2;
        check_now(&b, seed, 200);
        pairs(&b, 1);
        assert_int_equal(b.time.relocks, 0);
        pairs(&b, 256);
        check_now(&b, seed, 100);
        assert_true(b.time.locked);

        b.now_us += INT64_C(60) * MINUTE_US;
        check_now(&b, seed, 60 * 60 * 10);
        pairs(&b, 1);
        assert_false(b.time.locked);
        assert_true(pairs_until_lock(&b) <= LOCK_LATE_ALIKE);
        assert_int_equal(b.time.relocks, 1);
        check_now(&b, seed, 100);
    }
}

/* A board that warms up by 100 ppm at once, which none does: it is not far off, and soon as right as before. */
static void test_a_rate_that_changes_is_followed(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        bench_t b = locked_bench(seed, LATE_ALIKE);
        pairs(&b, 256);
        const int64_t before_us = local_at(&b, b.now_us);
        b.drift_ppb += 100000;
        b.offset_us += before_us - local_at(&b, b.now_us);
        int64_t worst_us = 0;
        for (int i = 0; i < 400; i++) {
            pairs(&b, 1);
            const int64_t error_us = error_at(&b, b.now_us);
            worst_us = error_us > worst_us ? error_us : worst_us;
        }
        if (worst_us > 450)
            fail_msg("seed %llu: %lld us off", (unsigned long long)seed, (long long)worst_us);
        check_now(&b, seed, 100);
        assert_int_equal(b.time.relocks, 0);
    }
}

static void test_a_clock_that_is_no_crystals_is_never_locked(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        bench_t b = new_bench(seed, LATE_ALIKE);
        b.drift_ppb = seed % 2 == 0 ? 1500000 : -1500000;
        for (int i = 0; i < 2000; i++) {
            pairs(&b, 1);
            assert_false(b.time.locked);
            assert_true(llabs(b.time.rate_q32) <= INT64_C(500) * 4295);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_hour_within_100_us),
        cmocka_unit_test(test_many_seeds_around_the_lock),
        cmocka_unit_test(test_exact_stamps_leave_two_microseconds),
        cmocka_unit_test(test_two_of_the_first_five_may_be_wrong),
        cmocka_unit_test(test_three_strays_do_not_count_and_four_are_a_jump),
        cmocka_unit_test(test_silence_is_held_over),
        cmocka_unit_test(test_a_rate_that_changes_is_followed),
        cmocka_unit_test(test_a_clock_that_is_no_crystals_is_never_locked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
