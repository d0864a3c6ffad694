// SPDX-License-Identifier: Apache-2.0
// Tests of ISO-TP: the bytes of the standard, two ends over a good and a bad bus, and an end that does not keep to it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/isotp.h"
#include "sim/rng.h"

enum { TOOL_ID = 0x601, BOARD_ID = 0x641, MS = 1000 };

static void assert_next(isotp_t *link, int64_t now_us, uint32_t id, const char *bytes)
{
    hal_can_frame_t frame;
    assert_true(isotp_next(link, &frame, now_us));
    assert_int_equal(frame.id, id);
    assert_int_equal(frame.length, 8);
    assert_false(frame.fd);
    assert_memory_equal(frame.data, bytes, 8);
}

static void assert_no_next(isotp_t *link, int64_t now_us)
{
    hal_can_frame_t frame;
    assert_false(isotp_next(link, &frame, now_us));
}

/* Takes a frame of 8 bytes. */
static void take(isotp_t *link, const char *bytes, int64_t now_us)
{
    hal_can_frame_t frame = {.id = link->receive_id, .length = 8};
    memcpy(frame.data, bytes, 8);
    assert_true(isotp_take(link, &frame, now_us));
}

static void assert_received(isotp_t *link, const void *data, int length)
{
    const uint8_t *found = NULL;
    assert_int_equal(isotp_received(link, &found), length);
    assert_memory_equal(found, data, (size_t)length);
    isotp_taken(link);
    assert_int_equal(isotp_received(link, &found), 0);
}

static void test_single_frame(void **state)
{
    (void)state;
    isotp_t link;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    assert_no_next(&link, 0);
    assert_true(isotp_send(&link, (const uint8_t *)"\x22\x01", 2, 0));
    assert_true(isotp_sending(&link));
    assert_next(&link, 0, BOARD_ID, "\x02\x22\x01\xCC\xCC\xCC\xCC\xCC");
    assert_false(isotp_sending(&link));
    assert_no_next(&link, 0);
    take(&link,
         "\x07"
         "1234567",
         0);
    assert_received(&link, "1234567", 7);
    /* unpadded, as other tools may send it */
    hal_can_frame_t frame = {.id = TOOL_ID, .length = 2, .data = {1, 9}};
    assert_true(isotp_take(&link, &frame, 0));
    assert_received(&link, "\x09", 1);
}

/* 20 bytes: a first frame of 6, flow control, consecutive ones of 7 and 7; block size 1 and a gap of 20 ms. */
static void test_segmented_message(void **state)
{
    (void)state;
    isotp_t link;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    assert_true(isotp_send(&link, (const uint8_t *)"abcdefghijklmnopqrst", 20, 0));
    assert_false(isotp_send(&link, (const uint8_t *)"x", 1, 0));
    assert_next(&link, 0, BOARD_ID,
                "\x10\x14"
                "abcdef");
    assert_no_next(&link, 0);
    take(&link, "\x30\x01\x14\xCC\xCC\xCC\xCC\xCC", 5 * MS);
    assert_next(&link, 5 * MS, BOARD_ID,
                "\x21"
                "ghijklm");
    assert_no_next(&link, 900 * MS); /* the block is over */
    take(&link, "\x31\x00\x00\xCC\xCC\xCC\xCC\xCC", 900 * MS);
    take(&link, "\x30\x00\x14\xCC\xCC\xCC\xCC\xCC", 1800 * MS);
    assert_next(&link, 1800 * MS, BOARD_ID,
                "\x22"
                "nopqrst");
    assert_false(isotp_sending(&link));

    take(&link,
         "\x10\x14"
         "abcdef",
         0);
    assert_next(&link, 0, BOARD_ID, "\x30\x00\x05\xCC\xCC\xCC\xCC\xCC");
    take(&link,
         "\x21"
         "ghijklm",
         0);
    take(&link,
         "\x22"
         "nopqrst",
         0);
    assert_received(&link, "abcdefghijklmnopqrst", 20);
    assert_int_equal(link.faults.sequence + link.faults.timeout + link.faults.invalid + link.faults.busy, 0);
}

static void test_gap_is_kept(void **state)
{
    (void)state;
    static const struct {
        uint8_t byte;
        int64_t gap_us;
    } gaps[] = {{0, 0},         {5, 5000},   {0x7F, 127000}, {0x80, 127000},
                {0xF0, 127000}, {0xF1, 100}, {0xF9, 900},    {0xFA, 127000}};
    for (size_t i = 0; i < sizeof gaps / sizeof gaps[0]; i++) {
        isotp_t link;
        hal_can_frame_t frame;
        char go_on[9] = "\x30\x00\x00\xCC\xCC\xCC\xCC\xCC";
        go_on[2] = (char)gaps[i].byte;
        isotp_init(&link, TOOL_ID, BOARD_ID);
        assert_true(isotp_send(&link, (const uint8_t *)"abcdefghijklmnopqrst", 20, 0));
        assert_true(isotp_next(&link, &frame, 0));
        take(&link, go_on, 1000);
        assert_true(isotp_next(&link, &frame, 1000));
        if (gaps[i].gap_us > 0)
            assert_no_next(&link, 1000 + gaps[i].gap_us - 1);
        assert_true(isotp_next(&link, &frame, 1000 + gaps[i].gap_us));
    }
}

static void test_an_end_that_does_not_go_on(void **state)
{
    (void)state;
    isotp_t link;
    hal_can_frame_t frame;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    assert_true(isotp_send(&link, (const uint8_t *)"abcdefghij", 10, 0));
    assert_true(isotp_next(&link, &frame, 0));
    assert_no_next(&link, ISOTP_TIMEOUT_US);
    assert_true(isotp_sending(&link));
    assert_no_next(&link, ISOTP_TIMEOUT_US + 1);
    assert_false(isotp_sending(&link));
    assert_int_equal(link.faults.timeout, 1);

    take(&link,
         "\x10\x0A"
         "abcdef",
         0);
    assert_true(isotp_next(&link, &frame, 0));
    assert_no_next(&link, ISOTP_TIMEOUT_US + 1);
    assert_int_equal(link.faults.timeout, 2);
    take(&link,
         "\x21"
         "ghij\xCC\xCC\xCC",
         ISOTP_TIMEOUT_US + 2);
    assert_int_equal(link.faults.sequence, 1);
    const uint8_t *data;
    assert_int_equal(isotp_received(&link, &data), 0);

    /* waits without end */
    assert_true(isotp_send(&link, (const uint8_t *)"abcdefghij", 10, 0));
    assert_true(isotp_next(&link, &frame, 0));
    for (int i = 0; i <= ISOTP_MOST_WAITS; i++) {
        assert_true(isotp_sending(&link));
        take(&link, "\x31\x00\x00\xCC\xCC\xCC\xCC\xCC", i);
    }
    assert_false(isotp_sending(&link));
    assert_int_equal(link.faults.timeout, 3);
}

/* Ten waits are allowed before each block, and a flow control that is cut off is none. */
static void test_waits_are_counted_by_block(void **state)
{
    (void)state;
    isotp_t link;
    hal_can_frame_t frame;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    assert_true(isotp_send(&link, (const uint8_t *)"abcdefghijklmnopqrst", 20, 0));
    for (int block = 0; block < 2; block++) {
        assert_true(isotp_next(&link, &frame, 0));
        for (int i = 0; i < ISOTP_MOST_WAITS; i++)
            take(&link, "\x31\x00\x00\xCC\xCC\xCC\xCC\xCC", 0);
        frame = (hal_can_frame_t){.id = TOOL_ID, .length = 2, .data = {0x30, 0}};
        assert_true(isotp_take(&link, &frame, 0));
        assert_int_equal(link.faults.invalid, block + 1);
        assert_no_next(&link, 0);
        take(&link, "\x30\x01\x00\xCC\xCC\xCC\xCC\xCC", 0);
    }
    assert_next(&link, 0, BOARD_ID,
                "\x22"
                "nopqrst");
    assert_false(isotp_sending(&link));
}

static void test_what_does_not_fit_is_refused(void **state)
{
    (void)state;
    static const uint8_t long_message[ISOTP_MAX_LENGTH + 1] = {1};
    isotp_t link;
    hal_can_frame_t frame;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    assert_false(isotp_send(&link, long_message, ISOTP_MAX_LENGTH + 1, 0));
    assert_false(isotp_send(&link, long_message, 0, 0));
    take(&link,
         "\x12\x01"
         "abcdef",
         0); /* 513 */
    assert_next(&link, 0, BOARD_ID, "\x32\x00\x05\xCC\xCC\xCC\xCC\xCC");
    assert_int_equal(link.faults.overflow, 1);
    assert_true(isotp_send(&link, long_message, ISOTP_MAX_LENGTH, 0));
    assert_true(isotp_next(&link, &frame, 0));
    take(&link, "\x32\x00\x00\xCC\xCC\xCC\xCC\xCC", 0);
    assert_false(isotp_sending(&link));
    assert_int_equal(link.faults.overflow, 2);
}

static void test_bad_frames_are_counted(void **state)
{
    (void)state;
    static const struct {
        int length;
        uint8_t data[8];
        uint32_t invalid, sequence;
    } bad[] = {
        {0, {0}, 1, 0},          {8, {0x00}, 1, 0}, /* a single frame of no bytes */
        {8, {0x08}, 1, 0},                          /* of 8 */
        {3, {0x03, 1, 2}, 1, 0},                    /* cut off */
        {8, {0x10, 0x07}, 1, 0},                    /* a first frame of what would fit a single one */
        {7, {0x10, 0x10}, 1, 0},                    /* cut off */
        {8, {0x21}, 0, 1},                          /* nothing to carry on */
        {8, {0x30}, 1, 0},                          /* nothing to control */
        {8, {0x40}, 1, 0},                          /* reserved */
        {8, {0xFF}, 1, 0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        isotp_t link;
        const uint8_t *data;
        isotp_init(&link, TOOL_ID, BOARD_ID);
        hal_can_frame_t frame = {.id = TOOL_ID, .length = (uint8_t)bad[i].length};
        memcpy(frame.data, bad[i].data, 8);
        assert_true(isotp_take(&link, &frame, 0));
        assert_int_equal(link.faults.invalid, bad[i].invalid);
        assert_int_equal(link.faults.sequence, bad[i].sequence);
        assert_int_equal(isotp_received(&link, &data), 0);
        assert_no_next(&link, 0);
        frame.fd = true;
        assert_true(isotp_take(&link, &frame, 0));
        frame.extended = true;
        assert_false(isotp_take(&link, &frame, 0));
        frame = (hal_can_frame_t){.id = BOARD_ID, .length = 8};
        assert_false(isotp_take(&link, &frame, 0));
    }
}

static void test_a_message_that_is_not_taken_stays(void **state)
{
    (void)state;
    isotp_t link;
    isotp_init(&link, TOOL_ID, BOARD_ID);
    take(&link,
         "\x02"
         "ab     ",
         0);
    take(&link,
         "\x02"
         "cd     ",
         0);
    assert_int_equal(link.faults.busy, 1);
    assert_received(&link, "ab", 2);
    /* a new message takes the place of one that is not whole */
    take(&link,
         "\x10\x0A"
         "abcdef",
         0);
    take(&link,
         "\x02"
         "ef     ",
         0);
    assert_int_equal(link.faults.sequence, 1);
    assert_received(&link, "ef", 2);
}

/* Carry everything from one end to the other until both are quiet; each frame is lost with a chance in a million. */
static void carry(isotp_t *from, isotp_t *to, rng_t *rng, uint32_t loss_ppm)
{
    for (int64_t now_us = 0; now_us < 5 * ISOTP_TIMEOUT_US; now_us += 2500) {
        hal_can_frame_t frame;
        while (isotp_next(from, &frame, now_us))
            if (rng_next(rng) % 1000000 >= loss_ppm)
                assert_true(isotp_take(to, &frame, now_us));
        while (isotp_next(to, &frame, now_us))
            if (rng_next(rng) % 1000000 >= loss_ppm)
                assert_true(isotp_take(from, &frame, now_us));
    }
}

/* Over a bad bus a message comes whole or not at all; over a good one it comes. */
static void test_two_ends(void **state)
{
    (void)state;
    int came = 0;
    for (uint64_t seed = 1; seed <= 600; seed++) {
        rng_t rng = {seed};
        const uint32_t loss_ppm = seed % 2 == 0 ? 0 : 20000;
        const int length = 1 + (int)(rng_next(&rng) % ISOTP_MAX_LENGTH);
        uint8_t data[ISOTP_MAX_LENGTH];
        for (int i = 0; i < length; i++)
            data[i] = (uint8_t)rng_next(&rng);
        isotp_t tool, board;
        isotp_init(&tool, BOARD_ID, TOOL_ID);
        isotp_init(&board, TOOL_ID, BOARD_ID);
        assert_true(isotp_send(&tool, data, length, 0));
        carry(&tool, &board, &rng, loss_ppm);
        const uint8_t *found = NULL;
        const int got = isotp_received(&board, &found);
        if (isotp_sending(&tool) || board.in.active || (loss_ppm == 0 && got == 0) ||
            (got != 0 && (got != length || memcmp(found, data, (size_t)length) != 0)))
            fail_msg("seed %llu: %d bytes sent, %d came, still sending: %d", (unsigned long long)seed, length, got,
                     isotp_sending(&tool));
        came += loss_ppm > 0 && got > 0;
    }
    assert_in_range(came, 50, 250); /* of 300 over the bad bus, or it is none */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_frame),
        cmocka_unit_test(test_segmented_message),
        cmocka_unit_test(test_gap_is_kept),
        cmocka_unit_test(test_an_end_that_does_not_go_on),
        cmocka_unit_test(test_waits_are_counted_by_block),
        cmocka_unit_test(test_what_does_not_fit_is_refused),
        cmocka_unit_test(test_bad_frames_are_counted),
        cmocka_unit_test(test_a_message_that_is_not_taken_stays),
        cmocka_unit_test(test_two_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
