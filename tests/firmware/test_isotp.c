// SPDX-License-Identifier: Apache-2.0
// Tests of ISO-TP: the bytes of the standard, and two ends over a good and a bad bus.
#include "tests/firmware/isotp_bench.h"

#include "sim/rng.h"

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
        cmocka_unit_test(test_two_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
