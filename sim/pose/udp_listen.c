// SPDX-License-Identifier: Apache-2.0
// A UDP socket that hears a tracker: unicast, or a multicast group.
#include "sim/pose/udp_listen.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "sim/pose/kernel_stamp.h"

enum { MOST_PORT = 65535, LONGEST_ADDRESS = 15 };

static bool fail(char error[UDP_LISTEN_MESSAGE_LENGTH], const char *address, const char *what, const char *advice)
{
    snprintf(error, UDP_LISTEN_MESSAGE_LENGTH, "%.60s: %.70s; %.110s", address, what, advice);
    return false;
}

static bool read_address(const char *address, struct sockaddr_in *read)
{
    const char *colon = strchr(address, ':');
    const size_t length = colon == NULL ? 0 : (size_t)(colon - address);
    if (length == 0 || length > LONGEST_ADDRESS)
        return false;
    char host[LONGEST_ADDRESS + 1] = "";
    memcpy(host, address, length);
    const size_t digits = strspn(colon + 1, "0123456789");
    if (digits == 0 || digits > 5 || colon[1 + digits] != '\0')
        return false;
    const long port = strtol(colon + 1, NULL, 10);
    *read = (struct sockaddr_in){.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    return port <= MOST_PORT && inet_pton(AF_INET, host, &read->sin_addr) == 1;
}

static bool is_group(const struct sockaddr_in *address)
{
    return IN_MULTICAST(ntohl(address->sin_addr.s_addr));
}

bool udp_listen_check(const char *address, const char *interface, char error[UDP_LISTEN_MESSAGE_LENGTH])
{
    struct sockaddr_in read;
    struct in_addr joined;
    if (!read_address(address, &read))
        return fail(error, address, "not an address", "expected ADDR:PORT, such as 0.0.0.0:5000 or 236.10.10.10:56565");
    if (interface == NULL)
        return true;
    if (inet_pton(AF_INET, interface, &joined) != 1)
        return fail(error, interface, "not an address", "expected an interface's own, such as 192.168.1.20");
    return is_group(&read) || fail(error, address, "not a multicast group", "an interface is chosen for groups only");
}

static bool join(int listener, const struct sockaddr_in *address, const char *interface)
{
    const int on = 1;
    struct ip_mreqn group = {.imr_multiaddr = address->sin_addr};
    if (interface != NULL)
        inet_pton(AF_INET, interface, &group.imr_address);
    return setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
           setsockopt(listener, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0;
}

int udp_listen_open(const char *address, const char *interface, int *port, char error[UDP_LISTEN_MESSAGE_LENGTH])
{
    if (!udp_listen_check(address, interface, error))
        return -1;
    struct sockaddr_in bound;
    socklen_t size = sizeof bound;
    read_address(address, &bound);
    const int listener = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), on = 1;
    if (listener < 0 || setsockopt(listener, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0) {
        fail(error, address, strerror(errno), "expected a UDP socket");
        if (listener >= 0)
            close(listener);
        return -1;
    }
    if (is_group(&bound) && !join(listener, &bound, interface))
        fail(error, address, strerror(errno), "the group cannot be joined: is the network up? See --interface");
    else if (bind(listener, (const struct sockaddr *)&bound, size) != 0)
        fail(error, address, strerror(errno),
             "is another program listening there, or is it not this machine's address?");
    else if (getsockname(listener, (struct sockaddr *)&bound, &size) != 0)
        fail(error, address, strerror(errno), "expected a port");
    else {
        *port = ntohs(bound.sin_port);
        return listener;
    }
    close(listener);
    return -1;
}

ssize_t udp_listen_take(int listener, uint8_t *bytes, size_t place, int64_t *arrived_us)
{
    union {
        struct cmsghdr aligned;
        uint8_t bytes[KERNEL_STAMP_BYTES];
    } control;
    struct iovec data = {.iov_base = bytes, .iov_len = place};
    struct msghdr message = {
        .msg_iov = &data, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
    const ssize_t size = recvmsg(listener, &message, MSG_DONTWAIT);
    if (size >= 0)
        *arrived_us = kernel_stamp_us(&message);
    return size;
}
