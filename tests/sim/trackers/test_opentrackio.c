// SPDX-License-Identifier: Apache-2.0
// Tests of OpenTrackIO's packets: header, checksum, both encodings, segments, and what is refused.
#include "sim/trackers/opentrackio.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/tracker_expect.h"
#include "tests/support/tracker_packets.h"

#define PROTOCOL "\"protocol\":{\"name\":\"OpenTrackIO\",\"version\":[1,0,1]},\"sourceNumber\":14,"
#define TRANSFORM "\"translation\":{\"x\":1.5,\"y\":-2,\"z\":3e-1},\"rotation\":{\"pan\":90,\"tilt\":30.0,\"roll\":0}"

static const char sample[] = "{" PROTOCOL "\"transforms\":[{" TRANSFORM ",\"id\":\"Camera\"}]}";

/* {"protocol": {"name": "OpenTrackIO", "version": [1, 0, 1]}, "sourceNumber": 14,
 *  "transforms": [{"translation": {"x": 1.5, "y": -2, "z": 0.25}, "rotation": {"pan": 90.0, "tilt": 0, "roll": 0}}]} */
static const uint8_t cbor_by_hand[] = {
    0xA3, 0x68, 'p',  'r',  'o',  't', 'o',  'c',  'o',  'l',  0xA2, 0x64, 'n',  'a',  'm',  'e',  0x6B, 'O',  'p',
    'e',  'n',  'T',  'r',  'a',  'c', 'k',  'I',  'O',  0x67, 'v',  'e',  'r',  's',  'i',  'o',  'n',  0x83, 0x01,
    0x00, 0x01, 0x6C, 's',  'o',  'u', 'r',  'c',  'e',  'N',  'u',  'm',  'b',  'e',  'r',  0x0E, 0x6A, 't',  'r',
    'a',  'n',  's',  'f',  'o',  'r', 'm',  's',  0x9F, 0xBF, 0x6B, 't',  'r',  'a',  'n',  's',  'l',  'a',  't',
    'i',  'o',  'n',  0xA3, 0x61, 'x', 0xF9, 0x3E, 0x00, 0x61, 'y',  0x21, 0x61, 'z',  0xFB, 0x3F, 0xD0, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x68, 'r', 'o',  't',  'a',  't',  'i',  'o',  'n',  0xA3, 0x63, 'p',  'a',  'n',  0xFA,
    0x42, 0xB4, 0x00, 0x00, 0x64, 't', 'i',  'l',  't',  0x00, 0x64, 'r',  'o',  'l',  'l',  0x00, 0xFF, 0xFF};

static tracker_bytes_t packet_of(uint16_t sequence, const char *json)
{
    return tracker_bytes_opentrackio(&(tracker_bytes_segment_t){1, sequence, 0, true}, json, strlen(json));
}

static tracker_check_t decode(opentrackio_memory_t *memory, tracker_packet_t *packet, const tracker_bytes_t *bytes)
{
    memset(packet, 0, sizeof *packet);
    return opentrackio_decode(memory, packet, bytes->bytes, bytes->size);
}

/* In a stream of its own. */
static tracker_check_t decode_alone(tracker_packet_t *packet, const tracker_bytes_t *bytes)
{
    static opentrackio_memory_t memory;
    memset(&memory, 0, sizeof memory);
    return decode(&memory, packet, bytes);
}

static void test_a_sample_in_cbor_by_hand(void **state)
{
    (void)state;
    tracker_packet_t packet;
    const tracker_bytes_t bytes =
        tracker_bytes_opentrackio(&(tracker_bytes_segment_t){2, 1, 0, true}, cbor_by_hand, sizeof cbor_by_hand);
    assert_int_equal(decode_alone(&packet, &bytes), TRACKER_OK);
    assert_int_equal(packet.count, 1);
    assert_int_equal(packet.pose[0].id, 14);
    assert_false(packet.pose[0].timed);
    tracker_expect_position(&packet.pose[0], 1.5, -2.0, 0.25);
    tracker_expect_turns(&packet.pose[0], (const double[3]){0, 1, 0}, (const double[3]){-1, 0, 0});
}

/* Both orders of the two sums, over all bytes but their own. */
static void test_the_checksum_in_both_orders(void **state)
{
    (void)state;
    uint8_t bytes[18] = {'O', 'T', 'r', 'k', 0, 1, 0, 1, 0, 0, 0, 0, 0x80, 2, 0, 0, '{', '}'};
    unsigned sum1 = 0, sum2 = 0;
    for (int i = 0; i < 18; i++) {
        sum1 += bytes[i];
        sum2 += i == 14 || i == 15 ? 0 : sum1;
    }
    static opentrackio_memory_t memory;
    tracker_packet_t packet = {.count = 0};
    bytes[14] = (uint8_t)sum2;
    bytes[15] = (uint8_t)sum1;
    assert_int_equal(opentrackio_decode(&memory, &packet, bytes, sizeof bytes),
                     TRACKER_VERSION); /* no protocol in {} */
    bytes[14] = (uint8_t)sum1;
    bytes[15] = (uint8_t)sum2;
    assert_int_equal(opentrackio_decode(&memory, &packet, bytes, sizeof bytes), TRACKER_VERSION);
    bytes[14] ^= 1;
    assert_int_equal(opentrackio_decode(&memory, &packet, bytes, sizeof bytes), TRACKER_CHECKSUM);
}

static void test_segments_are_joined(void **state)
{
    (void)state;
    static opentrackio_memory_t memory;
    tracker_packet_t packet;
    const size_t length = strlen(sample), cut[4] = {0, 40, 41, length};
    for (int same_number = 0; same_number < 2; same_number++) {
        for (int s = 0; s < 3; s++) {
            const tracker_bytes_segment_t segment = {1, (uint16_t)(same_number ? 7 : 0xFFFE + s), (uint32_t)cut[s],
                                                     s == 2};
            const tracker_bytes_t bytes = tracker_bytes_opentrackio(&segment, sample + cut[s], cut[s + 1] - cut[s]);
            assert_int_equal(decode(&memory, &packet, &bytes), s == 2 ? TRACKER_OK : TRACKER_UNFINISHED);
            assert_int_equal(packet.count, s == 2);
        }
        tracker_expect_position(&packet.pose[0], 1.5, -2.0, 0.3);
    }
}

static void test_a_missing_segment_discards_the_sample(void **state)
{
    (void)state;
    static opentrackio_memory_t memory;
    tracker_packet_t packet;
    const uint32_t half = 60, rest = (uint32_t)strlen(sample) - half;
    const tracker_bytes_t begin = tracker_bytes_opentrackio(&(tracker_bytes_segment_t){1, 5, 0, false}, sample, half);
    const struct {
        tracker_bytes_segment_t segment;
        const char *what;
    } wrong[] = {{{1, 6, half + 1, true}, "a gap"},
                 {{1, 6, half - 1, true}, "an overlap"},
                 {{1, 7, half, true}, "a sequence number skipped"},
                 {{2, 6, half, true}, "another encoding"}};
    const tracker_bytes_t end =
        tracker_bytes_opentrackio(&(tracker_bytes_segment_t){1, 6, half, true}, sample + half, rest);
    assert_int_equal(decode(&memory, &packet, &end), TRACKER_SEGMENT);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(decode(&memory, &packet, &begin), TRACKER_UNFINISHED);
        const tracker_bytes_t bytes = tracker_bytes_opentrackio(&wrong[i].segment, sample + half, rest);
        if (decode(&memory, &packet, &bytes) != TRACKER_SEGMENT)
            fail_msg("%s is taken", wrong[i].what);
        assert_int_equal(decode(&memory, &packet, &end), TRACKER_SEGMENT);
    }
    const tracker_bytes_t whole = packet_of(9, sample);
    assert_int_equal(decode(&memory, &packet, &whole), TRACKER_OK);
}

/* Samples of more than the memory holds, in segments of 32 kB. */
static void test_a_sample_without_end_is_refused(void **state)
{
    (void)state;
    static opentrackio_memory_t memory;
    static uint8_t bytes[16 + 32767];
    tracker_packet_t packet = {.count = 0};
    tracker_check_t check = TRACKER_OK;
    for (uint32_t s = 0; s < 3; s++) {
        const tracker_bytes_t head =
            tracker_bytes_opentrackio(&(tracker_bytes_segment_t){1, (uint16_t)s, s * 32767, false}, NULL, 0);
        memset(bytes, ' ', sizeof bytes);
        memcpy(bytes, head.bytes, 16);
        tracker_bytes_mend_opentrackio(bytes, sizeof bytes);
        check = opentrackio_decode(&memory, &packet, bytes, sizeof bytes);
        assert_int_equal(check, s < 2 ? TRACKER_UNFINISHED : TRACKER_LENGTH);
    }
}

static void test_repetitions_are_refused(void **state)
{
    (void)state;
    static opentrackio_memory_t memory;
    tracker_packet_t packet;
    const tracker_bytes_t first = packet_of(1, sample), second = packet_of(2, sample);
    assert_int_equal(decode(&memory, &packet, &first), TRACKER_OK);
    assert_int_equal(decode(&memory, &packet, &first), TRACKER_REPEATED);
    assert_int_equal(packet.count, 0);
    assert_int_equal(decode(&memory, &packet, &second), TRACKER_OK);
}

static void test_wrong_packets_are_refused(void **state)
{
    (void)state;
    tracker_packet_t packet;
    const tracker_bytes_t good = packet_of(1, sample);
    for (size_t size = 0; size < good.size; size++) {
        tracker_bytes_t bytes = good;
        bytes.size = size;
        assert_int_equal(decode_alone(&packet, &bytes), size < 4 ? TRACKER_OTHER : TRACKER_LENGTH);
    }
    for (size_t at = 0; at < good.size; at++) {
        tracker_bytes_t bytes = good;
        bytes.bytes[at] ^= 0x10;
        const tracker_check_t check = decode_alone(&packet, &bytes);
        assert_int_equal(check, at < 4 ? TRACKER_OTHER : at == 12 || at == 13 ? TRACKER_LENGTH : TRACKER_CHECKSUM);
    }
    for (int encoding = 0; encoding < 256; encoding++) {
        tracker_bytes_t bytes = good;
        bytes.bytes[5] = (uint8_t)encoding;
        tracker_bytes_mend_opentrackio(bytes.bytes, bytes.size);
        const tracker_check_t expected = encoding == 1 ? TRACKER_OK : encoding == 2 ? TRACKER_SYNTAX : TRACKER_VERSION;
        assert_int_equal(decode_alone(&packet, &bytes), expected);
    }
}

static void test_payloads_that_are_no_values_are_refused(void **state)
{
    (void)state;
    static const char *const payload[] = {
        "", "nonsense", "{} {}", "{\"a\":1,\"a\":1}", "{\"a\":NaN}", "{\"a\":1e999}", "{\"a\":\"\xFF\"}"};
    for (size_t i = 0; i < sizeof payload / sizeof payload[0]; i++) {
        tracker_packet_t packet;
        const tracker_bytes_t bytes = packet_of(1, payload[i]);
        assert_int_equal(decode_alone(&packet, &bytes), TRACKER_SYNTAX);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sample_in_cbor_by_hand),
        cmocka_unit_test(test_the_checksum_in_both_orders),
        cmocka_unit_test(test_segments_are_joined),
        cmocka_unit_test(test_a_missing_segment_discards_the_sample),
        cmocka_unit_test(test_a_sample_without_end_is_refused),
        cmocka_unit_test(test_repetitions_are_refused),
        cmocka_unit_test(test_wrong_packets_are_refused),
        cmocka_unit_test(test_payloads_that_are_no_values_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
