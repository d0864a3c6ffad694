// SPDX-License-Identifier: Apache-2.0
// Clients, a server and a board in one process, without threads: the loop turns when a test says so.
#include "tests/support/socketcand_bench.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>
#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

socketcand_bench_t socketcand_bench_begin(void)
{
    char error[SOCKETCAND_ERROR_LENGTH];
    sim_bus_t *bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 2000000, .fd = true});
    hal_can_t *board = sim_bus_attach(bus);
    socketcand_server_t *server = socketcand_server_open(0, bus, error);
    if (server == NULL)
        fail_msg("%s", error);
    return (socketcand_bench_t){bus, board, server};
}

void socketcand_bench_end(const socketcand_bench_t *bench)
{
    socketcand_server_close(bench->server);
    sim_bus_destroy(bench->bus);
}

int socketcand_bench_connect(const socketcand_bench_t *bench)
{
    const int client = socket(AF_INET, SOCK_STREAM, 0), on = 1;
    const struct sockaddr_in address = {.sin_family = AF_INET,
                                        .sin_port = htons((uint16_t)socketcand_server_port(bench->server)),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(connect(client, (const struct sockaddr *)&address, sizeof address), 0);
    assert_int_equal(setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on), 0);
    return client;
}

void socketcand_bench_turn(const socketcand_bench_t *bench, int times)
{
    for (int i = 0; i < times; i++) {
        sim_bus_advance(bench->bus, sim_bus_now_us(bench->bus) + 1000);
        socketcand_server_poll(bench->server);
    }
}

void socketcand_bench_put(int client, const char *text)
{
    assert_int_equal(send(client, text, strlen(text), MSG_NOSIGNAL), strlen(text));
}

void socketcand_bench_say(const socketcand_bench_t *bench, int client, const char *text)
{
    socketcand_bench_put(client, text);
    int on_the_way = 1;
    for (int i = 0; i < 2000 && on_the_way > 0; i++) {
        assert_int_equal(ioctl(client, SIOCOUTQ, &on_the_way), 0);
        if (on_the_way > 0)
            usleep(500);
    }
    assert_int_equal(on_the_way, 0);
    socketcand_bench_turn(bench, 2);
}

size_t socketcand_bench_hear(int client, char text[SOCKETCAND_BENCH_TEXT])
{
    struct pollfd ready = {.fd = client, .events = POLLIN};
    poll(&ready, 1, 1000);
    const ssize_t length = recv(client, text, SOCKETCAND_BENCH_TEXT - 1, MSG_DONTWAIT);
    text[length > 0 ? length : 0] = '\0';
    return length > 0 ? (size_t)length : 0;
}

void socketcand_bench_expect(int client, const char *text)
{
    static char heard[SOCKETCAND_BENCH_TEXT];
    if (*text != '\0') {
        socketcand_bench_hear(client, heard);
    } else {
        const ssize_t length = recv(client, heard, sizeof heard - 1, MSG_DONTWAIT);
        heard[length > 0 ? length : 0] = '\0';
    }
    assert_string_equal(heard, text);
}

int socketcand_bench_raw_client(const socketcand_bench_t *bench)
{
    const int client = socketcand_bench_connect(bench);
    socketcand_bench_turn(bench, 2);
    socketcand_bench_expect(client, "< hi >");
    socketcand_bench_say(bench, client, "< open can0 >");
    socketcand_bench_expect(client, "< ok >");
    socketcand_bench_say(bench, client, "< rawmode >");
    socketcand_bench_expect(client, "< ok >");
    socketcand_bench_turn(bench, SOCKETCAND_QUIET_US / 1000);
    return client;
}
