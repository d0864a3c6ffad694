// SPDX-License-Identifier: Apache-2.0
// Tests of a room's switch, with made-up boards.
#include "tests/sim/pose/made_up_boards.h"

static void test_switch(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    run_to(ROOM_UPDATE_DONE);
    assert_string_equal(update.version, "2");
    for (int i = 0; i < BOARDS; i++) {
        assert_int_equal(board[i].told[COMMAND_UPDATE_SWITCH], 1);
        assert_int_equal(board[i].told[COMMAND_UPDATE_CONFIRM], 1);
        assert_int_equal(board[i].told[COMMAND_UPDATE_CANCEL], 0);
    }
}

static void test_promise_names_moment_and_version(void **state)
{
    (void)state;
    board[2].off_us = 400000;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (told(COMMAND_UPDATE_CONFIRM) == 0)
        turn();
    const int64_t ahead_us = (int64_t)update.switch_bus_us - (now_us + BUS_US + board[2].off_us);
    assert_in_range(ahead_us, ROOM_UPDATE_LEAST_AHEAD_US - 1000000, ROOM_UPDATE_LEAST_AHEAD_US);
    for (int i = 0; i < BOARDS; i++)
        assert_true(board[i].newest.bus_time_us == update.switch_bus_us);
}

/* Nothing is told but looks. */
static void check_refused(void)
{
    run_to(ROOM_UPDATE_REFUSED);
    assert_int_equal(told(COMMAND_UPDATE_SWITCH) + told(COMMAND_UPDATE_CONFIRM) + told(COMMAND_UPDATE_INSTALL), 0);
}

static void test_switch_is_refused_when_a_board_has_another_version(void **state)
{
    (void)state;
    strcpy(board[1].status.waiting, "3");
    strcpy(board[1].status.other, "3");
    begin(ROOM_UPDATE_SWITCH, NULL);
    check_refused();
    check_trouble(1, ROOM_BOARD_OTHER, "has not the version");
    check_trouble(0, ROOM_BOARD_WELL, "");
}

static void test_switch_is_refused_when_a_board_is_not_ready(void **state)
{
    (void)state;
    board[1].status.state = CAN_UPDATE_INSTALLING;
    board[1].status.waiting[0] = board[1].status.other[0] = '\0';
    begin(ROOM_UPDATE_SWITCH, NULL);
    check_refused();
    check_trouble(1, ROOM_BOARD_OTHER, "installing");
}

static void test_switch_is_refused_when_nothing_waits(void **state)
{
    (void)state;
    for (int i = 0; i < BOARDS; i++) {
        board[i].status.state = CAN_UPDATE_IDLE;
        board[i].status.waiting[0] = '\0';
    }
    begin(ROOM_UPDATE_SWITCH, NULL);
    check_refused();
}

static void test_switch_is_refused_without_bus_time(void **state)
{
    (void)state;
    board[2].status.knows_time = false;
    begin(ROOM_UPDATE_SWITCH, NULL);
    check_refused();
    check_trouble(2, ROOM_BOARD_TIME, "bus time");
}

static void test_switch_is_refused_when_bus_times_differ(void **state)
{
    (void)state;
    board[2].off_us = 3000000;
    begin(ROOM_UPDATE_SWITCH, NULL);
    check_refused();
}

static void test_refusal_cancels_the_others(void **state)
{
    (void)state;
    board[1].result = COMMAND_IMPOSSIBLE;
    board[1].refusal = UPDATE_ON_TRIAL;
    begin(ROOM_UPDATE_SWITCH, NULL);
    run_to(ROOM_UPDATE_CANCELLED);
    assert_int_equal(told(COMMAND_UPDATE_CONFIRM), 0);
    assert_int_equal(board[0].told[COMMAND_UPDATE_CANCEL], 1);
    assert_int_equal(board[2].told[COMMAND_UPDATE_CANCEL], 1);
    check_trouble(1, ROOM_BOARD_REFUSES, "has not marked the version good");
}

static void test_silence_cancels_the_others(void **state)
{
    (void)state;
    board[1].silent = true;
    board[1].silent_from = COMMAND_UPDATE_SWITCH;
    begin(ROOM_UPDATE_SWITCH, NULL);
    run_to(ROOM_UPDATE_CANCELLED);
    assert_int_equal(told(COMMAND_UPDATE_CONFIRM), 0);
    assert_int_equal(board[0].told[COMMAND_UPDATE_CANCEL], 1);
    check_trouble(1, ROOM_BOARD_SILENT, "is silent");
}

/* It has heard that the moment holds, and nothing after that; another has not: it switches alone. */
static void test_board_that_switches_alone_is_told(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (board[1].told[COMMAND_UPDATE_SWITCH] == 0)
        turn();
    board[2].silent = true;
    board[2].silent_from = COMMAND_UPDATE_CONFIRM;
    while (told(COMMAND_UPDATE_CANCEL) == 0) {
        turn();
        board[1].silent = board[1].told[COMMAND_UPDATE_CONFIRM] > 0; /* from here on */
    }
    board[2].silent = false;
    most_us = now_us + ROOM_UPDATE_AFTER_US - 1000000;
    run_to(ROOM_UPDATE_WORKING); /* one has not been heard */
    board[1].silent = false;
    most_us += MOST_US;
    run_to(ROOM_UPDATE_MIXED);
    assert_string_equal(update.board[0].status.running, "1");
    assert_string_equal(update.board[1].status.running, "2");
    assert_string_equal(update.board[2].status.running, "1");
}

/* A cancellation that is lost is said again until the moment. */
static void test_cancellation_is_repeated(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (told(COMMAND_UPDATE_CONFIRM) == 0)
        turn();
    board[0].silent = true;
    room_update_stop(&update, now_us);
    const int64_t back_us = now_us + 3 * ROOM_UPDATE_TALK_US / 2;
    while (now_us < back_us)
        turn();
    assert_int_equal(board[0].told[COMMAND_UPDATE_CANCEL], 0);
    board[0].silent = false;
    run_to(ROOM_UPDATE_CANCELLED);
    assert_int_equal(board[0].told[COMMAND_UPDATE_CANCEL], 1);
    assert_int_equal(board[1].told[COMMAND_UPDATE_CANCEL], 1);
}

/* And nobody knows when it is never heard again. */
static void test_board_that_is_not_heard_again_is_told(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (told(COMMAND_UPDATE_SWITCH) < BOARDS)
        turn();
    board[1].silent = true;
    most_us += ROOM_UPDATE_AFTER_US;
    run_to(ROOM_UPDATE_MIXED);
    assert_true(now_us - update.switch_us >= ROOM_UPDATE_AFTER_US);
    check_trouble(1, ROOM_BOARD_SILENT, "is silent");
}

static void test_only_boards_of_another_version_go_back(void **state)
{
    (void)state;
    for (int i = 0; i < BOARDS; i++)
        board[i].status.state = CAN_UPDATE_IDLE;
    board[1].status = (update_status_t){.state = CAN_UPDATE_FAILED, .knows_time = true, .running = "2"};
    begin(ROOM_UPDATE_SWITCH, "2");
    run_to(ROOM_UPDATE_DONE);
    assert_int_equal(board[0].told[COMMAND_UPDATE_SWITCH], 1);
    assert_int_equal(board[1].told[COMMAND_UPDATE_SWITCH], 0);
    assert_int_equal(board[1].told[COMMAND_UPDATE_CONFIRM], 0);
    begin(ROOM_UPDATE_SWITCH, "2");
    run_to(ROOM_UPDATE_DONE); /* all do already */
    assert_int_equal(told(COMMAND_UPDATE_SWITCH), 2);
}

static void test_trial_that_has_no_end(void **state)
{
    (void)state;
    most_us += ROOM_UPDATE_START_US;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (update.result == ROOM_UPDATE_WORKING && now_us < most_us) {
        turn();
        board[1].status.trial = true;
    }
    assert_int_equal(update.result, ROOM_UPDATE_MIXED);
    assert_in_range(now_us - update.switch_us, ROOM_UPDATE_START_US, ROOM_UPDATE_START_US + 5000000);
    check_trouble(1, ROOM_BOARD_TRIAL, "not marked good");
}

static void test_stop_before_the_moment_cancels(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (update.step != ROOM_UPDATE_WATCH)
        turn();
    room_update_stop(&update, now_us);
    run_to(ROOM_UPDATE_CANCELLED);
    assert_int_equal(told(COMMAND_UPDATE_CANCEL), BOARDS);
}

static void test_stop_cancels(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_SWITCH, NULL);
    while (told(COMMAND_UPDATE_SWITCH) == 0)
        turn();
    room_update_stop(&update, now_us);
    run_to(ROOM_UPDATE_CANCELLED);
    assert_int_equal(told(COMMAND_UPDATE_CONFIRM), 0);
    assert_int_equal(told(COMMAND_UPDATE_CANCEL), BOARDS);
    begin(ROOM_UPDATE_INSTALL, NULL);
    turn();
    room_update_stop(&update, now_us);
    assert_int_equal(update.result, ROOM_UPDATE_CANCELLED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_switch, open_room),
        cmocka_unit_test_setup(test_promise_names_moment_and_version, open_room),
        cmocka_unit_test_setup(test_switch_is_refused_when_a_board_has_another_version, open_room),
        cmocka_unit_test_setup(test_switch_is_refused_when_a_board_is_not_ready, open_room),
        cmocka_unit_test_setup(test_switch_is_refused_when_nothing_waits, open_room),
        cmocka_unit_test_setup(test_switch_is_refused_without_bus_time, open_room),
        cmocka_unit_test_setup(test_switch_is_refused_when_bus_times_differ, open_room),
        cmocka_unit_test_setup(test_refusal_cancels_the_others, open_room),
        cmocka_unit_test_setup(test_silence_cancels_the_others, open_room),
        cmocka_unit_test_setup(test_board_that_switches_alone_is_told, open_room),
        cmocka_unit_test_setup(test_cancellation_is_repeated, open_room),
        cmocka_unit_test_setup(test_board_that_is_not_heard_again_is_told, open_room),
        cmocka_unit_test_setup(test_only_boards_of_another_version_go_back, open_room),
        cmocka_unit_test_setup(test_trial_that_has_no_end, open_room),
        cmocka_unit_test_setup(test_stop_before_the_moment_cancels, open_room),
        cmocka_unit_test_setup(test_stop_cancels, open_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
