// SPDX-License-Identifier: Apache-2.0
// Tests of requests as words, and of what a board has logged as lines.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "sim/pose/event_text.h"
#include "sim/pose/request_text.h"

static command_t read_words(const char *name, const char *value)
{
    char error[REQUEST_TEXT_MESSAGE_LENGTH] = "";
    command_t request;
    const bool read = request_from_text(&request, name, value, error);
    assert_string_equal(error, "");
    assert_true(read);
    return request;
}

static void test_words_become_requests(void **state)
{
    (void)state;
    assert_int_equal(read_words("hello", NULL).kind, COMMAND_HELLO);
    assert_int_equal(read_words("reboot", NULL).kind, COMMAND_REBOOT);
    assert_int_equal(read_words("log", NULL).kind, COMMAND_LOG);
    assert_int_equal(read_words("method", "room").kind, COMMAND_METHOD);
    assert_null(read_words("method", "room").method);
    for (int m = 0; m < WARP_METHODS; m++)
        assert_ptr_equal(read_words("method", warp_methods[m].name).method, &warp_methods[m]);
    assert_int_equal(read_words("freeze", "on").kind, COMMAND_FREEZE);
    assert_true(read_words("freeze", "on").freeze);
    assert_false(read_words("freeze", "off").freeze);
    assert_int_equal(read_words("pattern", "none").pattern, COMMAND_PATTERN_NONE);
    assert_int_equal(read_words("pattern", "grid").pattern, COMMAND_PATTERN_GRID);
    assert_int_equal(read_words("pattern", "white").pattern, COMMAND_PATTERN_WHITE);
    assert_int_equal(read_words("pattern", "black").pattern, COMMAND_PATTERN_BLACK);
    assert_int_equal(read_words("latency", "0").latency_us, 0);
    assert_int_equal(read_words("latency", "41.5").latency_us, 41500);
    assert_int_equal(read_words("latency", "200").latency_us, COMMAND_MOST_LATENCY_US);
}

static void test_wrong_words_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name, *value, *expected;
    } wrong[] = {
        {"", NULL, "expected hello, method,"},
        {"Hello", NULL, "found \"Hello\""},
        {"hello", "1", "hello takes no value, found \"1\""},
        {"log", "", "log takes no value"},
        {"freeze", NULL, "freeze: a value is missing"},
        {"freeze", "", "expected on or off"},
        {"pattern", "red", "expected none, grid, white or black"},
        {"latency", "200.1", "expected milliseconds, 0 to 200"},
        {"latency", "-1", "expected milliseconds"},
        {"latency", "nan", "expected milliseconds"},
        {"latency", "1 ms", "expected milliseconds"},
        {"method", "best", "expected \"room\" or one of none+nearest"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char error[REQUEST_TEXT_MESSAGE_LENGTH] = "";
        command_t request = {.kind = COMMAND_LOG, .first_event = 77};
        assert_false(request_from_text(&request, wrong[i].name, wrong[i].value, error));
        if (strstr(error, wrong[i].expected) == NULL)
            fail_msg("\"%s\" is not in: %s", wrong[i].expected, error);
        assert_int_equal(request.first_event, 77);
    }
}

static void check_line(event_kind_t kind, int32_t value, const char *expected)
{
    char text[EVENT_TEXT_LENGTH];
    event_text(text, &(event_t){.time_ms = 12345, .kind = kind, .value = value});
    assert_string_equal(text, expected);
}

static void test_events_become_lines(void **state)
{
    (void)state;
    check_line(EVENT_START, 7, "     12.345 s  start     node 7");
    check_line(EVENT_STATE, CAN_BOARD_FROZEN, "     12.345 s  state     frozen");
    check_line(EVENT_STATE, 99, "     12.345 s  state     unknown");
    check_line(EVENT_FAULTS, CAN_FAULT_CAMERA | CAN_FAULT_DEADLINE, "     12.345 s  faults    camera, deadline");
    check_line(EVENT_FAULTS, 0, "     12.345 s  faults    none");
    check_line(EVENT_FAULTS, 1 << 12, "     12.345 s  faults    one of a newer firmware");
    check_line(EVENT_METHOD, 2, "     12.345 s  method    step 2");
    check_line(EVENT_BUS_TIME, CAN_TIME_HOLDOVER, "     12.345 s  bus time  goes on without its master");
    check_line(EVENT_BUS_TIME, -1, "     12.345 s  bus time  unknown");
    check_line(EVENT_KINDS, -5, "     12.345 s  unknown   -5; is the board's firmware newer?");
    check_line(EVENT_COMMAND, COMMAND_FREEZE + 65536, "     12.345 s  command   freeze on: done");
    check_line(EVENT_COMMAND, COMMAND_PATTERN + 65536 * 9, "     12.345 s  command   pattern unknown: done");
    check_line(EVENT_COMMAND, COMMAND_LATENCY + 65536 * 200, "     12.345 s  command   latency 200 ms: done");
    check_line(EVENT_COMMAND, COMMAND_METHOD + 65536 * 255, "     12.345 s  command   method room: done");
    check_line(EVENT_COMMAND, COMMAND_METHOD + 256 * COMMAND_IMPOSSIBLE + 65536 * 0x14,
               "     12.345 s  command   method unknown: impossible");
    check_line(EVENT_COMMAND, COMMAND_FREEZE + 256 * COMMAND_BAD_VALUE, "     12.345 s  command   freeze: bad value");
    check_line(EVENT_COMMAND, COMMAND_REBOOT + 256 * COMMAND_REFUSED, "     12.345 s  command   reboot: refused");
    check_line(EVENT_COMMAND, 200 + 256 * COMMAND_UNKNOWN, "     12.345 s  command   unknown: unknown");
    check_line(EVENT_COMMAND, -1, "     12.345 s  command   unknown: failed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words_become_requests),
        cmocka_unit_test(test_wrong_words_are_refused),
        cmocka_unit_test(test_events_become_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
