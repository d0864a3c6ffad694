// SPDX-License-Identifier: Apache-2.0
// Tests of what monitor and check say of boards' latency, of why they are not in step, and of what they have counted.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/bus_check.h"
#include "sim/pose/bus_table.h"

/* A bus that board 1 and board 2 report on. */
typedef struct {
    bus_watch_t watch;
    int64_t now_us;
} scene_t;

static void send(scene_t *scene, bool encoded, hal_can_frame_t *frame)
{
    assert_true(encoded);
    frame->time_us = scene->now_us += 1000;
    bus_watch_take(&scene->watch, frame);
}

static void send_latency(scene_t *scene, can_latency_t latency)
{
    hal_can_frame_t frame;
    send(scene, can_latency_encode(&frame, &latency), &frame);
}

static void send_counts(scene_t *scene, can_counts_t counts)
{
    hal_can_frame_t frame;
    send(scene, can_counts_encode(&frame, &counts), &frame);
}

static void send_heartbeat(scene_t *scene, uint8_t node, uint32_t uptime_s)
{
    hal_can_frame_t frame;
    const can_heartbeat_t heartbeat = {.node = node, .state = CAN_BOARD_RUNNING, .uptime_s = uptime_s};
    send(scene, can_heartbeat_encode(&frame, &heartbeat), &frame);
}

static scene_t scene(void)
{
    scene_t made = {.now_us = 0};
    bus_watch_init(&made.watch, 500000, 2000000);
    send_heartbeat(&made, 1, 100);
    send_heartbeat(&made, 2, 100);
    return made;
}

static char *text_of(const scene_t *scene, bool table)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    if (table)
        bus_table_print(file, "can0", &scene->watch);
    else
        (void)bus_check_print(file, &scene->watch, BUS_CHECK_NO_DELAY);
    assert_int_equal(fclose(file), 0);
    return text;
}

static void expect(const scene_t *scene, bool table, const char *expected, bool there)
{
    char *text = text_of(scene, table);
    if ((strstr(text, expected) != NULL) != there)
        fail_msg("\"%s\" is %s:\n%s", expected, there ? "not in" : "in", text);
    free(text);
}

static void test_latency_is_said(void **state)
{
    (void)state;
    scene_t s = scene();
    expect(&s, false, "latency:", false);
    expect(&s, true, "late_ms", false);
    send_latency(&s, (can_latency_t){.node = 1, .photon_us = 27250, .lag_us = 8320});
    send_latency(&s, (can_latency_t){.node = 2,
                                     .fault = CAN_STEP_PICTURE,
                                     .held = 3,
                                     .genlocked = true,
                                     .photon_us = 60500,
                                     .lag_us = 25024,
                                     .display_us = 33500,
                                     .wanted_ms = 0,
                                     .off_us = -256});
    expect(&s, false,
           "ok   latency: pose to photon 27.2 ms (board 1) to 60.5 ms (board 2); `wallwarp-pose command --node all "
           "latency 1` makes all as late\n",
           true);
    expect(
        &s, true,
        " board  why         late_ms  held  lag_ms  display  wanted  off_us house tags_lost guessed leaders missed "
        "commands\n"
        "     1  in step       27.25     0     8.3      0.0       0       0 no            -       -       -      -    "
        "    -\n"
        "     2  no picture    60.50     3    25.0     33.5       0    -256 yes           -       -       -      -    "
        "    -\n",
        true);
    send_latency(&s, (can_latency_t){.node = 1, .photon_us = 59500, .wanted_ms = 1});
    expect(&s, false, "latency: pose to photon 59.5 ms (board 1) to 60.5 ms (board 2)\n", true);
}

static void test_why_is_said(void **state)
{
    (void)state;
    static const struct {
        can_step_fault_t fault;
        const char *advice;
    } CASE[] = {
        {CAN_STEP_OK, "expected 100; its bus time, and its panel's refresh rate?"},
        {CAN_STEP_NO_TIME, "expected 100; now it has no exact bus time"},
        {CAN_STEP_NO_CLOCK, "expected 100; now it hears nobody who leads"},
        {CAN_STEP_PANEL, "expected 100; now its panel's refreshes begin at another time"},
        {CAN_STEP_PICTURE, "expected 100; now its camera does not deliver"},
        {CAN_STEP_POSE, "expected 100; now the pose that is due is missing"},
        {CAN_STEP_NOT_SHOWN, "expected 100; now its panel does not show"},
    };
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        scene_t s = scene();
        hal_can_frame_t frame;
        send(&s, can_step_encode(&frame, &(can_step_t){.node = 2}), &frame);
        send_latency(&s, (can_latency_t){.node = 2, .fault = CASE[i].fault});
        expect(&s, false, CASE[i].advice, true);
    }
}

/* Only what came since it was listened to; counts wrap, and begin anew with the board. */
static void test_counts_are_said(void **state)
{
    (void)state;
    scene_t s = scene();
    send_counts(&s, (can_counts_t){.node = 2, .tags_lost = 4090, .guessed = 7, .leaders = 255, .epochs_missed = 3});
    expect(&s, false, "board 2: running", true);
    send_counts(
        &s,
        (can_counts_t){
            .node = 2, .tags_lost = 4096 + 4, .guessed = 9, .leaders = 256, .epochs_missed = 6, .command_faults = 5});
    expect(&s, false, "BAD  board 2: 10 pictures whose code could not be read", true);
    expect(&s, false, "BAD  board 2: 2 pictures shown for a guessed pose", true);
    expect(&s, false, "BAD  board 2: 1 changes of the board that leads", true);
    expect(&s, false, "BAD  board 2: 3 changes of the frame clock missed", true);
    expect(&s, false, "BAD  board 2: 5 commands or replies", true);
    expect(&s, false, "board 2: running", false);
    expect(&s, true, "         4       9       0      6        5\n", true);
    send_heartbeat(&s, 2, 1);
    send_counts(&s, (can_counts_t){.node = 2, .tags_lost = 1});
    expect(&s, false, "code could not be read", false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_latency_is_said),
        cmocka_unit_test(test_why_is_said),
        cmocka_unit_test(test_counts_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
