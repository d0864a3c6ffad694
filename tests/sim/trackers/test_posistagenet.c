// SPDX-License-Identifier: Apache-2.0
// Tests of PosiStageNet: a packet written byte by byte, and what is refused.
#include "sim/trackers/posistagenet.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"
#include "tests/support/tracker_packets.h"

/* Time 0x0102 us, version 2.0, frame 9 of 1 packet; tracker 7 at 1, 2, -3 m, turned by pi / 2 about y. */
static const uint8_t by_hand[60] = {
    0x55, 0x67, 0x38, 0x80,                         /* data packet, 56 bytes of chunks */
    0x00, 0x00, 0x0C, 0x00,                         /* header, 12 bytes */
    0x02, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, /* time */
    0x02, 0x00, 0x09, 0x01, 0x01, 0x00, 0x24, 0x80, /* version; list, 36 bytes of chunks */
    0x07, 0x00, 0x20, 0x80,                         /* tracker 7, 32 bytes of chunks */
    0x00, 0x00, 0x0C, 0x00, 0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x40, 0xC0, /* position */
    0x02, 0x00, 0x0C, 0x00, 0x00, 0x00, 0x00, 0x00, 0xDB, 0x0F, 0xC9, 0x3F, 0x00, 0x00, 0x00, 0x00, /* orientation */
};

enum { VERSION_AT = 16, POSITION_AT = 32, ORIENTATION_AT = 48 };

static const float ahead[3] = {0.5F, 1.75F, -2.0F}, straight[3] = {0.0F, 0.0F, 0.0F};

static void test_a_packet_by_hand(void **state)
{
    (void)state;
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(posistagenet_decode(&packet, by_hand, sizeof by_hand), TRACKER_OK);
    assert_int_equal(packet.count, 1);
    const tracker_pose_t *pose = &packet.pose[0];
    assert_int_equal(pose->id, 7);
    assert_int_equal(pose->quality, CAN_POSE_TRACKED);
    assert_true(pose->timed);
    assert_int_equal(pose->time_us, 0x0102);
    tracker_expect_position(pose, 1.0, 2.0, -3.0);
    tracker_expect_turns(pose, (const double[3]){0, 0, 1}, (const double[3]){1, 0, 0});
}

static void test_status_and_unknown_chunks(void **state)
{
    (void)state;
    tracker_packet_t packet = {.count = 0};
    tracker_bytes_t bytes = tracker_bytes_psn(77, 40000, ahead, straight, 0.5F);
    assert_int_equal(posistagenet_decode(&packet, bytes.bytes, bytes.size), TRACKER_OK);
    assert_int_equal(packet.pose[0].id, 40000);
    assert_int_equal(packet.pose[0].quality, CAN_POSE_TRACKED);
    tracker_expect_position(&packet.pose[0], 0.5, 1.75, -2.0);
    packet.count = 0;
    bytes = tracker_bytes_psn(77, 40000, ahead, straight, 0.0F);
    assert_int_equal(posistagenet_decode(&packet, bytes.bytes, bytes.size), TRACKER_OK);
    assert_int_equal(packet.pose[0].quality, CAN_POSE_LOST);
}

/* The list's trackers may have times of their own; fields may be missing. */
static void test_times_and_missing_fields(void **state)
{
    (void)state;
    tracker_bytes_t bytes = {.size = 0};
    tracker_bytes_little(&bytes, 1000, 8);
    tracker_bytes_add(&bytes, (const uint8_t[]){2, 3, 9, 1}, 4);
    tracker_bytes_chunk(&bytes, 0, 0x0000, false);
    const size_t list = bytes.size;
    for (uint16_t id = 0; id < 3; id++) {
        const size_t tracker = bytes.size;
        tracker_bytes_add(&bytes, by_hand + POSITION_AT - 4, id == 1 ? 16 : 32);
        const size_t time = bytes.size;
        tracker_bytes_little(&bytes, UINT64_C(5000) + id, 8);
        tracker_bytes_chunk(&bytes, time, 0x0006, false);
        tracker_bytes_chunk(&bytes, tracker, id, true);
    }
    tracker_bytes_chunk(&bytes, list, 0x0001, true);
    tracker_bytes_chunk(&bytes, 0, 0x6755, true);
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(posistagenet_decode(&packet, bytes.bytes, bytes.size), TRACKER_OK);
    assert_int_equal(packet.count, 2);
    assert_int_equal(packet.pose[0].time_us, 5000);
    assert_int_equal(packet.pose[1].time_us, 5002);
    assert_int_equal(packet.left_out[TRACKER_INCOMPLETE], 1);
}

static void put_float(uint8_t *bytes, float value)
{
    memcpy(bytes, &value, sizeof value);
}

static void test_values_that_are_no_pose_are_left_out(void **state)
{
    (void)state;
    static const float bad[] = {(float)NAN, (float)INFINITY, -(float)INFINITY, 2e9F};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        for (int at = 0; at < 6; at++) {
            uint8_t bytes[sizeof by_hand];
            const bool turned = at >= 3;
            memcpy(bytes, by_hand, sizeof bytes);
            put_float(bytes + (turned ? ORIENTATION_AT + 4 * (at - 3) : POSITION_AT + 4 * at), bad[i]);
            tracker_packet_t packet = {.count = 0};
            assert_int_equal(posistagenet_decode(&packet, bytes, sizeof bytes), TRACKER_OK);
            if (!turned || !isfinite(bad[i]))
                tracker_expect_left_out(&packet, TRACKER_VALUE, 1);
        }
    }
    uint8_t bytes[sizeof by_hand];
    memcpy(bytes, by_hand, sizeof bytes);
    memset(bytes + 8, 0xFF, 8); /* the time */
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(posistagenet_decode(&packet, bytes, sizeof bytes), TRACKER_OK);
    tracker_expect_left_out(&packet, TRACKER_VALUE, 1);
}

static void expect(tracker_check_t expected, size_t at, uint8_t value)
{
    uint8_t bytes[sizeof by_hand];
    memcpy(bytes, by_hand, sizeof bytes);
    bytes[at] = value;
    tracker_packet_t packet = {.count = 0};
    const tracker_check_t check = posistagenet_decode(&packet, bytes, sizeof bytes);
    if (check != expected)
        fail_msg("byte %zu = %02X: \"%s\", expected \"%s\"", at, value, tracker_check_text[check],
                 tracker_check_text[expected]);
}

static void test_wrong_packets_are_refused(void **state)
{
    (void)state;
    expect(TRACKER_OTHER, 0, 0x56);  /* an info packet */
    expect(TRACKER_LENGTH, 2, 0x37); /* the packet is longer than it says */
    expect(TRACKER_LENGTH, 2, 0x39); /* and shorter */
    expect(TRACKER_SYNTAX, 3, 0x00); /* no chunks in it */
    expect(TRACKER_SYNTAX, 4, 0x01); /* no header first */
    expect(TRACKER_LENGTH, 6, 0x0B); /* the header is too short */
    expect(TRACKER_VERSION, VERSION_AT, 0x01);
    expect(TRACKER_VERSION, VERSION_AT, 0x03);
    expect(TRACKER_LENGTH, 22, 0x25); /* the list reaches beyond the packet */
    expect(TRACKER_SYNTAX, 23, 0x00); /* the list has no chunks in it */
    expect(TRACKER_LENGTH, 26, 0x21); /* the tracker reaches beyond the list */
    expect(TRACKER_LENGTH, 26, 0x1F);
    expect(TRACKER_SYNTAX, 27, 0x00); /* the tracker has no chunks in it */
    expect(TRACKER_LENGTH, POSITION_AT - 2, 0x0D);
    expect(TRACKER_LENGTH, POSITION_AT - 2, 0x08);
    expect(TRACKER_LENGTH, POSITION_AT - 1, 0x7F);
    expect(TRACKER_LENGTH, ORIENTATION_AT - 2, 0x0D);
    expect(TRACKER_LENGTH, ORIENTATION_AT - 2, 0x00);
}

static void test_bytes_behind_the_packet_are_refused(void **state)
{
    (void)state;
    uint8_t bytes[sizeof by_hand + 4] = {0};
    memcpy(bytes, by_hand, sizeof by_hand);
    tracker_packet_t packet = {.count = 0};
    for (size_t size = sizeof by_hand + 1; size <= sizeof bytes; size++)
        assert_int_equal(posistagenet_decode(&packet, bytes, size), TRACKER_LENGTH);
}

/* Each in a place of its own size, so that a sanitizer sees every byte too far. */
static void test_truncated_packets_give_no_pose(void **state)
{
    (void)state;
    for (size_t size = 0; size < sizeof by_hand; size++) {
        uint8_t *copy = test_malloc(size + 1);
        memcpy(copy + 1, by_hand, size);
        tracker_packet_t packet = {.count = 0};
        assert_int_equal(posistagenet_decode(&packet, copy + 1, size), TRACKER_LENGTH);
        test_free(copy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_packet_by_hand),
        cmocka_unit_test(test_status_and_unknown_chunks),
        cmocka_unit_test(test_times_and_missing_fields),
        cmocka_unit_test(test_values_that_are_no_pose_are_left_out),
        cmocka_unit_test(test_wrong_packets_are_refused),
        cmocka_unit_test(test_bytes_behind_the_packet_are_refused),
        cmocka_unit_test(test_truncated_packets_give_no_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
