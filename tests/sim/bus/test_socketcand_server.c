// SPDX-License-Identifier: Apache-2.0
// The socketcand door: the protocol byte by byte, order, and places for clients.
#include "sim/bus/socketcand_server.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/socketcand_bench.h"

static void expect_at_board(const socketcand_bench_t *bench, uint32_t id, bool extended, int length, const char *bytes)
{
    hal_can_frame_t frame;
    assert_int_equal(hal_can_receive(bench->board, &frame), HAL_OK);
    assert_int_equal(frame.id, id);
    assert_int_equal(frame.extended, extended);
    assert_false(frame.fd);
    assert_int_equal(frame.length, length);
    assert_memory_equal(frame.data, bytes, (size_t)length);
}

static void expect_nothing_at_board(const socketcand_bench_t *bench)
{
    assert_int_equal(hal_can_receive(bench->board, &(hal_can_frame_t){0}), HAL_EMPTY);
}

static void test_frames_from_a_client_reach_the_bus(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    socketcand_bench_say(&bench, fd, "< send 123 2 a ff >< send 1FFFFFFF 8 1 2 3 4 5 6 7 8 >");
    expect_at_board(&bench, 0x123, false, 2, "\x0a\xff");
    expect_at_board(&bench, 0x1FFFFFFF, true, 8, "\1\2\3\4\5\6\7\10");
    socketcand_bench_say(&bench, fd, "< send 0 0  >"); /* python-can's way to send no bytes */
    expect_at_board(&bench, 0, false, 0, "");
    socketcand_bench_say(&bench, fd, "< send 00000123 0 >");
    expect_at_board(&bench, 0x123, true, 0, "");
    socketcand_bench_say(&bench, fd, "< send 800 0 >"); /* too large for 11 bits, python-can does not pad */
    expect_at_board(&bench, 0x800, true, 0, "");
    socketcand_bench_expect(fd, "");
    socketcand_bench_say(&bench, fd, "< echo >");
    socketcand_bench_expect(fd, "< echo >");
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_frames_on_the_bus_reach_clients_but_not_their_sender(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int one = socketcand_bench_raw_client(&bench), two = socketcand_bench_raw_client(&bench);
    sim_bus_advance(bench.bus, 23424142);
    assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 0}), HAL_OK);
    socketcand_bench_turn(&bench, 1);
    socketcand_bench_expect(one, "\n< frame 000 23.424242  >"); /* 50 bits later */
    socketcand_bench_expect(two, "\n< frame 000 23.424242  >");
    const hal_can_frame_t frame = {.id = 0xABCDEF, .extended = true, .length = 3, .data = {1, 0x2B, 0xFF}};
    sim_bus_advance(bench.bus, 30000000);
    assert_int_equal(hal_can_send(bench.board, &frame), HAL_OK);
    assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 1, .fd = true, .length = 32}), HAL_OK);
    socketcand_bench_turn(&bench, 2);
    char text[SOCKETCAND_BENCH_TEXT];
    assert_true(socketcand_bench_hear(one, text) > 0);
    assert_memory_equal(text, "\n< frame 00ABCDEF 30.000", 24);
    assert_string_equal(strchr(text, '.') + 7, " 012BFF >");
    assert_int_equal(socketcand_server_stats(bench.server).fd_left_out, 2);
    assert_true(socketcand_bench_hear(two, text) > 0);
    socketcand_bench_say(&bench, one, "< send 7 0 >");
    socketcand_bench_expect(one, "");
    assert_true(socketcand_bench_hear(two, text) > 0);
    assert_memory_equal(text, "\n< frame 007 30.", 16);
    close(one);
    close(two);
    socketcand_bench_end(&bench);
}

static void test_answer_to_rawmode_comes_alone(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_connect(&bench);
    socketcand_bench_turn(&bench, 1);
    socketcand_bench_expect(fd, "< hi >");
    socketcand_bench_say(&bench, fd, "< open can0 >");
    socketcand_bench_expect(fd, "< ok >");
    socketcand_bench_put(fd, "< rawmode >");
    for (int i = 0; i < SOCKETCAND_QUIET_US / 1000; i++) {
        assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 1}), HAL_OK);
        socketcand_bench_turn(&bench, 1);
    }
    socketcand_bench_expect(fd, "< ok >");
    socketcand_bench_turn(&bench, 3);
    char text[SOCKETCAND_BENCH_TEXT];
    assert_int_equal(socketcand_bench_hear(fd, text), SOCKETCAND_QUIET_US / 1000 * 24); /* held back, not lost */
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_commands_in_pieces_and_merged(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    const char *text = "< send 12 1 ab >\r\n< send 13 0 >< echo >";
    for (const char *at = text; *at != '\0'; at++)
        socketcand_bench_say(&bench, fd, (char[]){*at, '\0'});
    expect_at_board(&bench, 0x12, false, 1, "\xab");
    expect_at_board(&bench, 0x13, false, 0, "");
    socketcand_bench_expect(fd, "< echo >");
    close(fd);
    socketcand_bench_end(&bench);
}

/* 200 frames at once are more than a transmit queue holds, and keep their order whatever their identifiers. */
static void test_burst_waits_for_room_and_keeps_order(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    char text[16];
    for (int i = 0; i < 200; i++) {
        snprintf(text, sizeof text, "< send %X 0 >", 500 - i);
        socketcand_bench_put(fd, text);
    }
    shutdown(fd, SHUT_WR); /* what was sent before hanging up still goes out */
    for (int i = 0; i < 5000 && socketcand_server_stats(bench.server).clients > 0; i++)
        socketcand_bench_turn(&bench, 1);
    socketcand_bench_turn(&bench, 20);
    for (uint32_t i = 0; i < 200; i++)
        expect_at_board(&bench, 500 - i, false, 0, "");
    expect_nothing_at_board(&bench);
    assert_int_equal(socketcand_server_stats(bench.server).clients, 0);
    assert_int_equal(socketcand_server_stats(bench.server).dropped, 0);
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_eight_clients_and_places_free_again(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    int fd[SOCKETCAND_CLIENTS];
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++)
        fd[i] = socketcand_bench_raw_client(&bench);
    const int ninth = socketcand_bench_connect(&bench);
    socketcand_bench_turn(&bench, 1);
    socketcand_bench_expect(ninth, "< error no room, 8 clients are connected >");
    close(ninth);
    assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 1}), HAL_OK);
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++)
        close(fd[i]);
    for (int i = 0; i < 5000 && socketcand_server_stats(bench.server).clients > 0; i++)
        socketcand_bench_turn(&bench, 1);
    const int next = socketcand_bench_connect(&bench);
    socketcand_bench_turn(&bench, 1);
    assert_int_equal(hal_can_send(bench.board, &(hal_can_frame_t){.id = 1}), HAL_OK);
    socketcand_bench_turn(&bench, 2);
    socketcand_bench_expect(next, "< hi >"); /* not in raw mode, whatever the one before it was */
    assert_int_equal(socketcand_server_stats(bench.server).refused, 1);
    assert_int_equal(socketcand_server_stats(bench.server).accepted, 9);
    close(next);
    socketcand_bench_end(&bench);
}

static void test_bus_off_client_is_told_and_comes_back(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const int fd = socketcand_bench_raw_client(&bench);
    sim_bus_fail(bench.bus, SIM_BUS_ERROR, (sim_bus_fail_t){.next = 32});
    socketcand_bench_say(&bench, fd, "< send 1 0 >");
    for (int i = 0; i < 20 && sim_bus_stats(bench.bus).error_frames < 32; i++)
        socketcand_bench_turn(&bench, 1);
    socketcand_bench_say(&bench, fd, "< send 2 0 >");
    socketcand_bench_expect(fd, "< error bus off, the frame is not sent >");
    socketcand_bench_turn(&bench, 5);
    socketcand_bench_say(&bench, fd, "< send 3 0 >");
    expect_at_board(&bench, 3, false, 0, "");
    close(fd);
    socketcand_bench_end(&bench);
}

static void test_bad_ports_and_full_buses_are_told(void **state)
{
    (void)state;
    char error[SOCKETCAND_ERROR_LENGTH] = "";
    const socketcand_bench_t bench = socketcand_bench_begin();
    assert_null(socketcand_server_open(65536, bench.bus, error));
    assert_string_equal(error, "port 65536: expected 0 to 65535");
    assert_null(socketcand_server_open(-1, bench.bus, error));
    assert_null(socketcand_server_open(socketcand_server_port(bench.server), bench.bus, error));
    assert_non_null(strstr(error, "expected a free port"));
    while (sim_bus_attach(bench.bus) != NULL)
        continue;
    assert_null(socketcand_server_open(0, bench.bus, error));
    assert_non_null(strstr(error, "no room for 8 more controllers"));
    socketcand_server_close(NULL);
    socketcand_bench_end(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames_from_a_client_reach_the_bus),
        cmocka_unit_test(test_frames_on_the_bus_reach_clients_but_not_their_sender),
        cmocka_unit_test(test_answer_to_rawmode_comes_alone),
        cmocka_unit_test(test_commands_in_pieces_and_merged),
        cmocka_unit_test(test_burst_waits_for_room_and_keeps_order),
        cmocka_unit_test(test_eight_clients_and_places_free_again),
        cmocka_unit_test(test_bus_off_client_is_told_and_comes_back),
        cmocka_unit_test(test_bad_ports_and_full_buses_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
