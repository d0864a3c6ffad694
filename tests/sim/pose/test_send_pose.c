// SPDX-License-Identifier: Apache-2.0
// Tests of the example sender: what it says it would send is what a board takes, pose by pose.
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

enum { POSES = 240, WALK_S = 10 };

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

static void listen_to(const char *arguments, int parts, double mm, double component)
{
    char command[512], line[CANDUMP_TEXT_LENGTH], interface[CANDUMP_INTERFACE_LENGTH];
    snprintf(command, sizeof command, "'%s/send_pose' %s", folder, arguments);
    FILE *sender = popen(command, "r");
    assert_non_null(sender);
    can_poses_t poses = {.viewer = 0};
    can_faults_t faults = {.length = 0};
    int frames = 0;
    for (; fgets(line, sizeof line, sender) != NULL; frames++) {
        hal_can_frame_t frame;
        assert_null(candump_frame_from_text(&frame, interface, line));
        assert_true(pose_from_frame(&poses, NULL, &frame, &faults));
        if (frames % parts < parts - 1)
            continue;
        assert_true(poses.any);
        assert_on_walk(&poses.newest, frames / parts, mm, component);
        const int64_t early_us = frame.time_us - (int64_t)poses.newest.capture_time_us;
        assert_in_range(early_us, 0, 99); /* sets carry 100 us */
        poses.any = false;
    }
    assert_int_equal(pclose(sender), 0);
    assert_int_equal(frames, parts * POSES);
    assert_int_equal(can_faults_total(&faults), 0);
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
