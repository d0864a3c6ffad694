// SPDX-License-Identifier: Apache-2.0
// Tests of the loop body: its states over virtual time, and what a lost camera does to them.
#include "tests/firmware/projector_bench.h"

#include <stdlib.h>

static void test_waits_for_the_first_pose_with_the_safe_picture(void **state)
{
    (void)state;
    room_bench_run(&bench, 700);
    assert_int_equal(report()->state, CAN_BOARD_WAITING);
    assert_false(report()->corrected);
    assert_true(room_bench_is_safe_picture(&bench, 0, "no pose yet"));
    assert_true(room_bench_is_safe_picture(&bench, 1, "no pose yet"));
    assert_int_equal(bench.voice[0].heartbeats, 2);
    assert_int_equal(bench.voice[0].heartbeat.state, CAN_BOARD_WAITING);
    assert_int_equal(bench.voice[1].heartbeat.node, 12);

    bench.tracking = true;
    room_bench_step(&bench);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(report()->corrected);
    assert_null(room_bench_safe_reason(&bench, 0));
    assert_true(report()->warp.lit_pixels > 0);
}

static void test_loss_of_poses_is_held_then_made_safe_then_ended_at_once(void **state)
{
    (void)state;
    start_running();
    bench.tracking = false;
    const uint8_t last = report()->pose_counter;
    const int64_t received_us = projector()->poses.received_us;
    bool held = false, safe = false;
    for (int i = 0; i < 2 * ROOM_BENCH_HZ; i++) {
        const int64_t age_us = room_bench_now_us(&bench) - received_us;
        room_bench_step(&bench);
        const can_board_state_t expected = age_us > 1000000  ? CAN_BOARD_SAFE
                                           : age_us > 100000 ? CAN_BOARD_HOLDING
                                                             : CAN_BOARD_RUNNING;
        assert_int_equal(report()->state, expected);
        assert_int_equal(report()->corrected, expected != CAN_BOARD_SAFE);
        assert_int_equal(room_bench_is_safe_picture(&bench, 0, "no pose"), expected == CAN_BOARD_SAFE);
        assert_int_equal(report()->pose_counter, last);
        held |= expected == CAN_BOARD_HOLDING;
        safe |= expected == CAN_BOARD_SAFE;
    }
    assert_true(held && safe);
    bench.tracking = true;
    room_bench_step(&bench);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_well_again();
    assert_int_equal(bench.voice[0].states_ever,
                     1U << CAN_BOARD_RUNNING | 1U << CAN_BOARD_HOLDING | 1U << CAN_BOARD_SAFE);
}

static void test_camera_unplugged_keeps_the_last_picture_then_goes_safe(void **state)
{
    (void)state;
    start_running();
    sim_camera_faults(devices()->camera)->unplugged_until_us = INT64_MAX;
    room_bench_run(&bench, 900);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(report()->corrected);
    assert_true(projector()->faults.camera > 0);
    room_bench_run(&bench, 1000);
    assert_int_equal(report()->state, CAN_BOARD_FAULT);
    assert_false(report()->corrected);
    assert_true(room_bench_is_safe_picture(&bench, 0, "no video"));
    assert_null(room_bench_safe_reason(&bench, 1));
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_CAMERA);
    assert_int_equal(bench.voice[0].heartbeat.state, CAN_BOARD_FAULT);
    assert_int_equal(bench.voice[1].heartbeat.fault_flags, 0);
    sim_camera_faults(devices()->camera)->unplugged_until_us = 0;
    assert_well_again();
}

/* Though the method does not need it. Poses of a tenth of a second may come after the last status. */
static void test_the_status_tells_the_step(void **state)
{
    (void)state;
    start_running();
    assert_false(projector()->warp.step_known);
    const int32_t step_q8 = footprint_step(&projector()->warp.homography).in_q16 >> 8;
    assert_true(step_q8 > 64);
    assert_in_range(bench.voice[0].status.step_q8, step_q8 - step_q8 / 20, step_q8 + step_q8 / 20);
}

static void test_pictures_of_a_wrong_size_are_counted_and_not_shown(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    video_t *video = video_open("pattern", 64, 36, error);
    const sim_camera_settings_t settings = {.video = video, .width = 64, .height = 36, .rate = {0, 30, 1}};
    hal_board_t board = *devices();
    board.camera = sim_camera_create(&settings, error);
    assert_string_equal(error, "");
    projector_t *other = calloc(1, sizeof *other);
    assert_non_null(other);
    projector_init(other, &bench.room, &bench.room.board[0], &board, &warp_kernels_scalar);
    bench.tracking = true;
    for (int i = 0; i < 90; i++) {
        room_bench_advance(&bench);
        assert_true(sim_camera_advance(board.camera, room_bench_now_us(&bench), error));
        projector_step(other);
        bench.step++;
    }
    assert_true(other->faults.picture_size > 40);
    assert_false(other->choice.now.any);
    assert_int_equal(other->report.state, CAN_BOARD_FAULT);
    assert_true(room_bench_is_safe_picture(&bench, 0, "no video"));
    free(other);
    sim_camera_destroy(board.camera);
    video_close(video);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_waits_for_the_first_pose_with_the_safe_picture, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_loss_of_poses_is_held_then_made_safe_then_ended_at_once, open_bench,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_camera_unplugged_keeps_the_last_picture_then_goes_safe, open_bench,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_the_status_tells_the_step, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(test_pictures_of_a_wrong_size_are_counted_and_not_shown, open_bench,
                                        close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
