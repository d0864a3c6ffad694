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

#include "sim/devices/sim_clock.h"
#include "sim/pose/board_talk.h"
#include "tests/support/socketcand_bench.h"

enum { NODE = 7, OTHER_NODE = 8, QUIET_US = 400000, MOST_REPLIES = 3 };

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
        (void)isotp_take(&scene.link, &frame, now_us);
    const int length = isotp_received(&scene.link, &request);
    if (length > 0 && length <= COMMAND_MAX_BYTES) {
        memcpy(scene.request, request, (size_t)length);
        scene.request_length = length;
    }
    if (scene.request_length > 0 && scene.replies > 0 && !isotp_sending(&scene.link)) {
        scene.replies--;
        (void)isotp_send(&scene.link, scene.reply[scene.replies].bytes, scene.reply[scene.replies].length, now_us);
    }
    isotp_taken(&scene.link);
    while (isotp_next(&scene.link, &frame, now_us))
        if (hal_can_send(scene.bench.board, &frame) != HAL_OK)
            scene.unsent++;
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
        cmocka_unit_test_setup_teardown(test_bus_that_goes_is_an_error, open_scene, close_scene),
        cmocka_unit_test(test_stop_ends_the_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
