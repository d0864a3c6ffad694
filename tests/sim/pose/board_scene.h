// SPDX-License-Identifier: Apache-2.0
// A made-up board on a simulated bus, for tests of talks with it.
#ifndef TESTS_SIM_POSE_BOARD_SCENE_H
#define TESTS_SIM_POSE_BOARD_SCENE_H

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
#include "tests/support/socketcand_bench.h"

enum { NODE = 7, QUIET_US = 400000, MOST_REPLIES = 4 };

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

static inline void turn(void)
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

static inline void *play(void *context)
{
    const struct timespec nap = {.tv_nsec = 500000};
    while (!scene.stop) {
        turn();
        nanosleep(&nap, NULL);
    }
    return context;
}

/* Replies are given in the reverse order. */
static inline void add_reply(const void *bytes, int length)
{
    scene.reply[scene.replies].bytes = bytes;
    scene.reply[scene.replies].length = length;
    scene.replies++;
}

static inline int open_scene(void **state)
{
    (void)state;
    memset(&scene, 0, sizeof scene);
    scene.bench = socketcand_bench_begin();
    isotp_init(&scene.link, CAN_ID_COMMAND + NODE, CAN_ID_REPLY + NODE);
    return 0;
}

static inline int close_scene(void **state)
{
    (void)state;
    socketcand_bench_end(&scene.bench);
    return 0;
}

/* @return What board_talk() says. */
static inline bool talk_to(board_talk_t *talk, int count)
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

#endif
