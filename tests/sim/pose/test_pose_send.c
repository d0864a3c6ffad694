// SPDX-License-Identifier: Apache-2.0
// Tests of a pose list on its way onto a bus: every pose, in its own time, until the end or a stop.
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "sim/pose/pose_send.h"
#include "tests/support/fake_server.h"

static const pose_list_entry_t WALK[] = {
    {.time_us = 5000000, .pose = {.eye_nm = {1000000, 0, -2000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}}},
    {.time_us = 5000000, .pose = {.eye_nm = {2000000, 0, -2000000}, .quaternion_q30 = {0, 1 << 30, 0, 0}}},
    {.time_us = 5030000, .pose = {.eye_nm = {3000000, 0, -2000000}, .quaternion_q30 = {0, 0, 0, -(1 << 30)}}},
};
enum { STEPS = sizeof WALK / sizeof WALK[0] };
static const volatile sig_atomic_t going_on = 0;

/* Reads the next "< send ... >" and moves on behind it. */
static hal_can_frame_t next_frame(const char **text)
{
    hal_can_frame_t frame = {0};
    unsigned id = 0;
    unsigned length = 0;
    unsigned byte[8] = {0};
    int used = 0;
    assert_int_equal(sscanf(*text, "< send %x %x %x %x %x %x %x %x %x %x >%n", &id, &length, &byte[0], &byte[1],
                            &byte[2], &byte[3], &byte[4], &byte[5], &byte[6], &byte[7], &used),
                     10);
    frame.id = id;
    frame.length = (uint8_t)length;
    for (int i = 0; i < 8; i++)
        frame.data[i] = (uint8_t)byte[i];
    *text += used;
    return frame;
}

static void test_a_list_arrives_pose_by_pose_with_rising_times(void **state)
{
    (void)state;
    static fake_server_t server;
    fake_server_start(&server, "< hi >", "< ok >");
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(pose_send_check(&(pose_send_t){.list = &list}, error));
    assert_true(pose_link_open(&link, server.address, false, error));
    size_t sent = 0;
    struct timespec before;
    assert_int_equal(clock_gettime(CLOCK_MONOTONIC, &before), 0);
    const uint64_t before_us = (uint64_t)before.tv_sec * 1000000 + (uint64_t)before.tv_nsec / 1000;
    assert_true(pose_send_list(&link, &(pose_send_t){.list = &list, .stop = &going_on}, &sent, error));
    assert_int_equal(sent, STEPS);
    pose_link_close(&link);
    fake_server_stop(&server);

    const char *text = server.heard + strlen("< open can0 >< rawmode >");
    can_pose_t got[STEPS];
    for (int i = 0; i < STEPS; i++) {
        hal_can_frame_t part[CAN_POSE_PARTS];
        for (int k = 0; k < CAN_POSE_PARTS; k++)
            part[k] = next_frame(&text);
        assert_int_equal(can_pose_set_decode(&got[i], part, 0), CAN_CHECK_OK);
        assert_memory_equal(got[i].pose.eye_nm, WALK[i].pose.eye_nm, sizeof WALK[i].pose.eye_nm);
        assert_int_equal(got[i].quality, CAN_POSE_TRACKED);
        assert_int_equal(got[i].counter, (got[0].counter + i) % CAN_E2E_P01_COUNTERS);
    }
    assert_string_equal(text, "");
    /* Never early; how late is the machine's affair. */
    const uint64_t since_us =
        (got[2].capture_time_us + CAN_POSE_SET_WRAP_US - before_us % CAN_POSE_SET_WRAP_US) % CAN_POSE_SET_WRAP_US;
    assert_true(since_us >= 29900);
}

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static void test_a_stop_ends_a_list_before_its_end(void **state)
{
    (void)state;
    static fake_server_t server;
    fake_server_start(&server, "< hi >", "< ok >");
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    entry[2].time_us += INT64_C(3600000000);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(pose_link_open(&link, server.address, false, error));
    signal(SIGALRM, request_stop);
    alarm(1);
    size_t sent = STEPS;
    assert_true(pose_send_list(&link, &(pose_send_t){.list = &list, .stop = &stop_requested}, &sent, error));
    pose_link_close(&link);
    fake_server_stop(&server);
    assert_true(sent < STEPS);
    const char *text = server.heard + strlen("< open can0 >< rawmode >");
    for (size_t i = 0; i < sent * CAN_POSE_PARTS; i++)
        (void)next_frame(&text);
    assert_string_equal(text, "");
}

static void test_poses_that_do_not_fit_are_found_before_sending(void **state)
{
    (void)state;
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    entry[1].pose.eye_nm[2] = INT64_C(90000000000);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_false(pose_send_check(&(pose_send_t){.list = &list}, error));
    assert_non_null(strstr(error, "pose 2: farther than 83.886 m"));
    assert_true(pose_send_check(&(pose_send_t){.list = &list, .fd = true}, error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_list_arrives_pose_by_pose_with_rising_times),
        cmocka_unit_test(test_a_stop_ends_a_list_before_its_end),
        cmocka_unit_test(test_poses_that_do_not_fit_are_found_before_sending),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
