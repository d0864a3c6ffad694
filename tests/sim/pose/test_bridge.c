// SPDX-License-Identifier: Apache-2.0
// Tests of the bridge: each protocol's worked example, from its packet to the pose in the room; times, and counts.
#include "sim/pose/bridge.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/scratch.h"
#include "tests/support/tracker_packets.h"

enum { ARRIVED_US = 50000000 };

static bridge_t bridge;
static can_pose_t message[TRACKER_MAX_POSES];

/* Begins with a file of the examples. */
static void begin(const char *protocol, const char *path)
{
    tracker_transform_t transform;
    char error[ROOM_MESSAGE_LENGTH] = "";
    if (!tracker_transform_load(&transform, path, error))
        fail_msg("%s", error);
    assert_non_null(tracker_protocol_named(protocol));
    bridge_init(&bridge, tracker_protocol_named(protocol), &transform);
}

static int take(const tracker_bytes_t *packet, int64_t arrived_us)
{
    return bridge_packet(&bridge, packet->bytes, packet->size, arrived_us, message);
}

static void expect_eye(const can_pose_t *pose, double x_mm, double y_mm, double z_mm)
{
    const double expected[3] = {x_mm, y_mm, z_mm};
    for (int i = 0; i < 3; i++)
        if (!(fabs((double)pose->pose.eye_nm[i] / 1e6 - expected[i]) <= 0.001))
            fail_msg("eye[%d] is %.6f mm, expected %.6f", i, (double)pose->pose.eye_nm[i] / 1e6, expected[i]);
}

static void expect_quaternion(const can_pose_t *pose, double w, double x, double y, double z)
{
    const double expected[4] = {w, x, y, z};
    for (int i = 0; i < 4; i++)
        if (!(fabs(pose->pose.quaternion_q30[i] / 1073741824.0 - expected[i]) <= 2e-5))
            fail_msg("quaternion[%d] is %.7f, expected %.7f", i, pose->pose.quaternion_q30[i] / 1073741824.0,
                     expected[i]);
}

/* Panned to the right by 90 degrees, the viewer turns by 90 degrees about y, which is down: w = y = sqrt(1/2). The eye
 * is 80 mm ahead, now along x, and 120 mm below. */
static void test_the_example_of_freed(void **state)
{
    (void)state;
    begin("freed", "sim/trackers/examples/freed.yaml");
    const tracker_bytes_t packet =
        tracker_bytes_freed(1, (const double[3]){90, 0, 0}, (const double[3]){1000, 2000, 1700});
    assert_int_equal(take(&packet, ARRIVED_US), 1);
    expect_eye(&message[0], 1080, -1580, 1500);
    expect_quaternion(&message[0], 0.7071068, 0, 0.7071068, 0);
    assert_int_equal(message[0].viewer, 0);
    assert_int_equal(message[0].quality, CAN_POSE_TRACKED);
    assert_int_equal(message[0].capture_time_us, ARRIVED_US);
    const tracker_bytes_t other = tracker_bytes_freed(2, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 0});
    assert_int_equal(take(&other, ARRIVED_US), 0);
    assert_int_equal(bridge.counts.others, 1);
}

/* Body 0 is upright at (326.848, -187.216, 109.503); body 3 is worn by the second viewer, turned by a quarter. */
static void test_the_example_of_dtrack(void **state)
{
    (void)state;
    begin("dtrack", "sim/trackers/examples/dtrack.yaml");
    tracker_bytes_t packet = {.size = 0};
    static const char text[] = "fr 21753\r\nts 39596.024831\r\n6d 2 [0 1.000][326.848 -187.216 109.503 0 0 0]"
                               "[1 0 0 0 1 0 0 0 1][3 1.0][100 200 300 0 0 0][0 0 1 0 1 0 -1 0 0]\r\n";
    tracker_bytes_add(&packet, text, strlen(text));
    assert_int_equal(take(&packet, ARRIVED_US), 2);
    expect_eye(&message[0], 326.848, 187.216, -109.503);
    expect_quaternion(&message[0], 1, 0, 0, 0);
    assert_int_equal(message[0].capture_time_us, ARRIVED_US - 8000);
    /* its x axis is the room's z, its z axis the room's -x: 60 mm along x is 60 towards the tracker's z */
    expect_eye(&message[1], 100, -160, -360);
    /* its right (+z) is -x of the tracker, its forward (+x) is +z: half a turn about y */
    expect_quaternion(&message[1], 0, 0, 1, 0);
    assert_int_equal(message[1].viewer, 1);
}

/* Turned by pi / 2 about y, in left-handed axes that is to the right. The eye is 100 mm below and 50 ahead. */
static void test_the_example_of_posistagenet(void **state)
{
    (void)state;
    begin("psn", "sim/trackers/examples/psn.yaml");
    tracker_bytes_t packet =
        tracker_bytes_psn(1000, 7, (const float[3]){1, 1.75F, 2}, (const float[3]){0, 1.5707964F, 0}, 1);
    assert_int_equal(take(&packet, ARRIVED_US), 1);
    expect_eye(&message[0], 1050, -1650, 2000);
    expect_quaternion(&message[0], 0.7071068, 0, 0.7071068, 0);
    packet = tracker_bytes_psn(2000, 7, (const float[3]){1, 1.75F, 2}, (const float[3]){0, 0, 0}, 0);
    assert_int_equal(take(&packet, ARRIVED_US + 1500), 1);
    assert_int_equal(message[0].quality, CAN_POSE_LOST);
    expect_eye(&message[0], 0, 0, 0);
    expect_quaternion(&message[0], 1, 0, 0, 0);
    assert_int_equal(message[0].capture_time_us, ARRIVED_US + 1000);
}

/* The mount looks 10 degrees down, the file turns that up again: the viewer looks straight. */
static void test_the_example_of_opentrackio(void **state)
{
    (void)state;
    begin("opentrackio", "sim/trackers/examples/opentrackio.yaml");
    static const char sample[] =
        "{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":14,\"transforms\":[{"
        "\"translation\":{\"x\":0.25,\"y\":-2,\"z\":1.7},\"rotation\":{\"pan\":0,\"tilt\":-10,\"roll\":0}}]}";
    const tracker_bytes_t packet =
        tracker_bytes_opentrackio(&(tracker_bytes_segment_t){1, 1, 0, true}, sample, strlen(sample));
    assert_int_equal(take(&packet, ARRIVED_US), 1);
    expect_eye(&message[0], 250, -1700, -2000);
    expect_quaternion(&message[0], 1, 0, 0, 0);
    assert_int_equal(message[0].viewer, 0);
}

/* In cm. Turned by 90 degrees about x, which is to look up: in the room about x too. */
static void test_the_example_of_osc(void **state)
{
    (void)state;
    begin("osc", "sim/trackers/examples/osc.yaml");
    const double value[8] = {12.5, 170, 200, 0.70710678, 0.70710678, 0, 0, 2};
    const tracker_bytes_t packet = tracker_bytes_osc("/pose", "fffffffi", value);
    assert_int_equal(take(&packet, ARRIVED_US), 1);
    expect_eye(&message[0], 125, -1700, -2000);
    expect_quaternion(&message[0], 0.7071068, 0.7071068, 0, 0);
    assert_int_equal(message[0].quality, CAN_POSE_PREDICTED);
}

static void test_late_and_repeated_poses_are_left_out(void **state)
{
    (void)state;
    begin("psn", "sim/trackers/examples/psn.yaml");
    static const struct {
        uint64_t time_us;
        int made;
    } step[] = {{5000000, 1}, {5000000, 0}, {4999999, 0}, {5005000, 1}, {5004999, 0}, {4005000, 0}, /* a second late */
                {4004999, 1}, /* more: the server's clock has been set back */
                {4005000, 1}};
    int old = 0;
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        const tracker_bytes_t packet =
            tracker_bytes_psn(step[i].time_us, 7, (const float[3]){0, 0, 0}, (const float[3]){0, 0, 0}, 1);
        assert_int_equal(take(&packet, ARRIVED_US + (int64_t)i * 5000), step[i].made);
        old += 1 - step[i].made;
    }
    assert_int_equal(bridge.counts.refused[TRACKER_REPEATED], old);
    assert_int_equal(bridge.counts.packets, sizeof step / sizeof step[0]);
}

static void test_what_gives_no_pose_is_counted_and_said(void **state)
{
    begin("freed", "sim/trackers/examples/freed.yaml");
    tracker_bytes_t packet = tracker_bytes_freed(1, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 0});
    packet.bytes[5] ^= 1;
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    packet.size = 28;
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    packet.size = 0;
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    packet = tracker_bytes_freed(9, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 0});
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "counts", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    bridge_counts_print(file, &bridge.counts);
    fclose(file);
    size_t length = 0;
    uint8_t *text = scratch_read(path, &length);
    static const char expected[] = "wrong length: 2\nwrong checksum: 2\nbodies that no viewer wears: 1\n";
    assert_int_equal(length, strlen(expected));
    assert_memory_equal(text, expected, length);
    free(text);
}

static void test_poses_beyond_a_kilometre_are_counted(void **state)
{
    (void)state;
    begin("osc", "sim/trackers/examples/osc.yaml");
    const double value[7] = {100000.1, 0, 0, 1, 0, 0, 0};
    const tracker_bytes_t packet = tracker_bytes_osc("/pose", "ddddddd", value);
    assert_int_equal(take(&packet, ARRIVED_US), 0);
    assert_int_equal(bridge.counts.too_far, 1);
    assert_int_equal(bridge.counts.poses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_example_of_freed),
        cmocka_unit_test(test_the_example_of_dtrack),
        cmocka_unit_test(test_the_example_of_posistagenet),
        cmocka_unit_test(test_the_example_of_opentrackio),
        cmocka_unit_test(test_the_example_of_osc),
        cmocka_unit_test(test_late_and_repeated_poses_are_left_out),
        cmocka_unit_test(test_what_gives_no_pose_is_counted_and_said),
        cmocka_unit_test(test_poses_beyond_a_kilometre_are_counted),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
