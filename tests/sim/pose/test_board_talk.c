// SPDX-License-Identifier: Apache-2.0
// Tests of talks with boards: a made-up board on a simulated bus replies well, badly, late or not at all.
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "sim/devices/sim_clock.h"
#include "sim/pose/board_talk.h"
#include "tests/support/auth_frames.h"
#include "tests/support/socketcand_bench.h"

enum { NODE = 7, OTHER_NODE = 8, QUIET_US = 400000, MOST_REPLIES = 4 };

/* A thread with the bus, and a board that has its replies ready. */
typedef struct {
    socketcand_bench_t bench;
    pthread_t thread;
    atomic_bool stop;
    isotp_t link;
    struct {
        const uint8_t *bytes;
        int length;
    } reply[MOST_REPLIES];
    int replies;
    uint8_t request[COMMAND_MAX_BYTES];
    int request_length;
    bool one_each;         /* one reply a request */
    int lost_in, lost_out; /* number of the frame to the board, or from it, that is lost; 0: none */
    bool heartbeat;        /* the board sends one after each turn */
    int requests, newest;  /* how many came, and bytes of the newest */
    int unsent;
} scene_t;

static scene_t scene;
static const volatile sig_atomic_t never_stop;

static void turn(void)
{
    const int64_t now_us = sim_clock_monotonic_us();
    const uint8_t *request;
    hal_can_frame_t frame;
    socketcand_bench_turn(&scene.bench, 1);
    while (hal_can_receive(scene.bench.board, &frame) == HAL_OK)
        if (--scene.lost_in != 0)
            (void)isotp_take(&scene.link, &frame, now_us);
    const int length = isotp_received(&scene.link, &request);
    if (length > 0 && length <= COMMAND_MAX_BYTES) {
        memcpy(scene.request, request, (size_t)length);
        scene.request_length = length;
        scene.newest = length;
        scene.requests++;
    }
    if (scene.request_length > 0 && scene.replies > 0 && !isotp_sending(&scene.link)) {
        scene.replies--;
        if (scene.reply[scene.replies].length > 0) /* else it is lost */
            (void)isotp_send(&scene.link, scene.reply[scene.replies].bytes, scene.reply[scene.replies].length, now_us);
        scene.request_length *= !scene.one_each;
    }
    isotp_taken(&scene.link);
    while (isotp_next(&scene.link, &frame, now_us))
        if (--scene.lost_out != 0 && hal_can_send(scene.bench.board, &frame) != HAL_OK)
            scene.unsent++;
    if (scene.heartbeat && can_heartbeat_encode(&frame, &(can_heartbeat_t){.node = NODE}))
        scene.unsent += hal_can_send(scene.bench.board, &frame) != HAL_OK;
}

static void *play(void *context)
{
    const struct timespec nap = {.tv_nsec = 500000};
    while (!scene.stop) {
        turn();
        nanosleep(&nap, NULL);
    }
    return context;
}

/* Replies are given in the reverse order. */
static void add_reply(const void *bytes, int length)
{
    scene.reply[scene.replies].bytes = bytes;
    scene.reply[scene.replies].length = length;
    scene.replies++;
}

static int open_scene(void **state)
{
    (void)state;
    memset(&scene, 0, sizeof scene);
    scene.bench = socketcand_bench_begin();
    isotp_init(&scene.link, CAN_ID_COMMAND + NODE, CAN_ID_REPLY + NODE);
    return 0;
}

static int close_scene(void **state)
{
    (void)state;
    socketcand_bench_end(&scene.bench);
    return 0;
}

/* @return What board_talk() says. */
static bool talk_to(board_talk_t *talk, int count)
{
    char bus[32], error[POSE_LINK_MESSAGE_LENGTH] = "";
    pose_link_t link;
    snprintf(bus, sizeof bus, "127.0.0.1:%d", socketcand_server_port(scene.bench.server));
    assert_int_equal(pthread_create(&scene.thread, NULL, play, NULL), 0);
    assert_true(pose_link_open(&link, bus, false, error));
    assert_true(pose_link_listen(&link, error));
    const bool ok = board_talk(&link, talk, count, QUIET_US, &never_stop, error);
    pose_link_close(&link);
    scene.stop = true;
    assert_int_equal(pthread_join(scene.thread, NULL), 0);
    assert_int_equal(scene.unsent, 0);
    return ok;
}

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

static const char nonce_reply[] = "\x88\x00\x01\x02\x03\x04\x05\x06\x07\x08";
static const uint64_t nonce = 0x0807060504030201;

/* A talk with a key, about a freeze. Is the newest request one with the code for that number? */
static board_talk_t talk_with_key(void)
{
    can_auth_t *auth = can_auth_open(&AUTH_KEY);
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_FREEZE, .freeze = true}, .auth = auth};
    assert_non_null(auth);
    scene.one_each = true;
    assert_true(talk_to(&talk, 1));
    if (scene.newest == 2 + CAN_AUTH_COMMAND_BYTES) {
        const can_auth_command_t plain = {CAN_ID_COMMAND + NODE, scene.request, 2, nonce};
        assert_memory_equal(scene.request, "\x03\x01", 2);
        assert_true(can_auth_check_command(auth, &plain, scene.request + 2));
    }
    can_auth_close(auth);
    return talk;
}

static void test_codes_are_made_for_the_number_given(void **state)
{
    (void)state;
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    const board_talk_t talk = talk_with_key();
    assert_true(talk.replied);
    assert_false(talk.keyless);
    assert_int_equal(talk.result, COMMAND_OK);
    assert_int_equal(scene.requests, 2);
    assert_int_equal(scene.newest, 2 + CAN_AUTH_COMMAND_BYTES);
}

static void test_refused_codes_and_lost_replies_are_tried_again(void **state)
{
    (void)state;
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    add_reply("\x83\x03", 2); /* another has asked for a number meanwhile */
    add_reply(nonce_reply, 10);
    const board_talk_t refused = talk_with_key();
    assert_true(refused.replied && refused.result == COMMAND_OK);
    assert_int_equal(scene.requests, 4);
    close_scene(NULL);
    open_scene(NULL);
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    add_reply("", 0);
    add_reply(nonce_reply, 10);
    const board_talk_t lost = talk_with_key();
    assert_true(lost.replied && lost.result == COMMAND_OK);
    assert_int_equal(scene.requests, 4);
}

static void test_boards_without_a_key_do_nothing(void **state)
{
    (void)state;
    add_reply("\x88\x01", 2);
    const board_talk_t talk = talk_with_key();
    assert_true(talk.replied && talk.keyless);
    assert_int_equal(scene.requests, 1);
    assert_int_equal(scene.newest, 1);
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
        cmocka_unit_test_setup_teardown(test_codes_are_made_for_the_number_given, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_refused_codes_and_lost_replies_are_tried_again, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_boards_without_a_key_do_nothing, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_bus_that_goes_is_an_error, open_scene, close_scene),
        cmocka_unit_test(test_stop_ends_the_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
