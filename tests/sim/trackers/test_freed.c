// SPDX-License-Identifier: Apache-2.0
// Tests of FreeD: a packet worked out by hand, and what is refused.
#include "sim/trackers/freed.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"
#include "tests/support/tracker_packets.h"

/* Camera 1; pan 90 = 2D0000 / 32768, tilt 30, roll -15; x 1000 = 00FA00 / 64, y -2000, height 1500.5 mm. The other
 * bytes make 522 hex, of which 22 counts: the checksum is 40 - 22. */
static const uint8_t by_hand[FREED_D1_LENGTH] = {0xD1, 0x01, 0x2D, 0x00, 0x00, 0x0F, 0x00, 0x00, 0xF8, 0x80,
                                                 0x00, 0x00, 0xFA, 0x00, 0xFE, 0x0C, 0x00, 0x01, 0x77, 0x20,
                                                 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x1E};

static void test_a_packet_by_hand(void **state)
{
    (void)state;
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(freed_decode(&packet, by_hand, sizeof by_hand), TRACKER_OK);
    assert_int_equal(packet.count, 1);
    const tracker_pose_t *pose = &packet.pose[0];
    assert_int_equal(pose->id, 1);
    assert_int_equal(pose->quality, CAN_POSE_TRACKED);
    assert_false(pose->timed);
    tracker_expect_position(pose, 1000.0, -2000.0, 1500.5);
    /* turned to the right it looks along +x, and 30 degrees up; rolled anticlockwise its right side is raised */
    tracker_expect_turns(pose, (const double[3]){0, 1, 0}, (const double[3]){0.866025, 0.0, 0.5});
    tracker_expect_turns(pose, (const double[3]){1, 0, 0}, (const double[3]){-0.129410, -0.965926, 0.224144});
}

static void test_single_angles(void **state)
{
    (void)state;
    static const struct {
        double degrees[3], body[3], turned[3];
    } turn[] = {
        {{0, 0, 0}, {0.6, 0.8, 0}, {0.6, 0.8, 0}}, {{90, 0, 0}, {0, 1, 0}, {1, 0, 0}}, /* pan: clockwise from above */
        {{-90, 0, 0}, {0, 1, 0}, {-1, 0, 0}},      {{0, 90, 0}, {0, 1, 0}, {0, 0, 1}}, /* tilt: up */
        {{0, 0, 90}, {1, 0, 0}, {0, 0, -1}}, /* roll: clockwise from behind, the right side goes down */
        {{180, 0, 0}, {0, 1, 0}, {0, -1, 0}},
    };
    for (size_t i = 0; i < sizeof turn / sizeof turn[0]; i++) {
        const tracker_bytes_t bytes = tracker_bytes_freed(7, turn[i].degrees, (const double[3]){0, 0, 0});
        tracker_packet_t packet = {.count = 0};
        assert_int_equal(freed_decode(&packet, bytes.bytes, bytes.size), TRACKER_OK);
        tracker_expect_turns(&packet.pose[0], turn[i].body, turn[i].turned);
    }
}

static void test_the_ends_of_the_ranges(void **state)
{
    (void)state;
    uint8_t bytes[FREED_D1_LENGTH];
    memcpy(bytes, by_hand, sizeof bytes);
    memcpy(bytes + 11, (const uint8_t[]){0x80, 0, 0, 0x7F, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}, 9);
    tracker_bytes_mend_freed(bytes, sizeof bytes);
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(freed_decode(&packet, bytes, sizeof bytes), TRACKER_OK);
    tracker_expect_position(&packet.pose[0], -131072.0, 131071.984375, -0.015625);
}

static void test_every_damaged_byte_is_noticed(void **state)
{
    (void)state;
    for (size_t at = 0; at < sizeof by_hand; at++) {
        for (int bit = 0; bit < 8; bit++) {
            uint8_t bytes[FREED_D1_LENGTH];
            memcpy(bytes, by_hand, sizeof bytes);
            bytes[at] ^= (uint8_t)(1 << bit);
            tracker_packet_t packet = {.count = 0};
            assert_int_equal(freed_decode(&packet, bytes, sizeof bytes), at == 0 ? TRACKER_OTHER : TRACKER_CHECKSUM);
            assert_int_equal(packet.count, 0);
        }
    }
}

static void test_other_lengths_and_messages_are_refused(void **state)
{
    (void)state;
    uint8_t bytes[FREED_D1_LENGTH + 1] = {0};
    memcpy(bytes, by_hand, sizeof by_hand);
    tracker_packet_t packet = {.count = 0};
    for (size_t size = 0; size <= sizeof bytes; size++)
        if (size != FREED_D1_LENGTH)
            assert_int_equal(freed_decode(&packet, bytes, size), TRACKER_LENGTH);
    bytes[0] = 0xD0; /* a poll */
    assert_int_equal(freed_decode(&packet, bytes, 4), TRACKER_OTHER);
    assert_int_equal(packet.count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_packet_by_hand),
        cmocka_unit_test(test_single_angles),
        cmocka_unit_test(test_the_ends_of_the_ranges),
        cmocka_unit_test(test_every_damaged_byte_is_noticed),
        cmocka_unit_test(test_other_lengths_and_messages_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
