// SPDX-License-Identifier: Apache-2.0
// Tests of can-utils' log lines: written as candump writes them, read back, and bad ones refused.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "sim/bus/candump_text.h"
#include "sim/rng.h"

static void assert_line(const hal_can_frame_t *frame, const char *expected)
{
    char text[CANDUMP_TEXT_LENGTH];
    assert_int_equal(candump_text_from_frame(text, frame, "can0"), strlen(expected));
    assert_string_equal(text, expected);
}

/* Lines as `candump -l` of can-utils writes them. */
static void test_lines_are_those_of_can_utils(void **state)
{
    (void)state;
    assert_line(&(hal_can_frame_t){.time_us = 1436509052249713, .id = 0x44, .length = 3, .data = {0x2A, 0x36, 0x6C}},
                "(1436509052.249713) can0 044#2A366C");
    assert_line(&(hal_can_frame_t){.time_us = 7, .id = 0x7FF}, "(0.000007) can0 7FF#");
    assert_line(&(hal_can_frame_t){.time_us = 1000000, .id = 0x123, .extended = true, .length = 1, .data = {9}},
                "(1.000000) can0 00000123#09");
    assert_line(&(hal_can_frame_t){.id = 0x100, .fd = true, .bit_rate_switch = true, .length = 2, .data = {0xAB, 0xCD}},
                "(0.000000) can0 100##1ABCD");
    assert_line(&(hal_can_frame_t){.id = 0x100, .fd = true}, "(0.000000) can0 100##0");
}

static uint64_t random_below(rng_t *rng, uint64_t limit)
{
    return rng_next(rng) % limit;
}

static hal_can_frame_t random_frame(rng_t *rng)
{
    static const uint8_t lengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    const bool fd = random_below(rng, 2) == 1, extended = random_below(rng, 2) == 1;
    hal_can_frame_t frame = {
        .time_us = (int64_t)random_below(rng, 2000000000) * 1000000 + (int64_t)random_below(rng, 1000000),
        .id = (uint32_t)random_below(rng, extended ? 1 << 29 : 1 << 11),
        .extended = extended,
        .fd = fd,
        .bit_rate_switch = fd && random_below(rng, 2) == 1,
        .length = lengths[random_below(rng, fd ? 16 : 9)],
    };
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = (uint8_t)random_below(rng, 256);
    return frame;
}

static void test_what_is_written_is_read_back(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        rng_t rng = {seed};
        const hal_can_frame_t frame = random_frame(&rng);
        char text[CANDUMP_TEXT_LENGTH], again[CANDUMP_TEXT_LENGTH], interface[CANDUMP_INTERFACE_LENGTH] = "";
        candump_text_from_frame(text, &frame, "vcan12");
        hal_can_frame_t read = {.length = 0};
        const char *problem = candump_frame_from_text(&read, interface, text);
        if (problem != NULL)
            fail_msg("seed %llu: \"%s\": expected %s", (unsigned long long)seed, text, problem);
        candump_text_from_frame(again, &read, interface);
        if (strcmp(text, again) != 0 || memcmp(read.data, frame.data, frame.length) != 0 || read.fd != frame.fd)
            fail_msg("seed %llu: \"%s\" was read as \"%s\"", (unsigned long long)seed, text, again);
    }
}

static void test_ends_of_lines(void **state)
{
    (void)state;
    static const char *const good[] = {"(1.000000) can0 123#11\n", "(1.000000) can0 123#11\r\n",
                                       "(1.000000) can0 123#11 R", "(1.000000) can0 123#11 T\n"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        hal_can_frame_t frame;
        char interface[CANDUMP_INTERFACE_LENGTH];
        assert_null(candump_frame_from_text(&frame, interface, good[i]));
        assert_int_equal(frame.length, 1);
        assert_string_equal(interface, "can0");
    }
}

static void test_bad_lines_are_refused(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"", "a time"},
        {"1.0 can0 123#11", "a time"},
        {"(1.00) can0 123#11", "a time"},
        {"(12345678901.000000) can0 123#11", "a time"},
        {"(-1.000000) can0 123#11", "a time"},
        {"(1.000000)can0 123#11", "a time"},
        {"(1.000000)  123#11", "interface"},
        {"(1.000000) can0", "interface"},
        {"(1.000000) name_too_long_16 123#11", "interface"},
        {"(1.000000) can0 12#11", "identifier"},
        {"(1.000000) can0 800#11", "identifier"},
        {"(1.000000) can0 20000000#11", "identifier"},
        {"(1.000000) can0 123456789#11", "identifier"},
        {"(1.000000) can0 123 11", "identifier"},
        {"(1.000000) can0 123#R", "data frame"},
        {"(1.000000) can0 123#1", "pairs"},
        {"(1.000000) can0 123#1G", "pairs"},
        {"(1.000000) can0 123#11 X", "pairs"},
        {"(1.000000) can0 123#112233445566778899", "0 to 8"},
        {"(1.000000) can0 123##", "flags"},
        {"(1.000000) can0 123##8", "flags"},
        {"(1.000000) can0 123##1112233445566778899", "0 to 8"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        hal_can_frame_t frame = {.id = 0x77};
        char interface[CANDUMP_INTERFACE_LENGTH] = "same";
        const char *problem = candump_frame_from_text(&frame, interface, bad[i][0]);
        if (problem == NULL || strstr(problem, bad[i][1]) == NULL)
            fail_msg("\"%s\": expected a problem with \"%s\", found \"%s\"", bad[i][0], bad[i][1],
                     problem == NULL ? "none" : problem);
        assert_int_equal(frame.id, 0x77);
        assert_string_equal(interface, "same");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines_are_those_of_can_utils),
        cmocka_unit_test(test_what_is_written_is_read_back),
        cmocka_unit_test(test_ends_of_lines),
        cmocka_unit_test(test_bad_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
