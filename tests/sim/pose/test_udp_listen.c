// SPDX-License-Identifier: Apache-2.0
// Tests of the tracker's socket: addresses, unicast, a multicast group on the loopback, and every refusal.
#include "sim/pose/udp_listen.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"

/* From the loopback to an address; and it must be heard. */
static void expect_heard(int listener, const char *host, int port)
{
    const int sender = socket(AF_INET, SOCK_DGRAM, 0);
    const struct in_addr loopback = {.s_addr = htonl(INADDR_LOOPBACK)};
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    assert_int_equal(inet_pton(AF_INET, host, &to.sin_addr), 1);
    assert_int_equal(setsockopt(sender, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback), 0);
    uint8_t heard[8] = "";
    int64_t arrived_us = 0;
    bool stamped = false;
    /* The kernel begins to stamp a moment after it is asked to: until then the time of taking is all there is. */
    for (int i = 0; i < 50 && !stamped; i++) {
        const int64_t sent_us = sim_clock_monotonic_us();
        assert_int_equal(sendto(sender, "pose", 4, 0, (const struct sockaddr *)&to, sizeof to), 4);
        struct pollfd ready = {.fd = listener, .events = POLLIN};
        assert_int_equal(poll(&ready, 1, 5000), 1);
        usleep(30000); /* it waits, which must not show */
        assert_int_equal(udp_listen_take(listener, heard, sizeof heard, &arrived_us), 4);
        assert_memory_equal(heard, "pose", 4);
        assert_true(arrived_us >= sent_us - 1000);
        stamped = arrived_us <= sim_clock_monotonic_us() - 29000;
    }
    assert_true(stamped);
    assert_int_equal(udp_listen_take(listener, heard, sizeof heard, &arrived_us), -1);
    close(sender);
}

static void test_unicast(void **state)
{
    (void)state;
    char error[UDP_LISTEN_MESSAGE_LENGTH] = "";
    int port = 0, same = 0;
    const int listener = udp_listen_open("127.0.0.1:0", NULL, &port, error);
    if (listener < 0)
        fail_msg("%s", error);
    assert_int_not_equal(port, 0);
    expect_heard(listener, "127.0.0.1", port);
    char address[32];
    snprintf(address, sizeof address, "127.0.0.1:%d", port);
    assert_int_equal(udp_listen_open(address, NULL, &same, error), -1);
    assert_non_null(strstr(error, "is another program listening there"));
    close(listener);
}

static void test_two_may_hear_a_group(void **state)
{
    (void)state;
    char error[UDP_LISTEN_MESSAGE_LENGTH] = "";
    char address[32];
    int port = 0, same = 0;
    const int first = udp_listen_open("236.10.10.10:0", "127.0.0.1", &port, error);
    if (first < 0)
        fail_msg("%s", error);
    snprintf(address, sizeof address, "236.10.10.10:%d", port);
    const int second = udp_listen_open(address, "127.0.0.1", &same, error);
    if (second < 0)
        fail_msg("%s", error);
    assert_int_equal(port, same);
    expect_heard(first, "236.10.10.10", port);
    close(first);
    close(second);
}

static void test_what_cannot_be_listened_to(void **state)
{
    (void)state;
    static const struct {
        const char *address, *interface, *reason;
    } bad[] = {
        {"", NULL, "expected ADDR:PORT"},
        {"5000", NULL, "expected ADDR:PORT"},
        {":5000", NULL, "expected ADDR:PORT"},
        {"localhost:5000", NULL, "expected ADDR:PORT"},
        {"127.0.0.1:", NULL, "expected ADDR:PORT"},
        {"127.0.0.1:65536", NULL, "expected ADDR:PORT"},
        {"127.0.0.1:-1", NULL, "expected ADDR:PORT"},
        {"127.0.0.1:1x", NULL, "expected ADDR:PORT"},
        {"127.0.0.256:1", NULL, "expected ADDR:PORT"},
        {"1111.2222.3333.4444:1", NULL, "expected ADDR:PORT"},
        {"[::1]:5000", NULL, "expected ADDR:PORT"},
        {"236.10.10.10:1", "eth0", "expected an interface's own"},
        {"127.0.0.1:1", "127.0.0.1", "not a multicast group"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char error[UDP_LISTEN_MESSAGE_LENGTH] = "";
        int port = 77;
        if (udp_listen_check(bad[i].address, bad[i].interface, error))
            fail_msg("\"%s\" is taken", bad[i].address);
        if (strstr(error, bad[i].reason) == NULL)
            fail_msg("\"%s\": the reason is \"%s\", expected \"%s\"", bad[i].address, error, bad[i].reason);
        assert_int_equal(udp_listen_open(bad[i].address, bad[i].interface, &port, error), -1);
        assert_int_equal(port, 77);
    }
    char error[UDP_LISTEN_MESSAGE_LENGTH] = "";
    int port = 77;
    assert_int_equal(udp_listen_open("192.0.2.1:5000", NULL, &port, error), -1);
    assert_non_null(strstr(error, "not this machine's address"));
    assert_int_equal(udp_listen_open("236.10.10.10:5000", "192.0.2.1", &port, error), -1);
    assert_non_null(strstr(error, "See --interface"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unicast),
        cmocka_unit_test(test_two_may_hear_a_group),
        cmocka_unit_test(test_what_cannot_be_listened_to),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
