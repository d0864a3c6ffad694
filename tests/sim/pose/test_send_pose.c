// SPDX-License-Identifier: Apache-2.0
// Tests of the example sender: what it says it would send is what a board takes, pose by pose, and knows the time of.
#include <libgen.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/pose_from_can.h"
#include "sim/bus/candump_text.h"

enum { POSES = 240, WALK_S = 10, START_US = 1000000, PAIRS = 8 };

/* A board that listens. */
typedef struct {
    can_poses_t poses;
    bus_master_t time;
    can_faults_t faults;
    int frames, pairs;
} board_t;

static char *folder; /* of this program, and of the example */

/* The walk of the example. */
static void assert_on_walk(const can_pose_t *pose, int n, double mm, double component)
{
    const double turn = 2 * M_PI * n / POSES / WALK_S;
    const double eye[3] = {1500 * sin(turn), -1700, -1500 * cos(turn)};
    const double q[4] = {cos(turn / 2), 0, -sin(turn / 2), 0};
    for (int i = 0; i < 3; i++)
        assert_true(fabs((double)pose->pose.eye_nm[i] / 1e6 - eye[i]) <= mm);
    for (int i = 0; i < 4; i++)
        assert_true(fabs(pose->pose.quaternion_q30[i] / 1073741824.0 - q[i]) <= component);
    assert_int_equal(pose->quality, CAN_POSE_TRACKED);
}

/* Its stamps are the lines' times. */
static void board_hears(board_t *board, const char *line)
{
    char interface[CANDUMP_INTERFACE_LENGTH];
    hal_can_frame_t frame;
    can_follow_up_t follow_up;
    assert_null(candump_frame_from_text(&frame, interface, line));
    if (bus_master_hear(&board->time, &frame) == CAN_CHECK_OTHER)
        assert_true(pose_from_frame(&board->poses, &board->time, &frame, &board->faults));
    board->frames++;
    board->pairs += can_follow_up_decode(&follow_up, &frame) == CAN_CHECK_OK;
}

static void listen_to(const char *arguments, int parts, double mm, double component)
{
    char command[512], line[CANDUMP_TEXT_LENGTH];
    board_t board = {.poses.viewer = 0};
    bus_master_init(&board.time, 1, START_US);
    snprintf(command, sizeof command, "'%s/send_pose' %s", folder, arguments);
    FILE *sender = popen(command, "r");
    assert_non_null(sender);
    int poses = 0, captured = 0;
    while (fgets(line, sizeof line, sender) != NULL) {
        board_hears(&board, line);
        if (!board.poses.any)
            continue;
        assert_on_walk(&board.poses.newest, poses++, mm, component);
        const int64_t early_us = board.poses.received_us - (int64_t)board.poses.newest.capture_time_us;
        assert_in_range(early_us, 0, 99); /* sets carry 100 us */
        if (board.poses.captured) {
            const int64_t received_us = bus_time_from_local(&board.time.time, board.poses.received_us);
            assert_in_range(received_us - board.poses.capture_bus_us, 0, 101);
            captured++;
        }
        board.poses.any = board.poses.captured = false;
    }
    assert_int_equal(pclose(sender), 0);
    assert_int_equal(poses, POSES);
    assert_int_equal(board.pairs, PAIRS);
    assert_int_equal(board.frames, parts * POSES + 2 * PAIRS);
    assert_true(board.time.following && board.time.master == BUS_MASTER_TRACKER);
    assert_true(board.time.lost == 0 && board.time.mismatched == 0);
    assert_int_equal(captured, POSES - 5 * POSES / PAIRS); /* bus time is good enough from the sixth pair on */
    assert_int_equal(can_faults_total(&board.faults), 0);
}

static void test_fd(void **state)
{
    (void)state;
    listen_to("-", 1, 0.0005001, 1.2e-7);
}

static void test_classic(void **state)
{
    (void)state;
    listen_to("- classic", CAN_POSE_PARTS, 0.005001, 3.1e-5);
}

static void test_bad_usage(void **state)
{
    (void)state;
    char command[512];
    snprintf(command, sizeof command, "'%s/send_pose' 2>/dev/null", folder);
    assert_int_not_equal(system(command), 0);
    snprintf(command, sizeof command, "'%s/send_pose' no_such_can 2>/dev/null", folder);
    assert_int_not_equal(system(command), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fd),
        cmocka_unit_test(test_classic),
        cmocka_unit_test(test_bad_usage),
    };
    (void)argc;
    folder = dirname(argv[0]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
