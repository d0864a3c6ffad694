// SPDX-License-Identifier: Apache-2.0
// Tests of a room's update, with the real firmware of its boards on a simulated bus: all go together, or none.
#include "tests/sim/update/play_bench.h"
#include "tests/support/auth_frames.h"

enum { BOARDS = 4, VICTIM = 2 };

static room_t room;
static update_play_t *play;

static void play_in(update_play_failure_t failure, can_auth_t *key)
{
    char error[FILE_ERROR_LENGTH] = "";
    update_play_settings_t settings = {.room = &room,
                                       .install_us = 3000000,
                                       .reboot_us = 2000000,
                                       .ahead_us = ROOM_UPDATE_LEAST_AHEAD_US,
                                       .seed = 5,
                                       .key = key};
    settings.failure[VICTIM] = failure;
    small_room_load(&room, &(small_room_t){.boards = BOARDS, .nodes_apart = 7});
    play = update_play_open(&settings, error);
    assert_string_equal(error, "");
    const char *wrong = play_all(play, BOARDS);
    if (wrong != NULL)
        fail_msg("%s", wrong);
}

static void play_with(update_play_failure_t failure)
{
    play_in(failure, NULL);
}

static int close_play(void **state)
{
    (void)state;
    update_play_close(play);
    play = NULL;
    return 0;
}

static const room_update_t *told(void)
{
    return update_play_operator(play);
}

static void check_look(int board, update_play_look_t look)
{
    assert_string_equal(update_play_look_name(update_play_look(play, board)), update_play_look_name(look));
}

static void check_none_switched(void)
{
    for (int i = 0; i < BOARDS; i++) {
        assert_true(update_play_switched_us(play, i) == INT64_MIN);
        assert_string_equal(update_play_running(play, i), update_play_old);
    }
}

static void test_all_is_well(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_WELL);
    assert_int_equal(told()->result, ROOM_UPDATE_DONE);
    assert_string_equal(told()->version, update_play_new);
    const int64_t bus_us = (int64_t)told()->switch_bus_us;
    assert_true(bus_us > 0);
    for (int i = 0; i < BOARDS; i++) {
        check_look(i, UPDATE_PLAY_NEW);
        assert_int_equal(told()->board[i].trouble, ROOM_BOARD_WELL);
        assert_true(update_play_switched_us(play, i) == update_play_switched_us(play, 0));
    }
}

static void test_install_that_fails(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_INSTALL);
    assert_int_equal(told()->settings.task, ROOM_UPDATE_INSTALL);
    assert_int_equal(told()->result, ROOM_UPDATE_FAILED);
    check_none_switched();
    check_look(VICTIM, UPDATE_PLAY_FAILED);
    check_look(0, UPDATE_PLAY_READY);
    assert_int_equal(told()->board[VICTIM].trouble, ROOM_BOARD_FAILED);
    assert_non_null(strstr(told()->board[VICTIM].status.message, "signature"));
    assert_int_equal(told()->board[0].trouble, ROOM_BOARD_WELL);
}

static void test_board_that_is_silent_at_the_switch(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_SILENT);
    assert_int_equal(told()->settings.task, ROOM_UPDATE_SWITCH);
    assert_int_equal(told()->result, ROOM_UPDATE_CANCELLED);
    check_none_switched();
    for (int i = 0; i < BOARDS; i++)
        assert_int_equal(told()->board[i].trouble, i == VICTIM ? ROOM_BOARD_SILENT : ROOM_BOARD_WELL);
    check_look(0, UPDATE_PLAY_READY); /* nothing is promised any more */
}

static void test_board_that_does_not_hear_that_the_moment_holds(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_DEAF);
    check_none_switched();
    assert_int_equal(told()->result, ROOM_UPDATE_CANCELLED); /* known when it is back */
    assert_true(update_play_now_us(play) > told()->switch_us + 4 * 1000000);
    for (int i = 0; i < BOARDS; i++) {
        assert_int_equal(told()->board[i].trouble, i == VICTIM ? ROOM_BOARD_SILENT : ROOM_BOARD_WELL);
        assert_true(told()->board[i].told);
    }
}

static void test_board_that_falls_back(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_CRASH);
    assert_int_equal(told()->result, ROOM_UPDATE_MIXED);
    for (int i = 0; i < BOARDS; i++) {
        assert_string_equal(update_play_running(play, i), i == VICTIM ? update_play_old : update_play_new);
        assert_int_equal(told()->board[i].trouble, i == VICTIM ? ROOM_BOARD_BACK : ROOM_BOARD_WELL);
        assert_true(update_play_switched_us(play, i) == update_play_switched_us(play, 0));
    }
    assert_non_null(strstr(told()->board[VICTIM].status.message, "did not start"));
    assert_string_equal(told()->board[0].status.other, update_play_old); /* the way back */
}

/* A cable that is out at the moment itself changes nothing: all were told. */
static void test_board_that_is_lost_at_the_moment(void **state)
{
    (void)state;
    play_with(UPDATE_PLAY_LOST);
    assert_int_equal(told()->result, ROOM_UPDATE_DONE);
    assert_true(update_play_switched_us(play, VICTIM) == update_play_switched_us(play, 0));
}

static void test_room_with_a_key(void **state)
{
    (void)state;
    can_auth_t *key = can_auth_open(&AUTH_KEY);
    assert_non_null(key);
    play_in(UPDATE_PLAY_WELL, key);
    assert_int_equal(told()->result, ROOM_UPDATE_DONE);
    assert_int_equal(told()->board[VICTIM].status.trial, false);
    update_play_close(play);
    play = NULL;
    can_auth_close(key);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_all_is_well, close_play),
        cmocka_unit_test_teardown(test_install_that_fails, close_play),
        cmocka_unit_test_teardown(test_board_that_is_silent_at_the_switch, close_play),
        cmocka_unit_test_teardown(test_board_that_does_not_hear_that_the_moment_holds, close_play),
        cmocka_unit_test_teardown(test_board_that_falls_back, close_play),
        cmocka_unit_test_teardown(test_room_with_a_key, close_play),
        cmocka_unit_test_teardown(test_board_that_is_lost_at_the_moment, close_play),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
