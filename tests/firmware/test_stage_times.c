// SPDX-License-Identifier: Apache-2.0
// Tests of the stages' times: means and worst values, and as the boards report them on the bus.
#include "tests/firmware/projector_bench.h"

#include "firmware/stage_times.h"

static void test_means_and_worst_are_of_the_steps_since_the_last_close(void **state)
{
    (void)state;
    stage_times_t times;
    stage_times_init(&times);
    stage_times_add(&times, &(stage_step_t){.us = {100, 8000, 50, 8000}, .shown = true});
    stage_times_add(&times, &(stage_step_t){.us = {101, 17000, 40, 0}, .shown = true, .late = true});
    stage_times_add(&times, &(stage_step_t){.us = {0, 0, 0, 1}});
    const stage_figures_t expected = {
        .mean_us = {67, 8333, 30, 2667}, .worst_us = {101, 17000, 50, 8000}, .shown = 2, .late = 1};
    stage_figures_t figures = stage_times_close(&times);
    assert_memory_equal(&figures, &expected, sizeof figures);
    stage_times_add(&times, &(stage_step_t){.us = {1, 2, 3, 4}});
    figures = stage_times_close(&times);
    assert_memory_equal(&figures, &((stage_figures_t){.mean_us = {1, 2, 3, 4}, .worst_us = {1, 2, 3, 4}}),
                        sizeof figures);
    figures = stage_times_close(&times);
    assert_memory_equal(&figures, &((stage_figures_t){.shown = 0}), sizeof figures);
}

static void test_times_out_of_range_are_cut(void **state)
{
    (void)state;
    stage_times_t times;
    stage_times_init(&times);
    stage_times_add(&times, &(stage_step_t){.us = {-1, INT64_MIN, 3600000001, INT64_MAX}});
    const stage_figures_t figures = stage_times_close(&times);
    const uint32_t expected[STAGES] = {0, 0, 3600000000, 3600000000};
    assert_memory_equal(figures.mean_us, expected, sizeof expected);
    assert_memory_equal(figures.worst_us, expected, sizeof expected);
}

static void test_the_bus_hears_every_stage_once_a_second(void **state)
{
    (void)state;
    sim_display_faults(devices()->display)->drawing_us = 9000;
    start_running();
    room_bench_run(&bench, 2000);
    const room_bench_voice_t *voice = &bench.voice[0];
    assert_in_range(voice->stages, 7, 9); /* 3.2 s, of which the first is counted only */
    for (int stage = 0; stage < STAGES; stage++) {
        assert_int_equal(voice->stage[stage].stage, stage);
        assert_in_range(voice->stage[stage].shown, 59, 61);
        assert_int_equal(voice->stage[stage].late, 0);
    }
    assert_int_equal(voice->stage[STAGE_POSE].worst_us, 0);
    assert_int_equal(voice->stage[STAGE_WARP].mean_us, 9000);
    assert_int_equal(voice->stage[STAGE_WARP].worst_us, 9000);
    assert_int_equal(voice->stage[STAGE_SHOW].worst_us, 0);
    assert_in_range(voice->stage[STAGE_WAIT].mean_us, 7665, 7667);
    assert_int_equal(bench.voice[1].stage[STAGE_WARP].worst_us, 0);
    assert_int_equal(voice->status.warp_time_us, 9000);
}

static void test_a_late_picture_is_counted_and_told(void **state)
{
    (void)state;
    start_running();
    const uint32_t frames = report()->frame_number;
    sim_display_faults(devices()->display)->drawing_us = 20000;
    room_bench_step(&bench);
    assert_true(report()->times.late);
    assert_int_equal(report()->times.us[STAGE_WARP], 20000);
    sim_display_faults(devices()->display)->drawing_us = 0;
    room_bench_step(&bench); /* still at work */
    assert_int_equal(report()->frame_number, frames + 1);
    assert_int_equal(room_bench_report(&bench, 1)->frame_number, frames + 2);
    room_bench_step(&bench);
    assert_int_equal(report()->frame_number, frames + 2);
    assert_false(report()->times.late);
    assert_in_range(report()->times.us[STAGE_WAIT], 13332, 13334);
    assert_int_equal(projector()->faults.deadline, 1);
    room_bench_run(&bench, 900);
    assert_true(bench.voice[0].flags_ever & CAN_FAULT_DEADLINE);
    bench.voice[0].stages = 0;
    for (int i = 0; i < 60 && bench.voice[0].stage[STAGE_WARP].late == 0; i++)
        room_bench_step(&bench);
    assert_int_equal(bench.voice[0].stage[STAGE_WARP].late, 1);
    assert_int_equal(bench.voice[0].stage[STAGE_WARP].worst_us, 20000);
    assert_well_again();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_means_and_worst_are_of_the_steps_since_the_last_close),
        cmocka_unit_test(test_times_out_of_range_are_cut),
        cmocka_unit_test_setup_teardown(test_the_bus_hears_every_stage_once_a_second, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_a_late_picture_is_counted_and_told, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
