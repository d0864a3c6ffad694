// SPDX-License-Identifier: Apache-2.0
// Tests of ISO-TP with an end that does not keep to it: silence, waits without end, what does not fit, bad frames.
#include "tests/firmware/isotp_bench.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_end_that_does_not_go_on),        cmocka_unit_test(test_waits_are_counted_by_block),
        cmocka_unit_test(test_what_does_not_fit_is_refused),      cmocka_unit_test(test_bad_frames_are_counted),
        cmocka_unit_test(test_a_message_that_is_not_taken_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
