// SPDX-License-Identifier: Apache-2.0
// Tests of the watch over a bus, and of what `wallwarp-pose check` says of it: a healthy bus, and each fault by itself.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "firmware/command.h"
#include "tests/support/bus_said.h"

enum { BITRATE = 500000, DATA_BITRATE = 2000000, RATE = 240, LENGTH_S = 3, NODE = 7 };

/* A bus with one tracker and one board; what goes wrong is chosen by the test. */
typedef struct {
    bus_watch_t watch;
    bool fd;
    int skip, repeat, damage, back; /* number of the pose that is left out, sent twice, ...; 0: none */
    int silent_from, silent_to;     /* poses that do not come */
    can_pose_quality_t quality;
    can_board_state_t state;
    uint32_t faults;
    bool board, restarts;
} scene_t;

static scene_t scene(void)
{
    scene_t made = {.quality = CAN_POSE_TRACKED, .state = CAN_BOARD_RUNNING, .board = true};
    bus_watch_init(&made.watch, BITRATE, DATA_BITRATE);
    return made;
}

static int64_t pose_time_us(int n)
{
    return 1000000 + (int64_t)n * 1000000 / RATE;
}

static void send(scene_t *scene, hal_can_frame_t frame, int64_t time_us)
{
    frame.time_us = time_us;
    bus_watch_take(&scene->watch, &frame);
}

static void send_pose(scene_t *scene, int n)
{
    const int64_t capture_us = pose_time_us(n) - 4000 - (n == scene->back ? 100000 : 0);
    const can_pose_t pose = {
        .pose = {.eye_nm = {1234560000, -5670000, 890000}, .quaternion_q30 = {1 << 30, 0, 0, 0}},
        .capture_time_us = (uint64_t)capture_us + 0xFFFF0000U, /* wraps within the first second */
        .quality = scene->quality,
        .counter = (uint8_t)(n % (scene->fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS)),
    };
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const int parts = scene->fd ? 1 : CAN_POSE_PARTS;
    assert_true(scene->fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose));
    for (int i = 0; i < parts; i++) {
        if (n == scene->damage)
            frame[i].data[5] ^= 1;
        send(scene, frame[i], pose_time_us(n) + 250 * (int64_t)i);
    }
}

static void send_bus_time(scene_t *scene, int n)
{
    hal_can_frame_t frame;
    const uint8_t counter = (uint8_t)(n / 30 % CAN_E2E_P01_COUNTERS);
    if (n % 30 != 0)
        return;
    assert_true(can_sync_encode(&frame, &(can_sync_t){.counter = counter}));
    send(scene, frame, pose_time_us(n) + 1600);
    assert_true(can_follow_up_encode(&frame, &(can_follow_up_t){.counter = counter}));
    send(scene, frame, pose_time_us(n) + 1900);
}

static void send_reports(scene_t *scene, int n)
{
    hal_can_frame_t frame;
    const can_heartbeat_t heartbeat = {.node = NODE,
                                       .counter = (uint8_t)(n / 120 % 15),
                                       .state = scene->state,
                                       .fault_flags = scene->faults,
                                       .uptime_s = scene->restarts && n > 300 ? 0 : 100 + (uint32_t)n / RATE};
    const can_status_t status = {.node = NODE, .counter = (uint8_t)(n / 24 % 15), .step_q8 = 320};
    if (scene->board && n % (RATE / 2) == 0) {
        assert_true(can_heartbeat_encode(&frame, &heartbeat));
        send(scene, frame, pose_time_us(n) + 1000);
    }
    if (scene->board && n % (RATE / 10) == 0) {
        assert_true(can_status_encode(&frame, &status));
        send(scene, frame, pose_time_us(n) + 1300);
    }
}

static void play(scene_t *scene)
{
    for (int n = 1; n <= LENGTH_S * RATE; n++) {
        if (n != scene->skip && (n < scene->silent_from || n >= scene->silent_to))
            send_pose(scene, n);
        if (n == scene->repeat)
            send_pose(scene, n);
        send_reports(scene, n);
        send_bus_time(scene, n);
    }
}

static void assert_said(const scene_t *scene, int bad, const char *expected)
{
    bus_said(&scene->watch, BUS_CHECK_NO_DELAY, bad, expected);
}

static void test_healthy_bus(void **state)
{
    (void)state;
    for (int fd = 0; fd < 2; fd++) {
        scene_t s = scene();
        s.fd = fd == 1;
        play(&s);
        const bus_watch_viewer_t *viewer = &s.watch.viewer[0];
        assert_int_equal(viewer->poses.count, LENGTH_S * RATE);
        assert_true(viewer->fd == s.fd && viewer->set != s.fd);
        const double mean_us = bus_watch_mean_us(&viewer->poses);
        assert_true(mean_us > 4166 && mean_us < 4167);
        assert_true(bus_watch_jitter_us(&viewer->poses) < 1);  /* whole microseconds only */
        assert_true(viewer->most_us - viewer->least_us < 101); /* sets carry 100 us */
        assert_int_equal(viewer->captured_back, 0);
        assert_int_equal(s.watch.board[NODE].heartbeats.count, 2 * LENGTH_S);
        assert_int_equal(s.watch.board[NODE].status.step_q8, 320);
        assert_said(&s, 0, "ok   viewer 0: 240.0 poses a second");
        assert_said(&s, 0, "ok   board 7: running");
    }
}

/* At 240 Hz three classic frames of 8 bytes take 111 to 135 bits each. */
static void test_load_is_the_frames_own(void **state)
{
    (void)state;
    scene_t s = scene();
    s.board = false;
    play(&s);
    assert_in_range(s.watch.load_ppm, 159800, 194400);
    assert_in_range(s.watch.worst_load_ppm, s.watch.load_ppm, 194400);
    send(&s, (hal_can_frame_t){.id = 1}, pose_time_us(LENGTH_S * RATE) + 2000000);
    assert_int_equal(s.watch.load_ppm, 0);
}

/* 4000 frames of 111 to 135 bits a second are 89 to 108 % of 500 kbit/s. */
static void test_full_bus_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    play(&s);
    for (int i = 0; i < 8000; i++)
        send(&s, (hal_can_frame_t){.id = 1, .length = 8, .data = {0x55}}, pose_time_us(LENGTH_S * RATE) + 250 * i);
    assert_said(&s, 3, "above 70 % poses come late"); /* and the board was silent, and bus time */
}

static void test_each_fault_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    s.skip = 100;
    play(&s);
    assert_said(&s, 1, "BAD  viewer 0: 1 poses lost on the way");

    s = scene();
    s.fd = true;
    s.repeat = 100;
    play(&s);
    assert_said(&s, 1, "BAD  viewer 0: 1 repeated poses");

    s = scene();
    s.damage = 100;
    play(&s);
    assert_said(&s, 2, "BAD  viewer 0: 3 frames with a wrong CRC");

    s = scene();
    s.back = 100;
    play(&s);
    assert_said(&s, 1, "BAD  viewer 0: capture times went back 1 times");

    s = scene();
    s.silent_from = 100;
    s.silent_to = 140; /* 167 ms: 40 lost are 2 * 15 + 10, and the counter tells 10 */
    play(&s);
    assert_said(&s, 2, "BAD  viewer 0: a gap of 170 ms");

    s = scene();
    s.quality = CAN_POSE_LOST;
    play(&s);
    assert_said(&s, 2, "times the tracker did not see the viewer");
    assert_said(&s, 2, "BAD  viewer 0: 0.0 poses a second");
}

static void test_each_fault_of_a_board_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    s.state = CAN_BOARD_HOLDING;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: is holding, expected running");

    s = scene();
    s.state = CAN_BOARD_FROZEN;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: an operator has frozen its picture; `wallwarp-pose command --node 7 freeze off`");

    s = scene();
    s.state = CAN_BOARD_PATTERN;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: an operator has put a test pattern on; ");

    s = scene();
    s.faults = CAN_FAULT_CAMERA | CAN_FAULT_DEADLINE | 1 << 15;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: reports a fault: camera, deadline, one of a newer firmware\n");

    s = scene();
    s.faults = CAN_FAULT_REFUSED;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: reports a fault: refused; it has a key: has who sends the same one, --key FILE?");

    s = scene();
    s.restarts = true;
    play(&s);
    assert_said(&s, 1, "BAD  board 7: started anew 1 times");

    s = scene();
    s.board = false;
    play(&s);
    assert_said(&s, 1, "BAD  no board reports");

    s = scene();
    play(&s);
    send(&s, (hal_can_frame_t){.id = CAN_ID_STATUS + NODE, .length = 8}, pose_time_us(LENGTH_S * RATE) + 2000000);
    assert_said(&s, 3, "BAD  board 7: no heartbeat for 1999 ms");
    assert_said(&s, 3, "BAD  bus time: no Sync and FollowUp for 1998 ms, expected every 125");
    assert_said(&s, 3, "BAD  1 damaged reports");
}

static void test_silence_and_strangers(void **state)
{
    (void)state;
    scene_t s = scene();
    assert_said(&s, 1, "BAD  no frame");
    send(&s, (hal_can_frame_t){.id = 0x123, .extended = true, .length = 1}, 1000000);
    assert_int_equal(s.watch.unknown, 1);
    assert_said(&s, 2, "BAD  no poses");
}

static void test_bus_time_is_known(void **state)
{
    (void)state;
    scene_t s = scene();
    hal_can_frame_t frame;
    assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 0}));
    send(&s, frame, 1000000);
    assert_true(can_follow_up_encode(&frame, &(can_follow_up_t){.number = NODE}));
    send(&s, frame, 1010000);
    assert_true(can_time_encode(&frame, &(can_time_t){.node = NODE}));
    send(&s, frame, 1020000);
    assert_true(s.watch.unknown == 0 && s.watch.damaged == 0);
    frame.data[3] ^= 1;
    send(&s, frame, 1030000);
    assert_true(s.watch.unknown == 0 && s.watch.damaged == 1);
}

static void test_commands_are_known(void **state)
{
    (void)state;
    static const uint32_t known[] = {CAN_ID_COMMAND + 1, CAN_ID_COMMAND + 63, CAN_ID_REPLY + 1, CAN_ID_REPLY + 63};
    static const uint32_t unknown[] = {CAN_ID_COMMAND, CAN_ID_REPLY, CAN_ID_REPLY + 64};
    scene_t s = scene();
    for (int i = 0; i < 4; i++)
        send(&s, (hal_can_frame_t){.id = known[i], .length = 8}, 1000000);
    assert_true(s.watch.unknown == 0 && s.watch.damaged == 0);
    for (int i = 0; i < 3; i++)
        send(&s, (hal_can_frame_t){.id = unknown[i], .length = 8}, 1000000);
    assert_int_equal(s.watch.unknown, 3);
}

static void test_both_messages_of_one_viewer_are_said(void **state)
{
    (void)state;
    scene_t s = scene();
    play(&s);
    s.fd = true;
    send_pose(&s, LENGTH_S * RATE + 1);
    assert_said(&s, 1, "comes as FD frames and as classic sets");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_healthy_bus),
        cmocka_unit_test(test_load_is_the_frames_own),
        cmocka_unit_test(test_full_bus_is_said),
        cmocka_unit_test(test_each_fault_is_said),
        cmocka_unit_test(test_each_fault_of_a_board_is_said),
        cmocka_unit_test(test_silence_and_strangers),
        cmocka_unit_test(test_bus_time_is_known),
        cmocka_unit_test(test_commands_are_known),
        cmocka_unit_test(test_both_messages_of_one_viewer_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
