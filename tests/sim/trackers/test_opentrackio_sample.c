// SPDX-License-Identifier: Apache-2.0
// Tests of OpenTrackIO's samples: poses worked out by hand, and what is refused.
#include "sim/trackers/opentrackio_sample.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"

#define PROTOCOL "\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":14,"
#define TIMING "\"timing\":{\"sampleTimestamp\":{\"seconds\":1718806554,\"nanoseconds\":500000999}},"
#define TRANSFORM "\"translation\":{\"x\":1.5,\"y\":-2,\"z\":3e-1},\"rotation\":{\"pan\":90,\"tilt\":30.0,\"roll\":0}"

static const char sample[] = "{" PROTOCOL TIMING "\"transforms\":[{" TRANSFORM ",\"id\":\"Camera\"}]}";

static tracker_check_t read_sample(tracker_packet_t *packet, const char *text)
{
    json_t *values = json_loads(text, 0, NULL);
    if (values == NULL)
        fail_msg("%s is no JSON", text);
    memset(packet, 0, sizeof *packet);
    const tracker_check_t check = opentrackio_sample_read(packet, values);
    json_decref(values);
    return check;
}

static void test_a_sample_in_json(void **state)
{
    (void)state;
    tracker_packet_t packet;
    assert_int_equal(read_sample(&packet, sample), TRACKER_OK);
    assert_int_equal(packet.count, 1);
    const tracker_pose_t *pose = &packet.pose[0];
    assert_int_equal(pose->id, 14);
    assert_int_equal(pose->quality, CAN_POSE_TRACKED);
    assert_true(pose->timed);
    assert_int_equal(pose->time_us, INT64_C(1718806554500000));
    tracker_expect_position(pose, 1.5, -2.0, 0.3);
    /* panned to the left it looks along -x, and 30 degrees up; its right is ahead of the stage */
    tracker_expect_turns(pose, (const double[3]){0, 1, 0}, (const double[3]){-0.866025, 0.0, 0.5});
    tracker_expect_turns(pose, (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
}

static void test_transforms_follow_one_another(void **state)
{
    (void)state;
    tracker_packet_t packet;
    static const char two[] =
        "{" PROTOCOL "\"transforms\":["
        "{\"translation\":{\"x\":10,\"y\":0,\"z\":0},\"rotation\":{\"pan\":90,\"tilt\":0,\"roll\":0}},"
        "{\"translation\":{\"x\":1,\"y\":2,\"z\":3},\"rotation\":{\"pan\":0,\"tilt\":90,\"roll\":0},"
        "\"scale\":{\"x\":1,\"y\":1.0,\"z\":1}}]}";
    assert_int_equal(read_sample(&packet, two), TRACKER_OK);
    tracker_expect_position(&packet.pose[0], 8, 1, 3); /* (1, 2, 3) turned to the left is (-2, 1, 3) */
    tracker_expect_turns(&packet.pose[0], (const double[3]){0, 1, 0}, (const double[3]){0, 0, 1});
    tracker_expect_turns(&packet.pose[0], (const double[3]){0, 0, 1}, (const double[3]){1, 0, 0});
}

static void test_wrong_samples_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *json;
        tracker_check_t check;
    } wrong[] = {
        {"[]", TRACKER_VERSION},
        {"{}", TRACKER_VERSION},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[2,0,0]},\"sourceNumber\":1}", TRACKER_VERSION},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":\"1.0.1\"},\"sourceNumber\":1}", TRACKER_VERSION},
        {"{\"protocol\":{\"name\":\"Other\",\"version\":[1,0,1]},\"sourceNumber\":1}", TRACKER_VERSION},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]}}", TRACKER_SYNTAX},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":0}", TRACKER_VALUE},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":201}", TRACKER_VALUE},
        {"{\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":1.0}", TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":{}}", TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":[1]}", TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":[{\"translation\":{\"x\":1,\"y\":1,\"z\":1}}]}", TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":[{\"translation\":{\"x\":1,\"y\":1},\"rotation\":{\"pan\":0,\"tilt\":0,"
         "\"roll\":0}}]}",
         TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":[{\"translation\":{\"x\":\"1\",\"y\":1,\"z\":1},\"rotation\":{\"pan\":0,"
         "\"tilt\":0,\"roll\":0}}]}",
         TRACKER_SYNTAX},
        {"{" PROTOCOL "\"transforms\":[{" TRANSFORM ",\"scale\":{\"x\":1}}]}", TRACKER_SYNTAX},
        {"{" PROTOCOL "\"timing\":{\"sampleTimestamp\":{\"seconds\":1}},\"transforms\":[{" TRANSFORM "}]}",
         TRACKER_SYNTAX},
        {"{" PROTOCOL "\"timing\":{\"sampleTimestamp\":{\"seconds\":-1,\"nanoseconds\":0}},\"transforms\":[{" TRANSFORM
         "}]}",
         TRACKER_SYNTAX},
        {"{" PROTOCOL "\"timing\":{\"sampleTimestamp\":{\"seconds\":1,\"nanoseconds\":1000000000}},\"transforms\":"
         "[{" TRANSFORM "}]}",
         TRACKER_SYNTAX},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        tracker_packet_t packet;
        const tracker_check_t check = read_sample(&packet, wrong[i].json);
        if (check != wrong[i].check)
            fail_msg("%s: \"%s\", expected \"%s\"", wrong[i].json, tracker_check_text[check],
                     tracker_check_text[wrong[i].check]);
    }
}

static void test_samples_without_a_pose_are_left_out(void **state)
{
    (void)state;
    static const struct {
        const char *json;
        tracker_check_t reason;
    } left_out[] = {
        {"{" PROTOCOL "\"lens\":{\"fStop\":4.0}}", TRACKER_INCOMPLETE},
        {"{" PROTOCOL "\"transforms\":[]}", TRACKER_INCOMPLETE},
        {"{" PROTOCOL "\"transforms\":[{" TRANSFORM ",\"scale\":{\"x\":1,\"y\":2,\"z\":1}}]}", TRACKER_VALUE},
        {"{" PROTOCOL "\"transforms\":[{\"translation\":{\"x\":1e10,\"y\":1,\"z\":1},\"rotation\":{\"pan\":0,"
         "\"tilt\":0,\"roll\":0}}]}",
         TRACKER_VALUE},
    };
    for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; i++) {
        tracker_packet_t packet;
        assert_int_equal(read_sample(&packet, left_out[i].json), TRACKER_OK);
        tracker_expect_left_out(&packet, left_out[i].reason, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sample_in_json),
        cmocka_unit_test(test_transforms_follow_one_another),
        cmocka_unit_test(test_wrong_samples_are_refused),
        cmocka_unit_test(test_samples_without_a_pose_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
