// SPDX-License-Identifier: Apache-2.0
// A room with a key, in virtual time: who is believed, and that strangers change nothing.
#include "firmware/can_latency.h"
#include "tests/firmware/key_bench.h"

static void test_who_has_the_key_is_believed(void **state)
{
    (void)state;
    key_start_running();
    key_run(6000);
    assert_boards_are(CAN_BOARD_RUNNING);
    assert_refused(0);
    assert_int_equal(k.tracker.auth.teller.told, ROOM_BENCH_BOARDS);
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++) {
        assert_true(key_board(b)->report.agreement.in_step);
        assert_true(key_board(b)->choice.clock.room.board[b == 0 ? 12 : 5].any); /* the other one's Latency */
        assert_int_equal(k.room.voice[b].heartbeat.fault_flags & (CAN_FAULT_REFUSED | CAN_FAULT_SESSION), 0);
        assert_true((k.room.voice[b].flags_ever & CAN_FAULT_SESSION) != 0);
    }
}

static void test_without_a_tracker_nobody_speaks(void **state)
{
    (void)state;
    key_run(3000);
    assert_boards_are(CAN_BOARD_WAITING);
    for (int i = 0; i < k.frames; i++)
        assert_false(k.heard[i].id < CAN_ID_STATUS);
}

static void test_another_key_or_none_is_not(void **state)
{
    (void)state;
    key_track(k.other, 1);
    key_run(3000);
    assert_boards_are(CAN_BOARD_WAITING);
    assert_int_equal(k.tracker.auth.teller.told, 0);
    assert_true(k.tracker.auth.teller.refused > 1);
    assert_true(key_faults(0)->auth_commands > 1);
    key_track(NULL, 0);
    key_run(1000);
    assert_boards_are(CAN_BOARD_WAITING);
    assert_false(key_board(0)->poses.any);
    assert_int_equal(bus_master_state(&key_board(0)->time, room_bench_now_us(&k.room)), CAN_TIME_NONE);
}

static void test_poses_of_strangers_change_nothing(void **state)
{
    (void)state;
    hal_can_frame_t frame[POSE_AUTH_FRAMES];
    key_start_running();
    k.sending = false;
    key_step();
    const int frames = key_sign_pose(frame, k.other, 1, room_bench_now_us(&k.room));
    key_inject(frame, frames);
    key_run(50);
    assert_nobody_far();
    assert_int_equal(key_faults(0)->auth_forged, 1);
    (void)key_sign_pose(frame, k.key, 2, room_bench_now_us(&k.room)); /* of another session */
    key_inject(frame, frames);
    key_run(50);
    assert_nobody_far();
    assert_int_equal(key_faults(1)->auth_forged, 2);
    (void)key_sign_pose(frame, k.key, 1, room_bench_now_us(&k.room));
    const bool fd = k.room.room.fd;
    frame[0].id -= fd ? CAN_AUTH_ID_POSE_FD - CAN_ID_POSE_FD : 0; /* without a code */
    frame[0].length = fd ? CAN_AUTH_FD_PLAIN : frame[0].length;
    for (int i = 0; i <= BUS_AUTH_MOST_UNCODED; i++) {
        key_inject(frame, fd ? 1 : CAN_POSE_PARTS);
        key_step();
    }
    key_inject(frame, fd ? 0 : 1); /* of the next set: the last one has no code and will have none */
    key_run(600);
    assert_nobody_far();
    assert_int_equal(key_faults(0)->auth_unsigned, BUS_AUTH_MOST_UNCODED + 1);
    assert_true((k.room.voice[0].flags_ever & CAN_FAULT_REFUSED) != 0);
}

static void test_repeated_and_late_poses_change_nothing(void **state)
{
    (void)state;
    hal_can_frame_t frame[POSE_AUTH_FRAMES];
    key_start_running();
    k.sending = false;
    key_step();
    const int64_t now_us = room_bench_now_us(&k.room);
    const int frames = key_sign_pose(frame, k.key, 1, now_us - 1000000); /* before what the boards have taken */
    key_inject(frame, frames);
    key_step();
    assert_int_equal(key_faults(0)->auth_replayed, 1);
    (void)key_sign_pose(frame, k.key, 1, now_us + 2000000);
    key_inject(frame, frames);
    key_step();
    assert_int_equal(key_faults(0)->auth_early, 1);
    (void)key_sign_pose(frame, k.key, 1, now_us);
    key_run(200); /* it is held back */
    key_inject(frame, frames);
    key_step();
    assert_int_equal(key_faults(0)->auth_stale, 1);
    assert_nobody_far();
    assert_refused(3);
    (void)key_sign_pose(frame, k.key, 1, room_bench_now_us(&k.room)); /* in time */
    key_inject(frame, frames);
    key_run(50);
    assert_int_equal(key_board(0)->poses.newest.pose.eye_nm[2], -900000000);
    assert_refused(3);
}

static void test_a_whole_recording_changes_nothing(void **state)
{
    (void)state;
    key_listen();
    key_start_running();
    assert_true(k.frames > 100);
    k.sending = false;
    key_run(3000);
    assert_boards_are(CAN_BOARD_SAFE);
    const can_pose_t before = key_board(0)->poses.newest;
    key_repeat_all();
    key_run(200);
    assert_boards_are(CAN_BOARD_SAFE);
    assert_true(can_faults_refused(key_faults(0)) - key_faults(0)->auth_commands > 50);
    assert_true(key_faults(0)->auth_replayed > 10);
    assert_true(key_faults(0)->auth_commands > 0);
    assert_memory_equal(&before.pose, &key_board(0)->poses.newest.pose, sizeof before.pose);
}

/* A stranger's bus time and numbers of refreshes, with the best rank. */
static void test_time_of_strangers_changes_nothing(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    key_start_running();
    key_run(8000);
    assert_true(key_board(0)->report.agreement.in_step);
    const frame_epoch_t epoch = key_board(0)->choice.clock.now;
    for (int i = 0; i < 100; i++) {
        const uint8_t counter = (uint8_t)(i % CAN_E2E_P01_COUNTERS);
        assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 1, .counter = counter}));
        key_inject(&frame, 1);
        assert_true(can_follow_up_encode(&frame, &(can_follow_up_t){.number = 1, .counter = counter, .time_us = 5}));
        key_inject(&frame, 1);
        const can_frame_clock_t clock = {.node = 1, .counter = counter, .sure = true, .epoch = 9, .phase_us = 8000};
        assert_true(can_frame_clock_encode(&frame, &clock));
        key_inject(&frame, 1);
        assert_true(can_latency_encode(&frame, &(can_latency_t){.node = 1, .counter = counter, .lag_us = 60000}));
        key_inject(&frame, 1);
        key_step();
    }
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++) {
        assert_int_equal(key_board(b)->time.master, BUS_MASTER_TRACKER);
        assert_int_equal(key_board(b)->time.time.relocks, 0);
        assert_int_equal(key_board(b)->choice.clock.now.phase_us, epoch.phase_us);
        assert_true(key_board(b)->report.agreement.in_step);
        assert_false(key_board(b)->choice.clock.room.board[1].any);
        assert_in_range(key_faults(b)->auth_unsigned, 285, 300);
    }
}

#define BOTH(test)                                                                                                     \
    cmocka_unit_test_setup_teardown(test, key_open_fd, key_teardown),                                                  \
        cmocka_unit_test_setup_teardown(test, key_open_classic, key_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        BOTH(test_who_has_the_key_is_believed),
        BOTH(test_without_a_tracker_nobody_speaks),
        BOTH(test_another_key_or_none_is_not),
        BOTH(test_poses_of_strangers_change_nothing),
        BOTH(test_repeated_and_late_poses_change_nothing),
        BOTH(test_a_whole_recording_changes_nothing),
        BOTH(test_time_of_strangers_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
