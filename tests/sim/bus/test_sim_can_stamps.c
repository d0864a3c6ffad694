// SPDX-License-Identifier: Apache-2.0
// Tests of how a simulated controller stamps frames: on its own clock, late by chance; and of own frames handed back.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/bus_bench.h"

enum { JITTER_US = 200, FRAMES = 3000 };

static int64_t twice_and_ten(void *context, int64_t time_us)
{
    const int64_t *factor = context;
    return time_us * *factor + 10;
}

static int64_t sent_at_us; /* end of the newest frame on the wire */
static int logged;

static void note(void *context, int sender, const hal_can_frame_t *frame)
{
    (void)context;
    (void)sender;
    assert_false(frame->own);
    sent_at_us = frame->time_us;
    logged++;
}

static void test_an_own_frame_comes_back_when_asked_for(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    hal_can_frame_t frame = {.id = 5, .length = 2, .data = {7, 9}}, heard;
    logged = 0;
    sim_bus_set_log(bench.bus, note, NULL);
    assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(hal_can_receive(bench.a, &heard), HAL_EMPTY);
    assert_int_equal(bus_bench_count_heard(bench.b), 1);

    frame.own = true;
    frame.data[0] = 8;
    assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
    assert_int_equal(hal_can_receive(bench.a, &heard), HAL_EMPTY);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(hal_can_receive(bench.a, &heard), HAL_OK);
    assert_true(heard.own && heard.id == 5 && heard.length == 2 && heard.data[0] == 8 && heard.data[1] == 9);
    assert_int_equal(heard.time_us, sent_at_us);
    assert_int_equal(hal_can_receive(bench.b, &heard), HAL_OK);
    assert_false(heard.own);
    assert_int_equal(heard.time_us, sent_at_us);
    assert_int_equal(logged, 2);
    sim_bus_destroy(bench.bus);
}

static void test_an_own_frame_that_never_gets_out_does_not_come_back(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    const hal_can_frame_t frame = {.id = 5, .own = true, .length = 2};
    hal_can_frame_t heard;
    assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
    sim_bus_fail_bus_off(bench.a);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(hal_can_restart(bench.a), HAL_OK);
    bus_bench_run_for(&bench, 10000);
    assert_int_equal(hal_can_receive(bench.a, &heard), HAL_EMPTY);

    /* one destroyed on the wire is sent again, and comes back once */
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 1});
    assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
    bus_bench_run_for(&bench, 2000);
    assert_int_equal(bus_bench_count_heard(bench.a), 1);
    sim_bus_destroy(bench.bus);
}

static void test_stamps_are_on_the_controllers_clock(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    const hal_can_frame_t frame = {.id = 5, .own = true, .length = 2};
    int64_t factor = 2;
    hal_can_frame_t heard;
    sim_bus_set_log(bench.bus, note, NULL);
    sim_can_set_stamps(bench.a, twice_and_ten, &factor, 0);
    assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(hal_can_receive(bench.a, &heard), HAL_OK);
    assert_int_equal(heard.time_us, 2 * sent_at_us + 10);
    assert_int_equal(hal_can_receive(bench.b, &heard), HAL_OK);
    assert_int_equal(heard.time_us, sent_at_us);
    sim_bus_destroy(bench.bus);
}

/* Uniformly late, never by more, never there before its stamp, and each controller by its own chance. */
static void test_jitter(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    const hal_can_frame_t frame = {.id = 5, .own = true, .length = 8};
    int64_t sum_us = 0, most_us = 0, differ = 0;
    sim_bus_set_log(bench.bus, note, NULL);
    sim_can_set_stamps(bench.a, NULL, NULL, JITTER_US);
    sim_can_set_stamps(bench.b, NULL, NULL, JITTER_US);
    for (int i = 0; i < FRAMES; i++) {
        hal_can_frame_t own, heard;
        const int before = logged;
        assert_int_equal(hal_can_send(bench.a, &frame), HAL_OK);
        while (logged == before)
            bus_bench_run_for(&bench, 1);
        int64_t waited_us = 0;
        while (hal_can_receive(bench.b, &heard) == HAL_EMPTY) {
            bus_bench_run_for(&bench, 1);
            waited_us++;
        }
        const int64_t late_us = heard.time_us - sent_at_us;
        assert_true(late_us >= 0 && late_us <= JITTER_US);
        assert_true(heard.time_us <= sim_bus_now_us(bench.bus) && waited_us >= late_us - 1);
        sum_us += late_us;
        most_us = late_us > most_us ? late_us : most_us;
        bus_bench_run_for(&bench, JITTER_US);
        assert_int_equal(hal_can_receive(bench.a, &own), HAL_OK);
        differ += own.time_us != heard.time_us;
        assert_int_equal(bus_bench_count_heard(bench.c), 1);
    }
    assert_true(most_us > JITTER_US - 5);
    assert_true(sum_us > FRAMES * (JITTER_US / 2 - 5) && sum_us < FRAMES * (JITTER_US / 2 + 5));
    assert_true(differ > FRAMES * 9 / 10);
    sim_bus_destroy(bench.bus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_own_frame_comes_back_when_asked_for),
        cmocka_unit_test(test_an_own_frame_that_never_gets_out_does_not_come_back),
        cmocka_unit_test(test_stamps_are_on_the_controllers_clock),
        cmocka_unit_test(test_jitter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
