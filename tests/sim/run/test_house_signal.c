// SPDX-License-Identifier: Apache-2.0
// Tests of a run's house signal: when its edges are, who has them, and that the board that leads follows them.
#include "sim/run/house_signal.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "hal/hal_gpio.h"
#include "tests/support/room_bench.h"

enum { PERIODS = 12, LONG_US = 200000, WITHIN_US = 1000, FRONT = 5, BACK = 12 /* nodes */ };

static const sim_rate_t refresh = {1000000 / (2 * ROOM_BENCH_HZ), ROOM_BENCH_HZ, 1};

/* @return Edges at a board's input; the newest is then at *time_us. */
static int take_edges(const room_bench_t *bench, int board, int64_t *time_us)
{
    int edges = 0;
    while (hal_gpio_take_edge(sim_world_devices(bench->world, board)->gpio, HAL_GPIO_GENLOCK, time_us) == HAL_OK)
        edges++;
    return edges;
}

static void test_edges_are_at_the_refresh_rate_or_faster(void **state)
{
    (void)state;
    static const struct {
        int32_t ppm, node;
        int edges[2];
        int64_t newest_us; /* 8333 + 200000 less what ppm takes off */
    } expected[] = {
        {0, 0, {PERIODS + 1, PERIODS + 1}, 208333},
        {1000, 0, {PERIODS + 1, PERIODS + 1}, 208134},
        {-1000, 0, {PERIODS, PERIODS}, 191850},
        {0, BACK, {0, PERIODS + 1}, 208333},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        room_bench_t bench;
        room_bench_open(&bench, true);
        house_signal_t house = {.options = {true, expected[i].ppm, expected[i].node}, .refresh = refresh};
        for (int64_t now_us = 0; now_us <= refresh.start_us + LONG_US; now_us++)
            house_signal_advance(&house, bench.world, &bench.room, now_us);
        for (int board = 0; board < 2; board++) {
            int64_t newest_us = 0;
            assert_int_equal(take_edges(&bench, board, &newest_us), expected[i].edges[board]);
            if (expected[i].edges[board] > 0)
                assert_in_range(newest_us, expected[i].newest_us - 1, expected[i].newest_us + 1);
        }
        room_bench_close(&bench);
    }
}

static void test_without_the_option_there_are_none(void **state)
{
    (void)state;
    room_bench_t bench;
    int64_t newest_us;
    room_bench_open(&bench, true);
    house_signal_t house = {.refresh = refresh};
    house_signal_advance(&house, bench.world, &bench.room, LONG_US);
    assert_int_equal(take_edges(&bench, 0, &newest_us), 0);
    room_bench_close(&bench);
}

/* Every frame of so many seconds. @return The newest; *most_us: the farthest edge of the last half. */
static run_frame_t play(const house_signal_options_t *options, int seconds, int32_t *most_us)
{
    room_bench_t bench;
    room_bench_open(&bench, true);
    house_signal_t house = {.options = *options, .refresh = refresh};
    run_frame_t frame = {.time_us = 0};
    *most_us = 0;
    for (int n = 0; n < seconds * ROOM_BENCH_HZ; n++) {
        house_signal_advance(&house, bench.world, &bench.room, room_bench_now_us(&bench));
        room_bench_step(&bench);
        frame = (run_frame_t){.time_us = 0};
        house_signal_note(&frame, bench.world, &bench.room);
        const int32_t size_us = frame.house_off_us < 0 ? -frame.house_off_us : frame.house_off_us;
        if (n > seconds * ROOM_BENCH_HZ / 2 && size_us > *most_us)
            *most_us = size_us;
    }
    room_bench_close(&bench);
    return frame;
}

/* 200 ppm are 4 ms in 20 s. */
static void test_who_leads_follows_the_house(void **state)
{
    (void)state;
    int32_t most_us;
    const run_frame_t frame = play(&(house_signal_options_t){true, 200, FRONT}, 20, &most_us);
    assert_true(frame.leader == FRONT && frame.housed);
    assert_in_range(most_us, 100, WITHIN_US);
}

static void test_a_house_signal_that_the_leader_lacks_is_seen(void **state)
{
    (void)state;
    int32_t most_us;
    const run_frame_t frame = play(&(house_signal_options_t){true, 200, BACK}, 5, &most_us);
    assert_true(frame.leader == FRONT && !frame.housed);
    assert_int_equal(most_us, 0);
}

static void test_sums_over_a_run(void **state)
{
    (void)state;
    run_record_t record = {.boards = 1};
    assert_int_equal(run_record_house(&record).leader, 0);
    for (int n = 0; n < 4; n++)
        assert_true(run_record_add_frame(&record));
    record.frame[1].leader = record.frame[2].leader = 5;
    record.frame[3].leader = 3;
    record.frame[1].housed = record.frame[2].housed = true;
    record.frame[1].house_off_us = -300;
    record.frame[2].house_off_us = 100;
    const run_house_t house = run_record_house(&record);
    assert_int_equal(house.leader, 3);
    assert_int_equal(house.frames, 2);
    assert_int_equal(house.off_us_most, 300);
    assert_true(house.off_us_mean > 199.9 && house.off_us_mean < 200.1);
    run_record_free(&record);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edges_are_at_the_refresh_rate_or_faster),
        cmocka_unit_test(test_without_the_option_there_are_none),
        cmocka_unit_test(test_who_leads_follows_the_house),
        cmocka_unit_test(test_a_house_signal_that_the_leader_lacks_is_seen),
        cmocka_unit_test(test_sums_over_a_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
