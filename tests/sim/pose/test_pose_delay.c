// SPDX-License-Identifier: Apache-2.0
// Tests of the delay of poses, from capture to arrival in bus time: measured, and judged beside a room's pose_delay_ms.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/bus_said.h"

enum { RATE = 100, PERIOD_US = 10000, LENGTH_S = 6, SYNC_EVERY = 12, USUAL_US = 4000 };

/* A pose's time, wrapped, is then a little behind the clock that stamps frames. */
static const int64_t ahead_us = (INT64_C(1) << 32) - 50000;

/* A tracker whose clock is ahead of the one that stamps frames. */
typedef struct {
    bus_watch_t watch;
    bool fd, no_sync;
    uint8_t origin;         /* of bus time */
    int slow_at, slow_us;   /* pose number slow_at takes so much longer */
    int64_t capture_off_us; /* of all capture times */
} scene_t;

static void send(scene_t *scene, bool encoded, hal_can_frame_t *frame, int64_t time_us)
{
    assert_true(encoded);
    frame->time_us = time_us;
    bus_watch_take(&scene->watch, frame);
}

/* Its last frame comes USUAL_US after the capture. */
static void send_pose(scene_t *scene, int n)
{
    const int64_t comes_us = 1000000 + (int64_t)n * PERIOD_US, slow_us = n == scene->slow_at ? scene->slow_us : 0;
    const int64_t capture_us = comes_us - USUAL_US + ahead_us + scene->capture_off_us;
    const can_pose_t pose = {
        .pose.quaternion_q30 = {1 << 30, 0, 0, 0},
        .capture_time_us = (uint64_t)capture_us,
        .quality = CAN_POSE_TRACKED,
        .counter = (uint8_t)(n % (scene->fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS)),
    };
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const int parts = scene->fd ? 1 : CAN_POSE_PARTS;
    assert_true(scene->fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose));
    for (int i = 0; i < parts; i++)
        send(scene, true, &frame[i], comes_us + slow_us - 250 * (parts - 1 - i));
}

static void send_bus_time(scene_t *scene, int n)
{
    const int64_t time_us = 1000000 + (int64_t)n * PERIOD_US + 3000;
    const uint8_t counter = (uint8_t)(n / SYNC_EVERY % CAN_E2E_P01_COUNTERS), number = scene->origin;
    hal_can_frame_t frame;
    if (scene->no_sync || n % SYNC_EVERY != 0)
        return;
    const can_sync_t sync = {.number = number, .counter = counter, .origin = scene->origin};
    send(scene, can_sync_encode(&frame, &sync), &frame, time_us);
    const can_follow_up_t follow_up = {.number = number, .counter = counter, .time_us = (uint64_t)(time_us + ahead_us)};
    send(scene, can_follow_up_encode(&frame, &follow_up), &frame, time_us + 300);
}

static void play(scene_t *scene)
{
    bus_watch_init(&scene->watch, 500000, 2000000);
    for (int n = 1; n <= LENGTH_S * RATE; n++) {
        send_pose(scene, n);
        send_bus_time(scene, n);
    }
}

static void expect_line(const scene_t *scene, int64_t pose_delay_us, const char *line)
{
    bus_said(&scene->watch, pose_delay_us, BUS_SAID_ANY, line);
}

static void test_the_delay_is_measured_in_bus_time(void **state)
{
    (void)state;
    for (int fd = 0; fd < 2; fd++) {
        scene_t s = {.fd = fd == 1, .slow_at = 500, .slow_us = 2500};
        play(&s);
        const bus_watch_viewer_t *viewer = &s.watch.viewer[0];
        assert_in_range(viewer->delays, LENGTH_S * RATE / 2, LENGTH_S * RATE);
        assert_in_range(viewer->delay_sum_us / viewer->delays, USUAL_US - 10, USUAL_US + 120); /* sets carry 100 us */
        assert_in_range(viewer->delay_most_us, USUAL_US + 2490, USUAL_US + 2620);
    }
}

/* 4 ms and a quarter of 10 ms; with one late pose, 6.5 and a quarter. */
static void test_too_short_a_pose_delay_is_said_with_the_value_to_set(void **state)
{
    (void)state;
    scene_t s = {.fd = true};
    play(&s);
    expect_line(&s, 2000,
                "BAD  viewer 0: poses come up to 4.0 ms after their capture; set the room's pose_delay_ms to ");
    expect_line(&s, 6400, "BAD  viewer 0: poses come up to 4.0 ms");
    expect_line(&s, 6700, "ok   viewer 0: 100.0 poses a second, jitter 0.000 ms, delay 4.0 ms, at most 4.0\n");
    expect_line(&s, BUS_CHECK_NO_DELAY, "ok   viewer 0: 100.0 poses a second");
    s = (scene_t){.fd = true, .slow_at = 500, .slow_us = 2800};
    play(&s);
    expect_line(&s, 6700,
                "poses come up to 6.8 ms after their capture; set the room's pose_delay_ms to 9.5, not 6.7\n");
    s = (scene_t){.fd = true, .slow_at = 500, .slow_us = 45000};
    play(&s);
    expect_line(&s, 50000,
                "BAD  viewer 0: poses come up to 49.0 ms after their capture, which no pose_delay_ms allows");
}

/* Without a tracker's bus time, or with capture times that boards do not believe. */
static void test_a_delay_that_is_not_known_is_said(void **state)
{
    (void)state;
    static const char unknown[] = "BAD  viewer 0: how late its poses come is not known";
    const scene_t bad[] = {
        {.fd = true, .no_sync = true},
        {.fd = true, .origin = 5},
        {.fd = true, .capture_off_us = -1200000},
        {.fd = true, .capture_off_us = USUAL_US + 6000},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        scene_t s = bad[i];
        play(&s);
        assert_int_equal(s.watch.viewer[0].delays, 0);
        expect_line(&s, 50000, unknown);
    }
    scene_t s = bad[0];
    play(&s);
    expect_line(&s, BUS_CHECK_NO_DELAY, "ok   viewer 0: 100.0 poses a second, jitter 0.000 ms, delay within 0.000 ms");
}

static void test_monitor_shows_the_delay(void **state)
{
    (void)state;
    for (int known = 0; known < 2; known++) {
        scene_t s = {.fd = true, .no_sync = known == 0, .slow_at = 500, .slow_us = 2500};
        play(&s);
        bus_shown(&s.watch, known == 1 ? "     4.00     6.50      0" : "        -        -      0");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_delay_is_measured_in_bus_time),
        cmocka_unit_test(test_too_short_a_pose_delay_is_said_with_the_value_to_set),
        cmocka_unit_test(test_a_delay_that_is_not_known_is_said),
        cmocka_unit_test(test_monitor_shows_the_delay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
