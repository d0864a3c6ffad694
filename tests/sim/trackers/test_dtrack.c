// SPDX-License-Identifier: Apache-2.0
// Tests of DTrack's ASCII output: the guide's own lines, and what is refused.
#include "sim/trackers/dtrack.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"

/* A matrix column by column: x goes to y, y to -x. */
#define QUARTER "[0 1 0 -1 0 0 0 0 1]"

static tracker_check_t decode(tracker_packet_t *packet, const char *text)
{
    memset(packet, 0, sizeof *packet);
    return dtrack_decode(packet, (const uint8_t *)text, strlen(text));
}

static void test_the_guides_example(void **state)
{
    (void)state;
    tracker_packet_t packet;
    assert_int_equal(decode(&packet, "fr 21753\r\nts 39596.024831\r\n6dcal 2\r\n"
                                     "6d 1 [0 1.000][326.848 -187.216 109.503 -160.4704 -3.6963 -7.0913]"
                                     "[-0.940508 -0.339238 -0.019025 0.333599 -0.932599 0.137735 -0.064467 0.123194 "
                                     "0.990286] \r\n"),
                     TRACKER_OK);
    assert_int_equal(packet.count, 1);
    const tracker_pose_t *pose = &packet.pose[0];
    assert_int_equal(pose->id, 0);
    assert_int_equal(pose->quality, CAN_POSE_TRACKED);
    assert_true(pose->timed);
    assert_int_equal(pose->time_us, INT64_C(39596024831));
    tracker_expect_position(pose, 326.848, -187.216, 109.503);
    tracker_expect_turns(pose, (const double[3]){1, 0, 0}, (const double[3]){-0.940508, -0.339238, -0.019025});
    tracker_expect_turns(pose, (const double[3]){0, 0, 1}, (const double[3]){-0.064467, 0.123194, 0.990286});
}

static void test_the_extended_line_tells_the_quality(void **state)
{
    (void)state;
    tracker_packet_t packet;
    assert_int_equal(decode(&packet, "fr 1\n6d 1 [5 1.0][1 2 3 0 0 0]" QUARTER "\n"
                                     "6di 4 [0 1 2.135][326.848 -187.216 109.503]" QUARTER
                                     " [1 0 0.000][0 0 0][0 0 0 0 0 0 0 0 0] [2 2 0][1 2 3]" QUARTER
                                     "[3 3 0][4 5 6]" QUARTER "\n6d 1 [5 1.0][1 2 3 0 0 0]" QUARTER "\n"),
                     TRACKER_OK);
    static const can_pose_quality_t expected[4] = {CAN_POSE_PREDICTED, CAN_POSE_LOST, CAN_POSE_TRACKED,
                                                   CAN_POSE_TRACKED};
    assert_int_equal(packet.count, 4);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(packet.pose[i].id, i);
        assert_int_equal(packet.pose[i].quality, expected[i]);
        assert_false(packet.pose[i].timed);
    }
    tracker_expect_turns(&packet.pose[3], (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
    tracker_expect_position(&packet.pose[3], 4, 5, 6);
}

static void test_packets_without_bodies_are_other_messages(void **state)
{
    (void)state;
    static const char *const text[] = {"fr 1", "fr 1\n", "fr 1\nts 5.5\n3d 1 [1 1.0][1 2 3]\n6df2 0 0\n"};
    tracker_packet_t packet;
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        assert_int_equal(decode(&packet, text[i]), TRACKER_OTHER);
    assert_int_equal(decode(&packet, "fr 1\n6d 0\n"), TRACKER_OK);
    tracker_expect_left_out(&packet, TRACKER_OK, 0);
}

static void test_malformed_text_is_refused(void **state)
{
    (void)state;
    static const char *const text[] = {
        "",
        "\n",
        "frame 1\n6d 0\n",
        "6d 0\n",
        "fr\n6d 0\n",
        "fr -1\n6d 0\n",
        "fr 1.5\n6d 0\n",
        "fr 1 2\n6d 0\n",
        "fr 1\n6d \n",
        "fr 1\n6d 1\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0 0]\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1 0]\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1] x\n",
        "fr 1\n6d 2 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1][0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [-1 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [0 1][nan 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [0 1][0x10 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6d 1 [0 1][1e 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\n6di 1 [0 4 0][1 2 3][1 0 0 0 1 0 0 0 1]\n",
        "fr 1\nts -1\n6d 0\n",
        "fr 1\nts 86401\n6d 0\n",
        "fr 1\nts 1e5\n6d 0\n",
        "fr 1\n6d 1 [0 1][1.00000000000000000000000000000001 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n",
    };
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        tracker_packet_t packet;
        if (decode(&packet, text[i]) != TRACKER_SYNTAX)
            fail_msg("\"%s\" is not malformed", text[i]);
    }
}

static void test_values_that_are_no_pose_are_left_out(void **state)
{
    (void)state;
    static const char *const body[] = {
        "[0 1][1e10 2 3 0 0 0][1 0 0 0 1 0 0 0 1]",    "[0 1][1e999 2 3 0 0 0][1 0 0 0 1 0 0 0 1]",
        "[0 1][1 2 3 0 0 0][0 0 0 0 0 0 0 0 0]",       "[0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 -1]",
        "[0 1][1 2 3 0 0 0][1.1 0 0 0 1.1 0 0 0 1.1]",
    };
    for (size_t i = 0; i < sizeof body / sizeof body[0]; i++) {
        char text[256];
        tracker_packet_t packet;
        snprintf(text, sizeof text, "fr 1\n6d 1 %s\n", body[i]);
        assert_int_equal(decode(&packet, text), TRACKER_OK);
        tracker_expect_left_out(&packet, TRACKER_VALUE, 1);
    }
}

/* Every beginning of a packet, in a place of its own size so that a sanitizer sees each byte too far. */
static void test_truncated_packets_give_no_pose(void **state)
{
    (void)state;
    static const char whole[] = "fr 1\nts 1.5\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n";
    for (size_t size = 0; size < strlen(whole) - 1; size++) {
        uint8_t *copy = test_malloc(size + 1);
        memcpy(copy + 1, whole, size);
        tracker_packet_t packet = {.count = 0};
        const tracker_check_t check = dtrack_decode(&packet, copy + 1, size);
        if (check == TRACKER_OK)
            fail_msg("%zu bytes are taken", size);
        test_free(copy);
    }
}

static void test_more_bodies_than_there_is_room_for_are_counted(void **state)
{
    (void)state;
    static char text[8192];
    int used = snprintf(text, sizeof text, "fr 1\n6d %d ", TRACKER_MAX_POSES + 2);
    for (int i = 0; i < TRACKER_MAX_POSES + 2; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "[%d 1][1 2 3 0 0 0]" QUARTER, i);
    tracker_packet_t packet;
    assert_int_equal(decode(&packet, text), TRACKER_OK);
    assert_int_equal(packet.count, TRACKER_MAX_POSES);
    assert_int_equal(packet.left_out[TRACKER_CROWDED], 2);
    assert_int_equal(packet.left_out[TRACKER_VALUE], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_guides_example),
        cmocka_unit_test(test_the_extended_line_tells_the_quality),
        cmocka_unit_test(test_packets_without_bodies_are_other_messages),
        cmocka_unit_test(test_malformed_text_is_refused),
        cmocka_unit_test(test_values_that_are_no_pose_are_left_out),
        cmocka_unit_test(test_truncated_packets_give_no_pose),
        cmocka_unit_test(test_more_bodies_than_there_is_room_for_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
