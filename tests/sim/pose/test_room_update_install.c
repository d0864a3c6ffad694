// SPDX-License-Identifier: Apache-2.0
// Tests of a room's looks, installs and cancellations, with made-up boards, and of what is said of them.
#include "tests/sim/pose/made_up_boards.h"

static void test_status(void **state)
{
    (void)state;
    board[1].status.state = CAN_UPDATE_INSTALLING;
    board[1].status.progress = 37;
    board[2].status.trial = true;
    begin(ROOM_UPDATE_STATUS, NULL);
    run_to(ROOM_UPDATE_DONE);
    check_trouble(0, ROOM_BOARD_WELL, "runs 1, 2 waits");
    check_trouble(1, ROOM_BOARD_WELL, "installing 37 %");
    check_trouble(2, ROOM_BOARD_WELL, "runs 1 on trial");
    assert_int_equal(told(COMMAND_UPDATE_STATUS), BOARDS);
}

static void test_status_of_boards_in_trouble(void **state)
{
    (void)state;
    board[0].silent = true;
    board[1].status.state = CAN_UPDATE_NO_AGENT;
    board[2].status.state = CAN_UPDATE_FAILED;
    strcpy(board[2].status.message, "no space");
    begin(ROOM_UPDATE_STATUS, NULL);
    run_to(ROOM_UPDATE_REFUSED);
    check_trouble(0, ROOM_BOARD_SILENT, "is silent; power");
    check_trouble(1, ROOM_BOARD_NO_AGENT, "no update agent");
    check_trouble(2, ROOM_BOARD_WELL, "failed: no space");
}

/* It is asked again, but not for ever. */
static void test_status_of_a_silent_board(void **state)
{
    (void)state;
    board[0].silent = true;
    begin(ROOM_UPDATE_STATUS, NULL);
    run_to(ROOM_UPDATE_REFUSED);
    check_trouble(0, ROOM_BOARD_SILENT, "is silent");
    assert_int_equal(told(COMMAND_UPDATE_STATUS), BOARDS - 1);
}

static void test_cancel(void **state)
{
    (void)state;
    begin(ROOM_UPDATE_CANCEL, NULL);
    run_to(ROOM_UPDATE_DONE);
    assert_int_equal(told(COMMAND_UPDATE_CANCEL), BOARDS);
}

static void test_install_that_a_board_refuses(void **state)
{
    (void)state;
    board[0].result = COMMAND_IMPOSSIBLE;
    board[0].refusal = UPDATE_BUSY;
    begin(ROOM_UPDATE_INSTALL, NULL);
    run_to(ROOM_UPDATE_FAILED);
    check_trouble(0, ROOM_BOARD_REFUSES, "is installing or switching");
    assert_string_equal(board[1].newest.text, "/b");
}

static void test_install_of_different_versions(void **state)
{
    (void)state;
    strcpy(board[2].status.waiting, "3");
    begin(ROOM_UPDATE_INSTALL, NULL);
    run_to(ROOM_UPDATE_FAILED);
    check_trouble(2, ROOM_BOARD_OTHER, "3 waits");
}

/* An agent that lost the request, and a board that went away: not for ever. */
static void test_install_that_does_not_go_on(void **state)
{
    (void)state;
    board[0].status.state = CAN_UPDATE_IDLE;
    board[1].silent = true;
    board[1].silent_from = COMMAND_UPDATE_INSTALL;
    begin(ROOM_UPDATE_INSTALL, NULL);
    run_to(ROOM_UPDATE_FAILED);
    board[1].silent = false;
    begin(ROOM_UPDATE_INSTALL, NULL);
    run_to(ROOM_UPDATE_FAILED);
    check_trouble(0, ROOM_BOARD_OTHER, "idle");
    check_trouble(1, ROOM_BOARD_WELL, "2 waits");
}

static void test_install_that_has_no_end(void **state)
{
    (void)state;
    board[2].status.state = CAN_UPDATE_INSTALLING;
    most_us += ROOM_UPDATE_INSTALL_US;
    begin(ROOM_UPDATE_INSTALL, NULL);
    run_to(ROOM_UPDATE_FAILED);
    assert_in_range(now_us - update.begun_us, ROOM_UPDATE_INSTALL_US, ROOM_UPDATE_INSTALL_US + 5000000);
    check_trouble(2, ROOM_BOARD_OTHER, "installing");
}

static void test_every_refusal_has_its_words(void **state)
{
    (void)state;
    for (int i = 0; i <= UPDATE_NOT_TOLD; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(room_update_refusal((uint8_t)i), room_update_refusal((uint8_t)k));
    assert_non_null(strstr(room_update_refusal(200), "does not know"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_status, open_room),
        cmocka_unit_test_setup(test_status_of_boards_in_trouble, open_room),
        cmocka_unit_test_setup(test_status_of_a_silent_board, open_room),
        cmocka_unit_test_setup(test_cancel, open_room),
        cmocka_unit_test_setup(test_install_that_a_board_refuses, open_room),
        cmocka_unit_test_setup(test_install_of_different_versions, open_room),
        cmocka_unit_test_setup(test_install_that_does_not_go_on, open_room),
        cmocka_unit_test_setup(test_install_that_has_no_end, open_room),
        cmocka_unit_test_setup(test_every_refusal_has_its_words, open_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
