// SPDX-License-Identifier: Apache-2.0
// Tests of an operator's requests as bytes, and of the log that they read.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/command.h"
#include "firmware/event_log.h"

static void assert_bytes(const command_t *command, const char *bytes, int length)
{
    uint8_t found[COMMAND_MAX_BYTES];
    assert_int_equal(command_encode(found, command), length);
    assert_memory_equal(found, bytes, (size_t)length);
    command_t read;
    assert_int_equal(command_decode(&read, found, length), COMMAND_OK);
    assert_int_equal(read.kind, command->kind);
    assert_ptr_equal(read.method, command->method);
    assert_int_equal(read.freeze, command->freeze);
    assert_int_equal(read.pattern, command->pattern);
    assert_int_equal(read.latency_us, command->latency_us);
    assert_int_equal(read.first_event, command->first_event);
    assert_int_equal(read.session, command->session);
    assert_int_equal(read.bus_time_us, command->bus_time_us);
    assert_int_equal(read.update, command->update);
    assert_string_equal(read.text, command->text);
}

static void test_requests(void **state)
{
    (void)state;
    assert_bytes(&(command_t){.kind = COMMAND_HELLO}, "\x01", 1);
    assert_bytes(&(command_t){.kind = COMMAND_METHOD}, "\x02", 1);
    assert_bytes(&(command_t){.kind = COMMAND_METHOD, .method = warp_method_from_name("area")},
                 "\x02"
                 "area",
                 5);
    assert_bytes(&(command_t){.kind = COMMAND_FREEZE, .freeze = true}, "\x03\x01", 2);
    assert_bytes(&(command_t){.kind = COMMAND_FREEZE}, "\x03\x00", 2);
    assert_bytes(&(command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_BLACK}, "\x04\x03", 2);
    assert_bytes(&(command_t){.kind = COMMAND_LATENCY, .latency_us = 50000}, "\x05\x50\xC3\x00\x00", 5);
    assert_bytes(&(command_t){.kind = COMMAND_REBOOT},
                 "\x06"
                 "reboot",
                 7);
    assert_bytes(&(command_t){.kind = COMMAND_LOG, .first_event = 0x12345678}, "\x07\x78\x56\x34\x12", 5);
    assert_bytes(&(command_t){.kind = COMMAND_NONCE}, "\x08", 1);
    const command_t session = {.kind = COMMAND_SESSION, .session = 0x0123456789ABCDEF, .bus_time_us = 0xFEDCBA987654};
    assert_bytes(&session, "\x09\xEF\xCD\xAB\x89\x67\x45\x23\x01\x54\x76\x98\xBA\xDC\xFE\x00\x00", 17);
    assert_bytes(&(command_t){.kind = COMMAND_UPDATE}, "\x0A\x00", 2);
    assert_bytes(&(command_t){.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_INSTALL, .text = "usb"}, "\x0A\x01usb",
                 5);
    const command_t change = {
        .kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_SWITCH, .bus_time_us = 0xFEDCBA987654, .text = "0.6"};
    assert_bytes(&change,
                 "\x0A\x02\x54\x76\x98\xBA\xDC\xFE\x00\x00"
                 "0.6",
                 13);
    const command_t sure = {.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_CONFIRM, .bus_time_us = 0xFEDCBA987654};
    assert_bytes(&sure, "\x0A\x03\x54\x76\x98\xBA\xDC\xFE\x00\x00", 10);
    assert_bytes(&(command_t){.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_CANCEL}, "\x0A\x04", 2);
    for (int m = 0; m < WARP_METHODS; m++) {
        uint8_t bytes[COMMAND_MAX_BYTES];
        command_t read;
        const command_t command = {.kind = COMMAND_METHOD, .method = &warp_methods[m]};
        assert_int_equal(command_decode(&read, bytes, command_encode(bytes, &command)), COMMAND_OK);
        assert_ptr_equal(read.method, &warp_methods[m]);
    }
}

static void test_bad_requests_change_nothing(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        int length;
        command_result_t result;
    } bad[] = {
        {"", 0, COMMAND_BAD_VALUE},
        {"\x00", 1, COMMAND_UNKNOWN},
        {"\x0B", 1, COMMAND_UNKNOWN},
        {"\xFF", 1, COMMAND_UNKNOWN},
        {"\x01\x00", 2, COMMAND_BAD_VALUE},
        {"\x02"
         "Area",
         5, COMMAND_BAD_VALUE},
        {"\x02"
         "area\x00x",
         7, COMMAND_BAD_VALUE},
        {"\x03", 1, COMMAND_BAD_VALUE},
        {"\x03\x02", 2, COMMAND_BAD_VALUE},
        {"\x04\x04", 2, COMMAND_BAD_VALUE},
        {"\x05\x41\x0D\x03\x00", 5, COMMAND_BAD_VALUE}, /* 200001 */
        {"\x05\x00\x00\x00", 4, COMMAND_BAD_VALUE},
        {"\x06", 1, COMMAND_BAD_VALUE},
        {"\x06reboo", 6, COMMAND_BAD_VALUE},
        {"\x06reboot!", 8, COMMAND_BAD_VALUE},
        {"\x07", 1, COMMAND_BAD_VALUE},
        {"\x08\x00", 2, COMMAND_BAD_VALUE},
        {"\x09", 1, COMMAND_BAD_VALUE},
        {"\x09"
         "12345678abcdef\x00", /* 16 bytes with the zero at the end are due */
         16, COMMAND_BAD_VALUE},
        {"\x09"
         "12345678abcdef\x01\x00", /* 2^48 us and more */
         17, COMMAND_BAD_VALUE},
        {"\x0A", 1, COMMAND_BAD_VALUE},
        {"\x0A\x05", 2, COMMAND_BAD_VALUE},
        {"\x0A\x00\x00", 3, COMMAND_BAD_VALUE},
        {"\x0A\x04\x00", 3, COMMAND_BAD_VALUE},
        {"\x0A\x01", 2, COMMAND_BAD_VALUE},
        {"\x0A\x01relative", 10, COMMAND_BAD_VALUE},
        {"\x0A\x01/a b", 6, COMMAND_BAD_VALUE},
        {"\x0A\x01/a\x00", 5, COMMAND_BAD_VALUE},
        {"\x0A\x02\x01\x00\x00\x00\x00\x00\x00\x00", 10, COMMAND_BAD_VALUE}, /* no version */
        {"\x0A\x02\x01\x00\x00\x00\x00\x00\x01\x00x", 11, COMMAND_BAD_VALUE},
        {"\x0A\x02\x01\x00\x00\x00\x00\x00\x00\x00"
         "123456789012345678901234567890123",
         43, COMMAND_BAD_VALUE},
        {"\x0A\x03\x01\x00\x00\x00\x00\x00\x00", 9, COMMAND_BAD_VALUE},
        {"\x0A\x03\x01\x00\x00\x00\x00\x00\x01\x00", 10, COMMAND_BAD_VALUE},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        command_t command = {.kind = COMMAND_HELLO, .latency_us = 77};
        assert_int_equal(command_decode(&command, (const uint8_t *)bad[i].bytes, bad[i].length), bad[i].result);
        assert_int_equal(command.kind, COMMAND_HELLO);
        assert_int_equal(command.latency_us, 77);
    }
}

static void test_the_longest_requests(void **state)
{
    (void)state;
    command_t longest = {.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_INSTALL, .text = "/"};
    uint8_t bytes[COMMAND_MAX_BYTES];
    memset(longest.text + 1, 'x', sizeof longest.text - 2);
    const int length = command_encode(bytes, &longest);
    command_t read;
    assert_int_equal(command_decode(&read, bytes, length), COMMAND_OK);
    assert_string_equal(read.text, longest.text);
    bytes[length] = 'x';
    assert_int_equal(command_decode(&read, bytes, length + 1), COMMAND_BAD_VALUE);
    static const uint8_t long_request[COMMAND_MAX_BYTES + 1] = {COMMAND_METHOD};
    assert_int_equal(command_decode(&read, long_request, COMMAND_MAX_BYTES + 1), COMMAND_BAD_VALUE);
    assert_int_equal(command_decode(&read, long_request, COMMAND_MAX_BYTES), COMMAND_BAD_VALUE); /* zeros: no name */
}

static void test_arguments_fit_the_log(void **state)
{
    (void)state;
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_METHOD}), COMMAND_ROOM_METHOD);
    for (int m = 0; m < WARP_METHODS; m++) {
        const command_t command = {.kind = COMMAND_METHOD, .method = &warp_methods[m], .freeze = true};
        assert_int_equal(command_argument(&command), 16 * (int)warp_methods[m].filter + (int)warp_methods[m].resampler);
    }
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_FREEZE, .freeze = true}), 1);
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_BLACK}), 3);
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_LATENCY, .latency_us = 200000}), 200);
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_CANCEL}), 4);
    assert_int_equal(command_argument(&(command_t){.kind = COMMAND_REBOOT, .freeze = true}), 0);
}

/* @return Events packed from `first` on, which must begin at `begins`; each is checked. */
static int assert_packed(const event_log_t *log, uint32_t first, int most, uint32_t begins)
{
    uint8_t bytes[COMMAND_MOST_EVENTS * EVENT_BYTES];
    const int packed = event_log_pack(log, bytes, &first, most);
    assert_int_equal(first, begins);
    for (int i = 0; i < packed; i++) {
        event_t event;
        assert_true(event_unpack(&event, bytes + EVENT_BYTES * i));
        assert_int_equal(event.time_ms, 1000 * (begins + (uint32_t)i));
        assert_int_equal(event.kind, EVENT_STATE);
        assert_int_equal(event.value, -(int32_t)(begins + (uint32_t)i));
    }
    return packed;
}

static void test_log_keeps_the_newest(void **state)
{
    (void)state;
    static event_log_t log;
    assert_int_equal(assert_packed(&log, 0, 50, 0), 0);
    for (uint32_t i = 0; i < 10; i++)
        event_log_add(&log, (event_t){1000 * i, EVENT_STATE, -(int32_t)i});
    assert_int_equal(assert_packed(&log, 0, 50, 0), 10);
    assert_int_equal(assert_packed(&log, 0, 3, 0), 3);
    assert_int_equal(assert_packed(&log, 8, 50, 8), 2);
    assert_int_equal(assert_packed(&log, 10, 50, 10), 0);
    assert_int_equal(assert_packed(&log, 1000, 50, 1000), 0);
    for (uint32_t i = 10; i < 1000; i++)
        event_log_add(&log, (event_t){1000 * i, EVENT_STATE, -(int32_t)i});
    assert_int_equal(assert_packed(&log, 0, 50, 1000 - EVENT_LOG_ENTRIES), 50);
    assert_int_equal(assert_packed(&log, 990, 50, 990), 10);
}

static void test_events_of_a_newer_firmware_are_seen_as_such(void **state)
{
    (void)state;
    static const uint8_t bytes[EVENT_BYTES] = {0x10, 0x27, 0, 0, EVENT_KINDS, 0xFE, 0xFF, 0xFF, 0xFF};
    event_t event;
    assert_false(event_unpack(&event, bytes));
    assert_int_equal(event.time_ms, 10000);
    assert_int_equal(event.value, -2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_requests),
        cmocka_unit_test(test_bad_requests_change_nothing),
        cmocka_unit_test(test_the_longest_requests),
        cmocka_unit_test(test_arguments_fit_the_log),
        cmocka_unit_test(test_log_keeps_the_newest),
        cmocka_unit_test(test_events_of_a_newer_firmware_are_seen_as_such),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
