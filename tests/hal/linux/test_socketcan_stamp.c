// SPDX-License-Identifier: Apache-2.0
// Time stamps on CLOCK_MONOTONIC: from the kernel's while the clock is set, and from a controller's drifting clock.
#include "hal/linux/socketcan_stamp.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/rng.h"

static const int64_t US = 1000, MS = 1000000, S = 1000000000;
static const int64_t HOUR = 3600 * INT64_C(1000000000);
static const int64_t REALTIME = 1700000000 * INT64_C(1000000000); /* less CLOCK_MONOTONIC, before it is set */

/* No frame was waiting 16 ms ago; now is 100 s. */
static socketcan_stamp_t stamp_at_100_s(void)
{
    const int64_t empty = 100 * S - 16 * MS;
    return (socketcan_stamp_t){.empty = {empty, empty + REALTIME}};
}

/* One frame that rose at `at`, stamped and read while CLOCK_REALTIME was that much ahead of what it was before. */
static int64_t read_at_100_s(int64_t at, int64_t ahead_then, int64_t ahead_now)
{
    socketcan_stamp_t stamp = stamp_at_100_s();
    const clock_pair_t now = {100 * S, 100 * S + REALTIME + ahead_now};
    const socketcan_stamps_t of = {.kernel_ns = at + REALTIME + ahead_then};
    return socketcan_stamp_ns(&stamp, &of, &now);
}

static void the_kernels_stamp_is_put_on_the_other_clock(void **state)
{
    (void)state;
    for (int64_t age = 0; age <= 20 * MS; age += 100 * US)
        assert_int_equal(read_at_100_s(100 * S - age, 0, 0), 100 * S - age);
}

static void a_clock_set_far_does_not_hurt(void **state)
{
    (void)state;
    const int64_t steps[] = {HOUR, -HOUR, 5 * S, -5 * S, 30 * MS, -30 * MS, REALTIME, -REALTIME / 2};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        for (int64_t age = 0; age <= 16 * MS; age += 400 * US) {
            assert_int_equal(read_at_100_s(100 * S - age, 0, steps[i]), 100 * S - age);        /* set after the stamp */
            assert_int_equal(read_at_100_s(100 * S - age, steps[i], steps[i]), 100 * S - age); /* and before it */
        }
}

static void a_clock_set_a_little_hurts_only_within_the_interval(void **state)
{
    (void)state;
    for (int64_t step = -40 * MS; step <= 40 * MS; step += MS)
        for (int64_t age = 0; age <= 16 * MS; age += MS) {
            const int64_t time = read_at_100_s(100 * S - age, 0, step);
            assert_in_range(time, 100 * S - 16 * MS - SOCKETCAN_STAMP_QUEUE_NS, 100 * S);
        }
}

static void useless_stamps_are_now(void **state)
{
    (void)state;
    static const int64_t useless[] = {0, -1, INT64_MIN, INT64_MAX};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            socketcan_stamp_t stamp = stamp_at_100_s();
            const clock_pair_t now = {100 * S, 100 * S + REALTIME};
            const socketcan_stamps_t of = {useless[i], useless[j]};
            assert_int_equal(socketcan_stamp_ns(&stamp, &of, &now), 100 * S);
        }
}

static void stamps_never_go_back(void **state)
{
    (void)state;
    socketcan_stamp_t stamp = stamp_at_100_s();
    const clock_pair_t now = {100 * S, 100 * S + REALTIME};
    const socketcan_stamps_t later = {.kernel_ns = 100 * S - MS + REALTIME};
    const socketcan_stamps_t earlier = {.kernel_ns = 100 * S - 2 * MS + REALTIME};
    assert_int_equal(socketcan_stamp_ns(&stamp, &later, &now), 100 * S - MS);
    assert_int_equal(socketcan_stamp_ns(&stamp, &earlier, &now), 100 * S - MS);
}

/* A controller's clock, and the frames that it stamped. */
typedef struct {
    socketcan_stamp_t stamp;
    rng_t rng;
    int64_t now, begun, drift_ppm, error; /* error of the last stamp */
} controller_t;

/* A frame each 4 ms; its latency is 20 us to 2 ms, one in ten of them under 25 us. */
static void hear(controller_t *c)
{
    c->now += 4 * MS;
    const int64_t luck = rng_next(&c->rng) % 10 == 0 ? 5 * US : 2 * MS;
    const int64_t latency = 20 * US + (int64_t)(rng_next(&c->rng) % (uint64_t)luck);
    const int64_t elapsed = c->now - c->begun;
    const socketcan_stamps_t of = {.kernel_ns = c->now + latency + REALTIME,
                                   .controller_ns = 1 + elapsed + elapsed / MS * c->drift_ppm};
    const clock_pair_t now = {c->now + 3 * MS, c->now + 3 * MS + REALTIME};
    c->error = socketcan_stamp_ns(&c->stamp, &of, &now) - c->now;
    c->stamp.empty = now;
    if (c->error < 0 || c->error > latency)
        fail_msg("drift %lld ppm, seed 5: stamped %lld ns after the frame, the kernel %lld ns", (long long)c->drift_ppm,
                 (long long)c->error, (long long)latency);
}

static void a_controllers_clock_is_followed(void **state)
{
    (void)state;
    for (int64_t drift_ppm = -90; drift_ppm <= 90; drift_ppm += 30) {
        controller_t c = {.rng = {5}, .drift_ppm = drift_ppm, .now = 100 * S, .begun = 90 * S};
        int64_t worst = 0;
        for (int i = 0; i < 5000; i++) {
            hear(&c);
            if (i >= 250 && c.error > worst)
                worst = c.error;
        }
        /* 25 us, and 190 ppm of the half second in which one frame in ten is not once lucky with chance 10^-5 */
        if (worst > 25 * US + 95 * US)
            fail_msg("drift %lld ppm, seed 5: off by %lld ns", (long long)drift_ppm, (long long)worst);
    }
}

static void a_controllers_clock_may_begin_anew(void **state)
{
    (void)state;
    controller_t c = {.rng = {6}, .now = 100 * S, .begun = 90 * S};
    for (int i = 0; i < 1000; i++)
        hear(&c);
    c.begun = c.now; /* back by 14 s */
    for (int i = 0; i < 1000; i++)
        hear(&c);
    c.begun = 50 * S; /* ahead */
    for (int i = 0; i < 1000; i++)
        hear(&c);
    assert_true(c.error < 120 * US);
}

static void both_clocks_are_read_together(void **state)
{
    (void)state;
    clock_pair_t before = clock_pair();
    assert_true(before.monotonic_ns > 0 && before.realtime_ns > before.monotonic_ns);
    for (int i = 0; i < 100; i++) {
        const clock_pair_t now = clock_pair();
        assert_true(now.monotonic_ns >= before.monotonic_ns);
        before = now;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_kernels_stamp_is_put_on_the_other_clock),
        cmocka_unit_test(a_clock_set_far_does_not_hurt),
        cmocka_unit_test(a_clock_set_a_little_hurts_only_within_the_interval),
        cmocka_unit_test(useless_stamps_are_now),
        cmocka_unit_test(stamps_never_go_back),
        cmocka_unit_test(a_controllers_clock_is_followed),
        cmocka_unit_test(a_controllers_clock_may_begin_anew),
        cmocka_unit_test(both_clocks_are_read_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
