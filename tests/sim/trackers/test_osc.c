// SPDX-License-Identifier: Apache-2.0
// Tests of OSC: a message written byte by byte, every form of ours, bundles, and what is refused.
#include "sim/trackers/osc.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"
#include "tests/support/tracker_packets.h"

/* x 1, y 2, z -3, no turn. */
static const uint8_t by_hand[48] = {'/',  'p',  'o', 's', 'e',  0,    0, 0, ',',  'f', 'f', 'f', 'f',  'f',  'f', 'f',
                                    0,    0,    0,   0,   0x3F, 0x80, 0, 0, 0x40, 0,   0,   0,   0xC0, 0x40, 0,   0,
                                    0x3F, 0x80, 0,   0,   0,    0,    0, 0, 0,    0,   0,   0,   0,    0,    0,   0};

static tracker_check_t decode(tracker_packet_t *packet, const tracker_bytes_t *bytes)
{
    memset(packet, 0, sizeof *packet);
    return osc_decode(packet, bytes->bytes, bytes->size);
}

static tracker_check_t decode_message(tracker_packet_t *packet, const char *address, const char *types,
                                      const double *value)
{
    const tracker_bytes_t bytes = tracker_bytes_osc(address, types, value);
    return decode(packet, &bytes);
}

static void test_a_message_by_hand(void **state)
{
    (void)state;
    tracker_packet_t packet = {.count = 0};
    assert_int_equal(osc_decode(&packet, by_hand, sizeof by_hand), TRACKER_OK);
    assert_int_equal(packet.count, 1);
    assert_int_equal(packet.pose[0].id, 0);
    assert_int_equal(packet.pose[0].quality, CAN_POSE_TRACKED);
    assert_false(packet.pose[0].timed);
    tracker_expect_position(&packet.pose[0], 1, 2, -3);
    tracker_expect_turns(&packet.pose[0], (const double[3]){0.6, 0, 0.8}, (const double[3]){0.6, 0, 0.8});
}

static void test_every_form(void **state)
{
    (void)state;
    static const struct {
        const char *address, *types;
        double value[9];
        uint32_t id;
        can_pose_quality_t quality;
    } form[] = {
        {"/pose", "ddddddd", {1, 2, 3, 0.6, 0, 0.8, 0}, 0, CAN_POSE_TRACKED},
        {"/pose", "fdfdfdf", {1, 2, 3, 0.6, 0, 0.8, 0}, 0, CAN_POSE_TRACKED},
        {"/pose", "ifffffff", {12, 1, 2, 3, 0.6, 0, 0.8, 0}, 12, CAN_POSE_TRACKED},
        {"/pose", "fffffffi", {1, 2, 3, 0.6, 0, 0.8, 0, 2}, 0, CAN_POSE_PREDICTED},
        {"/pose", "idddddddi", {12, 1, 2, 3, 0.6, 0, 0.8, 0, 1}, 12, CAN_POSE_TRACKED},
        {"/pose/3", "fffffff", {1, 2, 3, 0.6, 0, 0.8, 0}, 3, CAN_POSE_TRACKED},
        {"/pose/000000042", "fffffffi", {1, 2, 3, 0.6, 0, 0.8, 0, 1}, 42, CAN_POSE_TRACKED},
    };
    for (size_t i = 0; i < sizeof form / sizeof form[0]; i++) {
        tracker_packet_t packet;
        if (decode_message(&packet, form[i].address, form[i].types, form[i].value) != TRACKER_OK)
            fail_msg("%s ,%s is refused", form[i].address, form[i].types);
        assert_int_equal(packet.count, 1);
        assert_int_equal(packet.pose[0].id, form[i].id);
        assert_int_equal(packet.pose[0].quality, form[i].quality);
        tracker_expect_position(&packet.pose[0], 1, 2, 3);
        /* w 0.6, y 0.8: by 106.26 degrees about y, z goes to 0.96 x - 0.28 z */
        tracker_expect_turns(&packet.pose[0], (const double[3]){0, 0, 1}, (const double[3]){0.96, 0, -0.28});
    }
    tracker_packet_t packet;
    const double lost[] = {5, 7, 8, 0, 0, 0, 0, 0, 0};
    assert_int_equal(decode_message(&packet, "/pose", "ifffffffi", lost), TRACKER_OK);
    assert_int_equal(packet.pose[0].quality, CAN_POSE_LOST);
}

static void test_bundles_and_their_time(void **state)
{
    (void)state;
    static const double value[] = {1, 2, 3, 1, 0, 0, 0};
    const tracker_bytes_t first = tracker_bytes_osc("/pose/1", "fffffff", value);
    const tracker_bytes_t other = tracker_bytes_osc("/tempo", "f", value);
    const tracker_bytes_t second = tracker_bytes_osc("/pose/2", "ddddddd", value);
    /* 1000.75 s */
    tracker_bytes_t bundle = tracker_bytes_bundle(UINT64_C(1000) << 32 | UINT64_C(0xC0000000));
    tracker_bytes_bundle_add(&bundle, &first);
    tracker_bytes_bundle_add(&bundle, &other);
    tracker_bytes_bundle_add(&bundle, &second);
    tracker_packet_t packet;
    assert_int_equal(decode(&packet, &bundle), TRACKER_OK);
    assert_int_equal(packet.count, 2);
    assert_int_equal(packet.pose[1].id, 2);
    assert_true(packet.pose[1].timed);
    assert_int_equal(packet.pose[1].time_us, 1000750000);

    bundle = tracker_bytes_bundle(1);
    tracker_bytes_bundle_add(&bundle, &first);
    assert_int_equal(decode(&packet, &bundle), TRACKER_OK);
    assert_false(packet.pose[0].timed);

    bundle = tracker_bytes_bundle(1);
    assert_int_equal(decode(&packet, &bundle), TRACKER_OTHER);
    tracker_bytes_t outer = tracker_bytes_bundle(1);
    tracker_bytes_bundle_add(&outer, &bundle);
    assert_int_equal(decode(&packet, &outer), TRACKER_SYNTAX);

    bundle = tracker_bytes_bundle(1);
    tracker_bytes_bundle_add(&bundle, &first);
    bundle.bytes[19] = (uint8_t)(bundle.bytes[19] + 4); /* its message's size */
    assert_int_equal(decode(&packet, &bundle), TRACKER_LENGTH);
    bundle.bytes[16] = 0x80;
    assert_int_equal(decode(&packet, &bundle), TRACKER_LENGTH);
}

static void test_other_messages(void **state)
{
    (void)state;
    static const double value[] = {1, 2, 3, 1, 0, 0, 0};
    static const char *const address[] = {"/poses",    "/pos",     "/pose/",           "/pose/x", "/pose/1x",
                                          "/pose/1/2", "/pose/-1", "/pose/1234567890", "/"};
    tracker_packet_t packet;
    for (size_t i = 0; i < sizeof address / sizeof address[0]; i++)
        if (decode_message(&packet, address[i], "fffffff", value) != TRACKER_OTHER)
            fail_msg("%s is taken", address[i]);
    assert_int_equal(decode_message(&packet, "pose", "fffffff", value), TRACKER_SYNTAX);
}

static void test_other_arguments_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *address, *types;
        double value[10];
    } bad[] = {
        {"/pose", "", {0}},
        {"/pose", "ffffff", {1, 2, 3, 1, 0, 0}},
        {"/pose", "ffffffff", {1, 2, 3, 1, 0, 0, 0, 0}},
        {"/pose", "iiiiiii", {1, 2, 3, 1, 0, 0, 0}},
        {"/pose", "ififffff", {1, 2, 3, 1, 0, 0, 0, 0}},
        {"/pose", "iffffffff", {1, 2, 3, 1, 0, 0, 0, 0, 0}},
        {"/pose", "ifffffffii", {1, 1, 2, 3, 1, 0, 0, 0, 1, 1}},
        {"/pose", "ifffffff", {-1, 1, 2, 3, 1, 0, 0, 0}},
        {"/pose", "fffffffi", {1, 2, 3, 1, 0, 0, 0, 3}},
        {"/pose", "fffffffi", {1, 2, 3, 1, 0, 0, 0, -1}},
        {"/pose/1", "ifffffff", {1, 1, 2, 3, 1, 0, 0, 0}},
    };
    tracker_packet_t packet;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (decode_message(&packet, bad[i].address, bad[i].types, bad[i].value) != TRACKER_SYNTAX)
            fail_msg("%s ,%s is taken", bad[i].address, bad[i].types);
}

static void test_values_that_are_no_pose_are_left_out(void **state)
{
    (void)state;
    static const double bad[][7] = {{(double)NAN, 2, 3, 1, 0, 0, 0}, {1, 2, (double)INFINITY, 1, 0, 0, 0},
                                    {1, 2, 3, (double)NAN, 0, 0, 0}, {1, 2e9, 3, 1, 0, 0, 0},
                                    {1, 2, 3, 0, 0, 0, 0},           {1, 2, 3, 1.02, 0, 0, 0},
                                    {1, 2, 3, 0.98, 0, 0, 0}};
    tracker_packet_t packet;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(decode_message(&packet, "/pose", i % 2 == 0 ? "fffffff" : "ddddddd", bad[i]), TRACKER_OK);
        tracker_expect_left_out(&packet, TRACKER_VALUE, 1);
    }
    static const double nearly[7] = {1, 2, 3, 1.009, 0, 0, 0};
    assert_int_equal(decode_message(&packet, "/pose", "ddddddd", nearly), TRACKER_OK);
    tracker_expect_turns(&packet.pose[0], (const double[3]){1, 0, 0}, (const double[3]){1, 0, 0});
}

/* Each in a place of its own size, so that a sanitizer sees every byte too far. */
static void test_truncated_messages_give_no_pose(void **state)
{
    (void)state;
    for (size_t size = 0; size < sizeof by_hand; size++) {
        uint8_t *copy = test_malloc(size + 1);
        memcpy(copy + 1, by_hand, size);
        tracker_packet_t packet = {.count = 0};
        assert_int_not_equal(osc_decode(&packet, copy + 1, size), TRACKER_OK);
        assert_int_equal(packet.count, 0);
        test_free(copy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_message_by_hand),
        cmocka_unit_test(test_every_form),
        cmocka_unit_test(test_bundles_and_their_time),
        cmocka_unit_test(test_other_messages),
        cmocka_unit_test(test_other_arguments_are_refused),
        cmocka_unit_test(test_values_that_are_no_pose_are_left_out),
        cmocka_unit_test(test_truncated_messages_give_no_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
