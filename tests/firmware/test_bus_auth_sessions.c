// SPDX-License-Identifier: Apache-2.0
// A room with a key, in virtual time: boards and trackers that start anew, come back, or go.
#include "tests/firmware/key_bench.h"

enum { BOARD_5 = 5 };

static void restart(int board)
{
    char error[FILE_ERROR_LENGTH];
    assert_true(sim_world_restart(k.room.world, board, error));
}

static void test_a_board_that_starts_anew_is_told_again(void **state)
{
    (void)state;
    key_listen();
    key_start_running();
    k.sending = false;
    restart(0);
    key_repeat_all(); /* to a board that knows neither session nor time */
    assert_int_equal(key_board(0)->report.state, CAN_BOARD_WAITING);
    assert_false(key_board(0)->auth.has_session);
    assert_int_equal(can_faults_refused(key_faults(0)) - key_faults(0)->auth_commands, 0);
    key_track(k.key, 77);
    key_run(KEY_AGAIN_MS);
    assert_boards_are(CAN_BOARD_RUNNING);
    restart(1);
    key_run(KEY_AGAIN_MS); /* the tracker goes on */
    assert_boards_are(CAN_BOARD_RUNNING);
    assert_int_equal(k.tracker.auth.teller.told, 3);
    key_run(7000);
    assert_true(key_board(1)->report.agreement.in_step);
}

static void test_a_tracker_that_starts_anew_is_believed_again(void **state)
{
    (void)state;
    hal_can_frame_t old[POSE_AUTH_FRAMES];
    key_start_running();
    key_track(k.key, 2);
    key_run(KEY_AGAIN_MS);
    assert_boards_are(CAN_BOARD_RUNNING);
    assert_int_equal(key_board(0)->auth.session, 2);
    k.sending = false;
    const uint32_t forged = key_faults(0)->auth_forged;
    const int frames = key_sign_pose(old, k.key, 1, room_bench_now_us(&k.room));
    key_inject(old, frames);
    key_run(50);
    assert_int_equal(key_faults(0)->auth_forged, forged + 1);
    assert_nobody_far();
}

/* Lost frames are not taken for a stranger's, and every board is told the session in the end. */
static void test_lost_frames_are_not_strangers(void **state)
{
    (void)state;
    sim_bus_fail(sim_world_bus(k.room.world), SIM_BUS_LOSE, (sim_bus_fail_t){.ppm = 20000});
    key_run(500);
    key_track(k.key, 1);
    key_run(20000);
    assert_boards_are(CAN_BOARD_RUNNING);
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++)
        assert_true(k.room.room.fd || key_faults(b)->auth_lost > 10);
    assert_refused(0);
}

/* Frames of talks are lost, too: a talk is begun again. */
static void test_boards_are_told_whatever_is_lost(void **state)
{
    (void)state;
    sim_bus_fail(sim_world_bus(k.room.world), SIM_BUS_LOSE, (sim_bus_fail_t){.ppm = 30000});
    for (uint64_t session = 1; session <= 10; session++) {
        key_track(k.key, session);
        key_run(4 * KEY_AGAIN_MS);
        for (int b = 0; b < ROOM_BENCH_BOARDS; b++)
            if (key_board(b)->auth.session != session)
                fail_msg("session %d: board %d has another", (int)session, b);
        assert_true(k.tracker.auth.teller.told >= ROOM_BENCH_BOARDS);
    }
}

/* The first of two trackers with the key is heard again when the second has gone. */
static void test_a_tracker_comes_back_when_another_has_gone(void **state)
{
    (void)state;
    static pose_sender_t first;
    key_start_running();
    first = k.tracker;
    key_track(k.key, 2);
    for (int i = 0; i < 2 * ROOM_BENCH_HZ; i++)
        key_step();
    assert_int_equal(key_board(0)->auth.session, 2);
    k.tracker = first;
    key_run(4000);
    assert_int_equal(key_board(0)->auth.session, 1);
    assert_boards_are(CAN_BOARD_RUNNING);
}

static void test_boards_sign_when_the_tracker_has_gone(void **state)
{
    (void)state;
    key_start_running();
    key_run(5000);
    k.sending = false;
    key_run(3000);
    const int64_t now_us = room_bench_now_us(&k.room);
    assert_int_equal(bus_master_state(&key_board(0)->time, now_us), CAN_TIME_OWN);
    assert_int_equal(bus_master_state(&key_board(1)->time, now_us), CAN_TIME_LOCKED);
    assert_int_equal(key_board(1)->time.master, BOARD_5);
    assert_int_equal(key_board(1)->choice.clock.leader, key_board(0)->choice.clock.leader);
    assert_refused(0);
    assert_true(bus_auth_wants_session(&key_board(0)->auth, now_us));
    restart(0); /* it knows no session: it is silent, and the other one is master */
    key_run(3000);
    assert_int_equal(bus_master_state(&key_board(1)->time, room_bench_now_us(&k.room)), CAN_TIME_OWN);
    assert_refused(0);
    key_track(k.key, 3);
    key_run(12000);
    assert_boards_are(CAN_BOARD_RUNNING);
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++) {
        assert_int_equal(key_board(b)->time.master, BUS_MASTER_TRACKER);
        assert_true(key_board(b)->report.agreement.in_step);
    }
}

#define BOTH(test)                                                                                                     \
    cmocka_unit_test_setup_teardown(test, key_open_fd, key_teardown),                                                  \
        cmocka_unit_test_setup_teardown(test, key_open_classic, key_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        BOTH(test_a_board_that_starts_anew_is_told_again),
        BOTH(test_a_tracker_that_starts_anew_is_believed_again),
        BOTH(test_lost_frames_are_not_strangers),
        BOTH(test_boards_are_told_whatever_is_lost),
        BOTH(test_a_tracker_comes_back_when_another_has_gone),
        BOTH(test_boards_sign_when_the_tracker_has_gone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
