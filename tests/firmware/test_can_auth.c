// SPDX-License-Identifier: Apache-2.0
// Authentication on the bus: published CMACs, the bytes on the wire, and every change refused.
#include "firmware/can_auth.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/auth_frames.h"

static const hal_key_t RFC_KEY = {
    {0x2b, 0x7e, 0x15, 0x16, 0x28, 0xae, 0xd2, 0xa6, 0xab, 0xf7, 0x15, 0x88, 0x09, 0xcf, 0x4f, 0x3c}};

static can_auth_t *auth;

static int set_up(void **state)
{
    (void)state;
    auth = can_auth_open(&AUTH_KEY);
    return auth == NULL;
}

static int tear_down(void **state)
{
    (void)state;
    can_auth_close(auth);
    return 0;
}

static void published_codes_are_made(void **state)
{
    (void)state;
    static const uint8_t message[64] = {0x6b, 0xc1, 0xbe, 0xe2, 0x2e, 0x40, 0x9f, 0x96, 0xe9, 0x3d, 0x7e, 0x11, 0x73,
                                        0x93, 0x17, 0x2a, 0xae, 0x2d, 0x8a, 0x57, 0x1e, 0x03, 0xac, 0x9c, 0x9e, 0xb7,
                                        0x6f, 0xac, 0x45, 0xaf, 0x8e, 0x51, 0x30, 0xc8, 0x1c, 0x46, 0xa3, 0x5c, 0xe4,
                                        0x11, 0xe5, 0xfb, 0xc1, 0x19, 0x1a, 0x0a, 0x52, 0xef, 0xf6, 0x9f, 0x24, 0x45,
                                        0xdf, 0x4f, 0x9b, 0x17, 0xad, 0x2b, 0x41, 0x7b, 0xe6, 0x6c, 0x37, 0x10};
    static const struct {
        int length;
        uint8_t mac[CAN_AUTH_MAC_BYTES];
    } examples[] = {
        /* RFC 4493, section 4, examples 1 to 4; the one of 20 bytes is NIST's */
        {0, {0xbb, 0x1d, 0x69, 0x29, 0xe9, 0x59, 0x37, 0x28, 0x7f, 0xa3, 0x7d, 0x12, 0x9b, 0x75, 0x67, 0x46}},
        {16, {0x07, 0x0a, 0x16, 0xb4, 0x6b, 0x4d, 0x41, 0x44, 0xf7, 0x9b, 0xdd, 0x9d, 0xd0, 0x4a, 0x28, 0x7c}},
        {20, {0x7d, 0x85, 0x44, 0x9e, 0xa6, 0xea, 0x19, 0xc8, 0x23, 0xa7, 0xbf, 0x78, 0x83, 0x7d, 0xfa, 0xde}},
        {40, {0xdf, 0xa6, 0x67, 0x47, 0xde, 0x9a, 0xe6, 0x30, 0x30, 0xca, 0x32, 0x61, 0x14, 0x97, 0xc8, 0x27}},
        {64, {0x51, 0xf0, 0xbe, 0xbf, 0x7e, 0x3b, 0x9d, 0x92, 0xfc, 0x49, 0x74, 0x17, 0x79, 0x36, 0x3c, 0xfe}},
    };
    can_auth_t *rfc = can_auth_open(&RFC_KEY);
    assert_non_null(rfc);
    for (int round = 0; round < 2; round++) /* nothing stays of the one before */
        for (size_t e = 0; e < sizeof examples / sizeof examples[0]; e++) {
            uint8_t mac[CAN_AUTH_MAC_BYTES];
            assert_true(can_auth_mac(rfc, message, examples[e].length, mac));
            assert_memory_equal(mac, examples[e].mac, sizeof mac);
        }
    can_auth_close(rfc);
    can_auth_close(NULL);
}

/* The codes are OpenSSL's, of strings put together by hand from the header's words. */
static void bytes_are_where_the_header_says(void **state)
{
    (void)state;
    static const uint8_t fd_end[16] = {0xf6, 0xe5, 0xd4, 0xc3, 0xb2, 0xa1, 0xf2, 0x35,
                                       0xab, 0x2e, 0x38, 0x1f, 0x4f, 0x5a, 0x44, 0xf5};
    static const uint8_t classic[8] = {0xf6, 0xe5, 0xd4, 0x95, 0xe1, 0xff, 0xec, 0x32};
    static const uint8_t command_code[8] = {0x21, 0xb2, 0xde, 0x14, 0x4a, 0x81, 0x23, 0xc0};
    const hal_can_frame_t plain = auth_fd_frame();
    hal_can_frame_t fd = plain, part[3], tag;
    assert_true(can_auth_sign_fd(auth, AUTH_FRESH, &fd));
    assert_int_equal(fd.length, CAN_AUTH_FD_SIGNED);
    assert_int_equal(fd.id, plain.id);
    assert_true(fd.fd && fd.bit_rate_switch);
    assert_memory_equal(fd.data, plain.data, CAN_AUTH_FD_PLAIN);
    assert_memory_equal(fd.data + CAN_AUTH_FD_PLAIN, fd_end, sizeof fd_end);

    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET + 4 * 1};
    assert_true(can_auth_sign(auth, AUTH_FRESH, &set, &tag));
    assert_int_equal(tag.id, 0x117);
    assert_int_equal(tag.length, 8);
    assert_false(tag.fd || tag.extended || tag.bit_rate_switch);
    assert_memory_equal(tag.data, classic, sizeof classic);

    uint8_t code[CAN_AUTH_COMMAND_BYTES];
    const can_auth_command_t command = {0x600, (const uint8_t *)"freeze", 6, AUTH_SESSION};
    assert_true(can_auth_sign_command(auth, &command, code));
    assert_memory_equal(code, command_code, sizeof code);
}

static void what_is_no_message_is_not_signed(void **state)
{
    (void)state;
    const can_auth_fresh_t beyond = {AUTH_SESSION, UINT64_C(1) << 48};
    hal_can_frame_t part[4], tag = {.id = 7};
    auth_set_frames(part);
    for (int bad = 0; bad < 4; bad++) {
        hal_can_frame_t frame = auth_fd_frame();
        frame.fd = bad != 0;
        frame.extended = bad == 1;
        frame.length = bad == 2 ? CAN_AUTH_FD_SIGNED : CAN_AUTH_FD_PLAIN;
        const hal_can_frame_t before = frame;
        assert_false(can_auth_sign_fd(auth, bad == 3 ? beyond : AUTH_FRESH, &frame));
        assert_memory_equal(&frame, &before, sizeof frame);
    }
    for (int bad = 0; bad < 6; bad++) {
        auth_set_frames(part);
        part[1].fd = bad == 0;
        part[2].extended = bad == 1;
        part[0].length = bad == 2 ? 7 : 8;
        const can_auth_message_t set = {part, bad == 3 ? 0 : bad == 4 ? 4 : 3, CAN_AUTH_ID_POSE_SET};
        assert_false(can_auth_sign(auth, bad == 5 ? beyond : AUTH_FRESH, &set, &tag));
        assert_int_equal(tag.id, 7);
    }
    static const uint8_t data[CAN_AUTH_MAX_COMMAND + 1];
    uint8_t code[CAN_AUTH_COMMAND_BYTES];
    assert_true(can_auth_sign_command(auth, &(can_auth_command_t){1, data, CAN_AUTH_MAX_COMMAND, 0}, code));
    assert_true(can_auth_sign_command(auth, &(can_auth_command_t){1, NULL, 0, 0}, code));
    assert_false(can_auth_sign_command(auth, &(can_auth_command_t){1, data, CAN_AUTH_MAX_COMMAND + 1, 0}, code));
    assert_false(can_auth_sign_command(auth, &(can_auth_command_t){1, data, -1, 0}, code));
}

/* Every bit of data, freshness, code and identifier. */
static void any_changed_bit_is_a_forgery(void **state)
{
    (void)state;
    const can_auth_window_t window = auth_window_at(AUTH_TIME_US);
    can_auth_stream_t stream = auth_stream_before(AUTH_TIME_US);
    hal_can_frame_t signed_fd = auth_fd_frame(), part[3], tag;
    assert_true(can_auth_sign_fd(auth, AUTH_FRESH, &signed_fd));
    for (int bit = 0; bit < 8 * CAN_AUTH_FD_SIGNED + 11; bit++) {
        hal_can_frame_t fd = signed_fd;
        if (bit < 8 * CAN_AUTH_FD_SIGNED)
            fd.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
        else
            fd.id ^= 1U << (bit - 8 * CAN_AUTH_FD_SIGNED);
        assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_FORGED);
        assert_int_equal(fd.length, CAN_AUTH_FD_SIGNED);
    }
    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET};
    assert_true(can_auth_sign(auth, AUTH_FRESH, &set, &tag));
    for (int bit = 0; bit < 8 * 32 + 11; bit++) {
        uint8_t *byte = bit < 8 * 24 ? &part[bit / 64].data[bit / 8 % 8] : &tag.data[bit / 8 % 8];
        const uint8_t flipped = (uint8_t)(bit < 8 * 32 ? 1 << bit % 8 : 0);
        const uint32_t other_id = bit < 8 * 32 ? 0 : 1U << (bit - 8 * 32);
        *byte ^= flipped;
        part[0].id ^= other_id;
        assert_int_equal(can_auth_check(auth, &stream, &window, &set, &tag), CAN_AUTH_FORGED);
        *byte ^= flipped;
        part[0].id ^= other_id;
    }
    assert_int_equal(stream.results[CAN_AUTH_FORGED], 8 * CAN_AUTH_FD_SIGNED + 11 + 8 * 32 + 11);
    assert_int_equal(stream.newest_us, AUTH_TIME_US - 1);
    assert_int_equal(can_auth_check(auth, &stream, &window, &set, &tag), CAN_AUTH_OK);
}

static void other_keys_sessions_and_orders_are_forgeries(void **state)
{
    (void)state;
    const can_auth_window_t window = auth_window_at(AUTH_TIME_US);
    can_auth_stream_t stream = auth_stream_before(AUTH_TIME_US);
    can_auth_t *other = can_auth_open(&RFC_KEY);
    hal_can_frame_t fd = auth_fd_frame(), part[3], tag;
    assert_non_null(other);
    assert_true(can_auth_sign_fd(other, AUTH_FRESH, &fd));
    assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_FORGED);
    can_auth_close(other);

    fd = auth_fd_frame();
    assert_true(can_auth_sign_fd(auth, (can_auth_fresh_t){AUTH_SESSION + 1, AUTH_TIME_US}, &fd));
    assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_FORGED);

    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET}, shorter = {part, 2, CAN_AUTH_ID_POSE_SET};
    assert_true(can_auth_sign(auth, AUTH_FRESH, &set, &tag));
    assert_int_equal(can_auth_check(auth, &stream, &window, &shorter, &tag), CAN_AUTH_FORGED);
    const hal_can_frame_t second = part[1];
    part[1] = part[2];
    part[2] = second;
    assert_int_equal(can_auth_check(auth, &stream, &window, &set, &tag), CAN_AUTH_FORGED);
    assert_int_equal(stream.results[CAN_AUTH_FORGED], 4);
}

static void commands_need_their_code(void **state)
{
    (void)state;
    uint8_t data[20] = "test pattern", code[CAN_AUTH_COMMAND_BYTES];
    const can_auth_command_t command = {0x601, data, sizeof data, 77};
    assert_true(can_auth_sign_command(auth, &command, code));
    assert_true(can_auth_check_command(auth, &command, code));
    for (int bit = 0; bit < 8 * CAN_AUTH_COMMAND_BYTES; bit++) {
        code[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_false(can_auth_check_command(auth, &command, code));
        code[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    const can_auth_command_t others[] = {
        {0x602, data, sizeof data, 77}, {0x601, data, sizeof data - 1, 77}, {0x601, data, sizeof data, 78}};
    for (size_t o = 0; o < sizeof others / sizeof others[0]; o++)
        assert_false(can_auth_check_command(auth, &others[o], code));
    data[3] ^= 1;
    assert_false(can_auth_check_command(auth, &command, code));
    assert_false(can_auth_check_command(auth, &(can_auth_command_t){0x601, data, CAN_AUTH_MAX_COMMAND + 1, 77}, code));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_codes_are_made),
        cmocka_unit_test(bytes_are_where_the_header_says),
        cmocka_unit_test(what_is_no_message_is_not_signed),
        cmocka_unit_test(any_changed_bit_is_a_forgery),
        cmocka_unit_test(other_keys_sessions_and_orders_are_forgeries),
        cmocka_unit_test(commands_need_their_code),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
