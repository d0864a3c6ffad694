// SPDX-License-Identifier: Apache-2.0
// The socketcand door holds against broken commands, random bytes and clients that do not read.
#include "sim/bus/socketcand_server.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/bus_recorder.h"
#include "tests/support/socketcand_bench.h"

static void expect_nothing_at_board(const socketcand_bench_t *bench)
{
    assert_int_equal(hal_can_receive(bench->board, &(hal_can_frame_t){0}), HAL_EMPTY);
}

static void test_wrong_commands_are_answered_and_send_nothing(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "<>",
        "< >",
        "< dance >",
        "< send >",
        "< send 12 >",
        "< send 12 1 >",
        "< send 12 1 1 2 >",
        "< send 12 9 >",
        "< send 12 1 100 >",
        "< send 12 1 x >",
        "< send 20000000 0 >",
        "< send 123456789 0 >",
        "< send -1 0 >",
        "< send 12 -1 >",
        "< send 12 10 >",
        "< send 12 8 1 2 3 4 5 6 7 8 9 >",
        "< open can1 >",
        "< open >",
        "< open can0 can0 >",
        "< open a_channel_name_without_end >",
        "< rawmode now >",
        "< sendrtr 1 0 >",
        "< send 1 < send 2 0 >",
    };
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char answer[SOCKETCAND_BENCH_TEXT];
        socketcand_bench_say(&bench, fd, wrong[i]);
        assert_true(socketcand_bench_hear(fd, answer) > 0);
        if (strncmp(answer, "< error ", 8) != 0 || strstr(answer, "bus off") != NULL ||
            strcmp(answer + strlen(answer) - 2, " >") != 0)
            fail_msg("%s was answered with %s", wrong[i], answer);
    }
    assert_int_equal(socketcand_server_stats(bench.server).wrong_commands, sizeof wrong / sizeof *wrong);
    expect_nothing_at_board(&bench);
    socketcand_bench_say(&bench, fd, "> \n > no brackets > ");
    socketcand_bench_expect(fd, "");
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_send_needs_an_open_channel(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_connect(&bench);
    socketcand_bench_say(&bench, fd, "< send 1 0 >");
    socketcand_bench_expect(fd, "< hi >< error no channel is open, expected < open can0 > first >");
    socketcand_bench_say(&bench, fd, "< rawmode >");
    socketcand_bench_expect(fd, "< error no channel is open, expected < open can0 > first >");
    expect_nothing_at_board(&bench);
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_endless_command_is_refused(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    char text[10001];
    memset(text, '<', 10000);
    text[10000] = '\0';
    socketcand_bench_say(&bench, fd, text);
    char answer[SOCKETCAND_BENCH_TEXT];
    assert_true(socketcand_bench_hear(fd, answer) > 0);
    assert_non_null(strstr(answer, "longer than 256"));
    socketcand_bench_say(&bench, fd, " ><echo>");
    assert_true(socketcand_bench_hear(fd, answer) > 0);
    assert_non_null(strstr(answer, "< echo >"));
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_client_that_does_not_read_is_dropped(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int lazy = socketcand_bench_raw_client(&bench), busy = socketcand_bench_raw_client(&bench);
    for (int i = 0; i < 200000 && socketcand_server_stats(bench.server).dropped == 0; i++) {
        char text[4096];
        assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 1, .length = 8}), HAL_OK);
        socketcand_bench_turn(&bench, 1);
        while (recv(busy, text, sizeof text, MSG_DONTWAIT) > 0)
            continue;
    }
    assert_int_equal(socketcand_server_stats(bench.server).dropped, 1);
    assert_int_equal(socketcand_server_stats(bench.server).clients, 1);
    socketcand_bench_say(&bench, busy, "< echo >");
    socketcand_bench_expect(busy, "< echo >");
    close(lazy);
    close(busy);
    socketcand_bench_end(&bench);
}

/* Random bytes, many of them from the protocol's own words: no crash, and a clean echo afterwards. */
static void test_random_input_is_survived(void **state)
{
    (void)state;
    static const char *const words[] = {"<", ">", " ", "send", "open", "can0", "rawmode", "1", "8", "ff", "echo", "\n"};
    for (uint64_t seed = 1; seed <= 10; seed++) {
        uint64_t random = seed;
        const socketcand_bench_t bench = socketcand_bench_begin();
        const int fd = socketcand_bench_connect(&bench);
        socketcand_bench_turn(&bench, 1);
        for (int i = 0; i < 3000; i++) {
            char byte[2] = {(char)(bus_random(&random) % 255 + 1), '\0'};
            const char *word = bus_random(&random) % 4 == 0 ? byte : words[bus_random(&random) % 12];
            socketcand_bench_put(fd, word);
            if (i % 50 == 0)
                socketcand_bench_turn(&bench, 1);
        }
        socketcand_bench_say(&bench, fd, ">");
        socketcand_bench_turn(&bench, 100);
        static char text[SOCKETCAND_BENCH_TEXT];
        while (recv(fd, text, sizeof text, MSG_DONTWAIT) > 0)
            continue;
        socketcand_bench_say(&bench, fd, "< echo >");
        socketcand_bench_hear(fd, text);
        if (strcmp(text, "< echo >") != 0)
            fail_msg("seed %llu: echo was answered with %s", (unsigned long long)seed, text);
        close(fd);
        socketcand_bench_end(&bench);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wrong_commands_are_answered_and_send_nothing),
        cmocka_unit_test(test_send_needs_an_open_channel),
        cmocka_unit_test(test_endless_command_is_refused),
        cmocka_unit_test(test_client_that_does_not_read_is_dropped),
        cmocka_unit_test(test_random_input_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
