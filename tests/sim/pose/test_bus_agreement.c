// SPDX-License-Identifier: Apache-2.0
// Tests of what monitor and check say of bus time and of boards that must show the same: all well, and each fault.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/bus_said.h"

enum { RATE = 60, LENGTH_S = 4, BOARDS = 3, NEVER = -1 };

/* A tracker and three boards; what goes wrong is chosen by the test. */
typedef struct {
    bus_watch_t watch;
    bool no_capture_times, no_sync, no_follow_up, no_step[BOARDS + 1];
    uint8_t master, origin;
    int new_master_at;            /* the refresh from which on another board gives bus time, and */
    int differs_from, differs_to; /* those in which board 2 shows another: */
    int other_picture, other_pose_us;
    bool other_tag;
    int out_of_step_from; /* the refresh from which on board 3 is not in step */
    bool frozen;          /* board 3 is, by an operator */
    can_time_state_t state;
    uint32_t error_us;
} scene_t;

static scene_t scene(void)
{
    scene_t made = {.new_master_at = NEVER,
                    .differs_from = NEVER,
                    .differs_to = NEVER,
                    .out_of_step_from = LENGTH_S * RATE,
                    .state = CAN_TIME_LOCKED,
                    .error_us = 34};
    bus_watch_init(&made.watch, 500000, 2000000);
    return made;
}

static int64_t time_us(int refresh)
{
    return 1000000 + (int64_t)refresh * 1000000 / RATE;
}

static void send(scene_t *scene, bool encoded, hal_can_frame_t *frame, int64_t at_us)
{
    assert_true(encoded);
    frame->time_us = at_us;
    bus_watch_take(&scene->watch, frame);
}

static void send_pose(scene_t *scene, int refresh)
{
    hal_can_frame_t frame;
    const can_pose_t pose = {.pose.quaternion_q30 = {1 << 30, 0, 0, 0},
                             .capture_time_us = scene->no_capture_times ? 0 : (uint64_t)time_us(refresh) - 4000,
                             .quality = CAN_POSE_TRACKED,
                             .counter = (uint8_t)refresh};
    send(scene, can_pose_fd_encode(&frame, &pose), &frame, time_us(refresh));
}

static void send_bus_time(scene_t *scene, int refresh)
{
    hal_can_frame_t frame;
    const bool changed = scene->new_master_at != NEVER && refresh >= scene->new_master_at;
    const uint8_t number = changed ? BOARDS : scene->master, counter = (uint8_t)(refresh / 6 % 15);
    const can_sync_t sync = {.number = number, .counter = counter, .origin = scene->origin};
    const can_follow_up_t follow_up = {.number = number, .counter = counter, .time_us = (uint64_t)time_us(refresh)};
    if (!scene->no_sync)
        send(scene, can_sync_encode(&frame, &sync), &frame, time_us(refresh) + 300);
    if (!scene->no_sync && !scene->no_follow_up)
        send(scene, can_follow_up_encode(&frame, &follow_up), &frame, time_us(refresh) + 600);
}

static void send_step(scene_t *scene, int refresh, uint8_t node)
{
    hal_can_frame_t frame;
    const bool other = node == 2 && refresh >= scene->differs_from && refresh < scene->differs_to;
    const can_step_t step = {.node = node,
                             .in_step = node != BOARDS || refresh < scene->out_of_step_from,
                             .tagged = other && scene->other_tag,
                             .refresh = 65400 + (uint32_t)refresh, /* wraps within */
                             .picture = (uint32_t)(refresh + (other ? scene->other_picture : 0)),
                             .pose_us = (uint64_t)(refresh * 16600 + (other ? scene->other_pose_us : 0))};
    if (!scene->no_step[node])
        send(scene, can_step_encode(&frame, &step), &frame, time_us(refresh) + 1000 + 300 * node);
}

static void send_board(scene_t *scene, int refresh, uint8_t node)
{
    hal_can_frame_t frame;
    const int64_t at_us = time_us(refresh) + 2000 + 900 * node;
    const can_heartbeat_t heartbeat = {.node = node,
                                       .state = node == 3 && scene->frozen ? CAN_BOARD_FROZEN : CAN_BOARD_RUNNING};
    const can_time_t time = {.node = node,
                             .state = node == 2 ? scene->state : CAN_TIME_LOCKED,
                             .master = scene->master,
                             .drift_ppb = -12300,
                             .error_us = node == 2 ? scene->error_us : 20,
                             .relocks = 3,
                             .lost = 5};
    if (refresh % 30 == 0)
        send(scene, can_heartbeat_encode(&frame, &heartbeat), &frame, at_us);
    if (refresh % 60 == 0)
        send(scene, can_time_encode(&frame, &time), &frame, at_us + 300);
    if (refresh % CAN_STEP_EVERY == 0)
        send_step(scene, refresh, node);
}

static void play(scene_t *scene)
{
    hal_can_frame_t frame;
    const can_frame_clock_t clock = {.node = 1, .epoch = 3}, to_come = {.node = 1, .epoch = 4, .to_come = true};
    send(scene, can_frame_clock_encode(&frame, &clock), &frame, time_us(0));
    send(scene, can_frame_clock_encode(&frame, &to_come), &frame, time_us(0));
    for (int refresh = 0; refresh < LENGTH_S * RATE; refresh++) {
        send_pose(scene, refresh);
        if (refresh % 6 == 0)
            send_bus_time(scene, refresh);
        for (uint8_t node = 1; node <= BOARDS; node++)
            send_board(scene, refresh, node);
    }
}

static void assert_said(const scene_t *scene, int bad, const char *expected)
{
    bus_said(&scene->watch, BUS_CHECK_NO_DELAY, bad, expected);
}

static void assert_shown(const scene_t *scene, const char *expected)
{
    bus_shown(&scene->watch, expected);
}

static void test_all_is_well(void **state)
{
    (void)state;
    scene_t s = scene();
    play(&s);
    assert_said(&s, 0, "ok   bus time: given by number 0, 40 pairs");
    assert_said(&s, 0, "ok   frames: 40 refreshes compared, all boards in step showed the same");
    assert_shown(&s, "bus time: from 0, begun by 0; 10.0 pairs a second, 0 Syncs alone, 0 changes of who gives it\n");
    assert_shown(&s, "frames: board 1 leads, epoch 3; 3 of 3 boards in step; 40 refreshes compared, 0 differed\n");
    assert_shown(&s, " board  time      from error_us drift_ppm  lost  relocks  in_step  refresh  picture\n"
                     "     1  locked       0       20    -12.30     5        3  100.0 %       98      234\n"
                     "     2  locked       0       34    -12.30     5        3  100.0 %       98      234\n");
}

static void test_bus_time_that_is_missing_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    s.no_sync = true;
    play(&s);
    assert_said(&s, 1, "BAD  bus time: nobody gives it, so capture times are of no use");

    s = scene();
    s.no_follow_up = true;
    play(&s);
    assert_said(&s, 1, "BAD  bus time: nobody gives it");
    assert_shown(&s, "bus time: from nobody; 0.0 pairs a second, 39 Syncs alone");

    s = scene();
    s.no_sync = s.no_capture_times = true;
    play(&s);
    assert_said(&s, 0, "ok   viewer 0");

    s = scene();
    s.master = s.origin = 2;
    play(&s);
    assert_said(&s, 1, "BAD  bus time: board 2's own clock");

    s = scene();
    s.new_master_at = 120;
    play(&s);
    assert_said(&s, 1, "BAD  bus time: who gives it changed 1 times");
    assert_shown(&s, "bus time: from 3, begun by 0; 10.0 pairs a second, 0 Syncs alone, 1 changes");
}

static void test_a_board_without_bus_time_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    s.state = CAN_TIME_NONE;
    play(&s);
    assert_said(&s, 1, "BAD  board 2: has no bus time");

    s = scene();
    s.state = CAN_TIME_HOLDOVER;
    play(&s);
    assert_said(&s, 1, "BAD  board 2: does not hear number 0, whose bus time it had");

    s = scene();
    s.error_us = 1001;
    play(&s);
    assert_said(&s, 1, "BAD  board 2: its bus time may be off by 1001 us, expected at most 1000");

    s = scene();
    s.error_us = 1000;
    play(&s);
    assert_said(&s, 0, "ok   board 2");
}

static void test_boards_that_differ_are_said(void **state)
{
    (void)state;
    for (int what = 0; what < 3; what++) {
        scene_t s = scene();
        s.differs_from = 60;
        s.differs_to = 78;
        s.other_picture = what == 0 ? 1 : 0;
        s.other_pose_us = what == 1 ? 100 : 0;
        s.other_tag = what == 2;
        play(&s);
        assert_said(&s, 1, "BAD  frames: boards in step differed at 3 of 40 refreshes");
        assert_shown(&s, "3 of 3 boards in step; 40 refreshes compared, 3 differed\n");
    }
}

static void test_a_board_out_of_step_is_said_and_not_compared(void **state)
{
    (void)state;
    scene_t s = scene();
    s.out_of_step_from = 180;
    s.no_step[2] = true;
    play(&s);
    assert_said(&s, 2, "BAD  board 3: in step in 75.0 % of its Steps");
    assert_said(&s, 2, "BAD  board 2: sends no Step, as others do");
    assert_said(&s, 2, "ok   frames: 30 refreshes compared");
    assert_shown(&s, "1 of 2 boards in step; 30 refreshes compared, 0 differed\n");
    assert_shown(&s, "     2  locked       0       34    -12.30     5        3        -        -        -\n");

    s = scene();
    s.out_of_step_from = 180;
    s.frozen = true;
    play(&s);
    assert_said(&s, 1, "BAD  board 3: an operator has frozen its picture");

    s = scene();
    s.out_of_step_from = 0;
    s.no_step[2] = true;
    play(&s);
    assert_said(&s, 3, "BAD  frames: 0 refreshes compared; no two boards were in step");

    s = scene();
    s.no_step[1] = s.no_step[2] = s.no_step[3] = true;
    play(&s);
    assert_said(&s, 0, "ok   board 3"); /* boards of a firmware that does not know it */
}

/* The same number 18 minutes later, and the same board twice. */
static void test_only_what_belongs_together_is_compared(void **state)
{
    (void)state;
    step_watch_t watch = {.compared = 0};
    can_step_t step = {.node = 1, .in_step = true, .refresh = 6, .picture = 6};
    step_watch_take(&watch, &step, 0);
    step.picture = 7;
    step_watch_take(&watch, &step, 16667);
    assert_true(watch.compared == 0 && watch.differing == 0);
    step.node = CAN_MAX_NODE;
    step_watch_take(&watch, &step, STEP_WATCH_OPEN_US + 1);
    assert_true(watch.compared == 0 && watch.differing == 0);
    step.node = 2;
    step_watch_take(&watch, &step, STEP_WATCH_OPEN_US + 2);
    step.node = 3;
    step_watch_take(&watch, &step, STEP_WATCH_OPEN_US + 3);
    assert_true(watch.compared == 1 && watch.differing == 0);
    step.picture = 8;
    for (uint8_t node = 4; node < 6; node++) {
        step.node = node;
        step_watch_take(&watch, &step, STEP_WATCH_OPEN_US + 4);
    }
    assert_true(watch.compared == 1 && watch.differing == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_is_well),
        cmocka_unit_test(test_bus_time_that_is_missing_is_said),
        cmocka_unit_test(test_a_board_without_bus_time_is_said),
        cmocka_unit_test(test_boards_that_differ_are_said),
        cmocka_unit_test(test_a_board_out_of_step_is_said_and_not_compared),
        cmocka_unit_test(test_only_what_belongs_together_is_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
