// SPDX-License-Identifier: Apache-2.0
// Tests of talks with boards: a board replies well, badly, late or not at all.
#include "tests/sim/pose/board_scene.h"

enum { OTHER_NODE = 8 };

static void test_long_request_and_reply(void **state)
{
    (void)state;
    static uint8_t reply[COMMAND_REPLY_BYTES] = {COMMAND_METHOD | COMMAND_REPLY_FLAG, COMMAND_OK};
    for (int i = 2; i < COMMAND_REPLY_BYTES; i++)
        reply[i] = (uint8_t)(i * 7);
    add_reply(reply, sizeof reply);
    board_talk_t talk = {.node = NODE};
    talk.request = (command_t){.kind = COMMAND_METHOD, .method = warp_method_from_name("kaiser+nearest")};
    assert_true(talk_to(&talk, 1));
    assert_int_equal(scene.request_length, 15);
    assert_memory_equal(scene.request, "\x02kaiser+nearest", 15);
    assert_true(talk.replied);
    assert_int_equal(talk.result, COMMAND_OK);
    assert_int_equal(talk.length, COMMAND_REPLY_BYTES - 2);
    assert_memory_equal(talk.answer, reply + 2, COMMAND_REPLY_BYTES - 2);
}

static void test_reply_to_another_request_is_passed_over(void **state)
{
    (void)state;
    add_reply("\x83\x02", 2);
    add_reply("\x81\x00", 2);
    add_reply("\x83", 1);
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_FREEZE}};
    assert_true(talk_to(&talk, 1));
    assert_true(talk.replied);
    assert_int_equal(talk.result, COMMAND_BAD_VALUE);
    assert_int_equal(talk.length, 0);
}

static void test_only_who_is_there_replies(void **state)
{
    (void)state;
    add_reply("\x81\x00", 2);
    board_talk_t talk[3] = {{.node = 1, .request = {.kind = COMMAND_HELLO}},
                            {.node = NODE, .request = {.kind = COMMAND_HELLO}},
                            {.node = OTHER_NODE, .request = {.kind = COMMAND_HELLO}}};
    assert_true(talk_to(talk, 3));
    assert_false(talk[0].replied);
    assert_true(talk[1].replied);
    assert_false(talk[2].replied);
    assert_true(talk[1].tries < BOARD_TALK_TRIES);
    assert_true(talk[0].tries == BOARD_TALK_TRIES && talk[2].tries == BOARD_TALK_TRIES);
    assert_true(!talk[0].answering && !talk[0].alive);
}

/* Frames of a request of three, then of a reply of 30 bytes: the first, one in the middle, the last; and a flow control
 * of either side, for which a board waits ISOTP_TIMEOUT_US. */
static void test_a_lost_frame_costs_a_try(void **state)
{
    static const uint8_t reply[30] = {COMMAND_METHOD | COMMAND_REPLY_FLAG, COMMAND_OK, 1, 2, 3};
    static const struct {
        int in, out;
    } lost[] = {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 1}, {0, 2}, {0, 4}, {0, 6}};
    for (size_t i = 0; i < sizeof lost / sizeof lost[0]; i++) {
        (void)open_scene(state);
        scene.one_each = true;
        scene.lost_in = lost[i].in;
        scene.lost_out = lost[i].out;
        for (int n = 0; n < MOST_REPLIES; n++)
            add_reply(reply, sizeof reply);
        board_talk_t talk = {.node = NODE};
        talk.request = (command_t){.kind = COMMAND_METHOD, .method = warp_method_from_name("kaiser+nearest")};
        assert_true(talk_to(&talk, 1));
        if (!talk.replied || talk.tries < 2 || talk.length != 28 || memcmp(talk.answer, reply + 2, 28) != 0)
            fail_msg("lost %d, %d: replied %d, tries %d", lost[i].in, lost[i].out, talk.replied, talk.tries);
        (void)close_scene(state);
    }
}

static void test_what_is_heard_of_a_board_that_does_not_reply(void **state)
{
    (void)state;
    add_reply("\x83\x00", 2); /* to another request */
    scene.heartbeat = true;
    board_talk_t talk[2] = {{.node = NODE, .request = {.kind = COMMAND_HELLO}},
                            {.node = OTHER_NODE, .request = {.kind = COMMAND_HELLO}}};
    assert_true(talk_to(talk, 2));
    assert_true(!talk[0].replied && talk[0].alive && talk[0].answering);
    assert_true(!talk[1].replied && !talk[1].alive && !talk[1].answering);
}

/* The reply to a first try may come when it has been asked again, and the second one when it is asked for more. */
static void test_a_reply_with_earlier_events_is_passed_over(void **state)
{
    (void)state;
    add_reply("\x87\x00\x34\x12\x00\x00", 6);
    add_reply("\x87\x00\x33\x12\x00\x00", 6);
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_LOG, .first_event = 0x1234}};
    assert_true(talk_to(&talk, 1));
    assert_true(talk.replied);
    assert_int_equal(talk.answer[0], 0x34);
}

static void test_bus_that_goes_is_an_error(void **state)
{
    (void)state;
    char bus[32], error[POSE_LINK_MESSAGE_LENGTH] = "";
    pose_link_t link;
    snprintf(bus, sizeof bus, "127.0.0.1:%d", socketcand_server_port(scene.bench.server));
    assert_int_equal(pthread_create(&scene.thread, NULL, play, NULL), 0);
    assert_true(pose_link_open(&link, bus, false, error));
    assert_true(pose_link_listen(&link, error));
    scene.stop = true;
    assert_int_equal(pthread_join(scene.thread, NULL), 0);
    socketcand_server_close(scene.bench.server);
    scene.bench.server = NULL;
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_HELLO}};
    assert_false(board_talk(&link, &talk, 1, QUIET_US, &never_stop, error));
    assert_true(strlen(error) > 0);
    assert_false(talk.replied);
    pose_link_close(&link);
}

static void test_stop_ends_the_wait(void **state)
{
    (void)state;
    static const volatile sig_atomic_t stop = 1;
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_HELLO}};
    pose_link_t link = {.socket = -1}; /* never used */
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(board_talk(&link, &talk, 1, INT64_MAX, &stop, error));
    assert_false(talk.replied);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_long_request_and_reply, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_reply_to_another_request_is_passed_over, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_only_who_is_there_replies, open_scene, close_scene),
        cmocka_unit_test(test_a_lost_frame_costs_a_try),
        cmocka_unit_test_setup_teardown(test_what_is_heard_of_a_board_that_does_not_reply, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_a_reply_with_earlier_events_is_passed_over, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_bus_that_goes_is_an_error, open_scene, close_scene),
        cmocka_unit_test(test_stop_ends_the_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
