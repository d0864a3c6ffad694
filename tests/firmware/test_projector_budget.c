// SPDX-License-Identifier: Apache-2.0
// Tests of a board that becomes slow: it takes cheaper methods before a picture is late, says so, and comes back.
#include "tests/firmware/projector_bench.h"

enum { PERIOD_US = 1000000 / ROOM_BENCH_HZ };

static const pose_t still = {.quaternion_q30 = {1 << 30, 0, 0, 0}};

/* What this board takes for a method at that pose: not quite what the firmware's model has. */
static int64_t drawing_us(warp_resampler_t resampler, int32_t load_percent)
{
    static const int32_t us[] = {
        [WARP_NEAREST] = 3200, [WARP_LINEAR] = 4400, [WARP_AREA] = 6300, [WARP_MEAN_CUBIC] = 9000};
    return (int64_t)us[resampler] * load_percent / 100;
}

static void step_at(int32_t load_percent)
{
    const warp_resampler_t resampler = projector()->warp.method.resampler;
    sim_display_faults(devices()->display)->drawing_us = (uint32_t)drawing_us(resampler, load_percent);
    room_bench_step(&bench);
}

static void run_at(int32_t load_percent, int seconds)
{
    for (int i = 0; i < seconds * ROOM_BENCH_HZ; i++)
        step_at(load_percent);
}

static void test_a_board_that_gets_hot_degrades_in_time_and_comes_back(void **state)
{
    (void)state;
    bench.pose = &still;
    start_running();
    run_at(100, 2);
    assert_int_equal(bench.voice[0].quality.step, 0);
    assert_int_equal(bench.voice[0].quality.resampler, WARP_MEAN_CUBIC);
    assert_in_range(bench.voice[0].quality.wanted_us, 8990, 9010);
    assert_int_equal(bench.voice[0].quality.hold_s, DEGRADE_MIN_HOLD_S);

    const uint32_t frames = report()->frame_number;
    uint32_t ever = 0; /* resamplers used */
    for (int n = 0; n < 1200; n++) {
        step_at(100 + n / 4); /* four times as slow within 20 s */
        assert_true(report()->corrected);
        ever |= 1U << report()->warp.resampler;
    }
    assert_int_equal(report()->frame_number - frames, 1200);
    assert_int_equal(projector()->faults.deadline, 0);
    assert_int_equal(ever, 1U << WARP_MEAN_CUBIC | 1U << WARP_AREA | 1U << WARP_LINEAR | 1U << WARP_NEAREST);
    run_at(400, 2);
    assert_int_equal(bench.voice[0].quality.step, 3);
    assert_int_equal(bench.voice[0].quality.filter, WARP_FILTER_NONE);
    assert_int_equal(bench.voice[0].quality.resampler, WARP_NEAREST);
    assert_int_equal(bench.voice[0].quality.changes, 3);
    assert_true(bench.voice[0].quality.wanted_us > PERIOD_US);
    assert_int_equal(bench.voice[1].quality.step, 0);

    run_at(100, 12);
    assert_int_equal(bench.voice[0].quality.step, 0);
    assert_int_equal(report()->warp.resampler, WARP_MEAN_CUBIC);
    assert_in_range(bench.voice[0].quality.changes, 4, 5);
    assert_int_equal(projector()->faults.deadline, 0);
    assert_int_equal(bench.voice[0].flags_ever, 0);
    assert_well_again();
}

static void test_a_sudden_load_costs_two_pictures_and_no_state(void **state)
{
    (void)state;
    bench.pose = &still;
    start_running();
    run_at(100, 1);
    run_at(250, 3);
    assert_int_equal(projector()->faults.deadline, 2);
    assert_int_equal(report()->warp.resampler, WARP_LINEAR);
    assert_int_equal(projector()->degrade.changes, 1);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_DEADLINE);
    assert_int_equal(bench.voice[0].states_ever & (1U << CAN_BOARD_SAFE | 1U << CAN_BOARD_FAULT), 0);
    run_at(100, 6);
    assert_int_equal(report()->warp.resampler, WARP_MEAN_CUBIC);
    assert_int_equal(projector()->degrade.changes, 2);
    assert_well_again();
}

/* The safe picture says nothing of what a method takes. */
static void test_the_safe_picture_is_not_judged(void **state)
{
    (void)state;
    for (int n = 0; n < 600; n++) {
        sim_display_faults(devices()->display)->drawing_us = 3 * PERIOD_US;
        room_bench_step(&bench);
    }
    assert_int_equal(report()->state, CAN_BOARD_WAITING);
    assert_true(projector()->faults.deadline > 100);
    assert_int_equal(projector()->degrade.frames, 0);
    assert_int_equal(projector()->degrade.step, 0);
}

/* All of the time is spent on a few pixels: it says nothing of frames with many. */
static void test_a_nearly_dark_wall_is_not_judged(void **state)
{
    (void)state;
    static const pose_t turned_away = {.quaternion_q30 = {0, 0, 1 << 30, 0}};
    bench.pose = &still;
    start_running();
    run_at(100, 1);
    bench.pose = &turned_away;
    run_at(300, 1);
    assert_true(report()->corrected);
    assert_int_equal(report()->warp.lit_pixels, 0);
    assert_int_equal(projector()->degrade.changes, 0);
    bench.pose = &still;
    run_at(100, 2);
    assert_int_equal(projector()->degrade.changes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_board_that_gets_hot_degrades_in_time_and_comes_back, open_bench,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_a_sudden_load_costs_two_pictures_and_no_state, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_the_safe_picture_is_not_judged, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_nearly_dark_wall_is_not_judged, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
