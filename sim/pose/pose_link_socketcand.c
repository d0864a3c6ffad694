// SPDX-License-Identifier: Apache-2.0
// Client of the socketcand protocol in raw mode.
#include "sim/pose/pose_link_socketcand.h"

#include <assert.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "sim/bus/socketcand_text.h"

enum {
    CONNECT_TRIES = 50,
    CONNECT_PAUSE_MS = 100,
    MOST_PORT = 65535,
    ANSWER_TIMEOUT_S = 20, /* a simulation on a busy machine may take some to begin */
    SEND_TIMEOUT_S = 1,
    FINISH_TIMEOUT_S = 2,
    MOST_FRAMES = 8,
    LONGEST_SEND = 64 /**< "< send 1FFFFFFF 8 " and 8 bytes of "xx ", and ">" */
};

static int fail(char error[POSE_LINK_MESSAGE_LENGTH], const char *bus, const char *what, const char *advice)
{
    snprintf(error, POSE_LINK_MESSAGE_LENGTH, "%.60s: %.70s; %.100s", bus, what, advice);
    return -1;
}

/* Splits HOST:PORT or [HOST]:PORT. */
static bool split_address(const char *bus, char host[64], char port[8])
{
    const char *colon = strrchr(bus, ':');
    const char *first = bus;
    size_t length = (size_t)(colon - bus);
    if (length >= 2 && bus[0] == '[' && colon[-1] == ']') {
        first++;
        length -= 2;
    } else if (memchr(bus, ':', length) != NULL) {
        return false;
    }
    const size_t digits = strspn(colon + 1, "0123456789");
    if (length == 0 || length >= 64 || digits == 0 || digits > 5 || colon[1 + digits] != '\0')
        return false;
    const long number = strtol(colon + 1, NULL, 10);
    if (number < 1 || number > MOST_PORT)
        return false;
    memcpy(host, first, length);
    host[length] = '\0';
    memcpy(port, colon + 1, digits + 1);
    return true;
}

static int fail_address(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    return fail(error, bus, "not an address",
                "expected HOST:PORT with a port from 1 to 65535, such as 127.0.0.1:29536");
}

bool pose_link_socketcand_check(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    char host[64];
    char port[8];
    if (split_address(bus, host, port))
        return true;
    fail_address(bus, error);
    return false;
}

static int connect_once(const struct addrinfo *addresses)
{
    const struct timeval timeout = {.tv_sec = ANSWER_TIMEOUT_S};
    const int on = 1;
    for (const struct addrinfo *a = addresses; a != NULL; a = a->ai_next) {
        const int client = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
        if (client < 0)
            continue;
        setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout); /* bounds connect() too */
        setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        if (connect(client, a->ai_addr, a->ai_addrlen) == 0)
            return client;
        const int reason = errno;
        close(client);
        errno = reason;
    }
    return -1;
}

static int connect_patiently(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    char host[64];
    char port[8];
    if (!split_address(bus, host, port))
        return fail_address(bus, error);
    const struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    struct addrinfo *addresses = NULL;
    const int found = getaddrinfo(host, port, &hints, &addresses);
    if (found != 0)
        return fail(error, bus, gai_strerror(found), "expected HOST:PORT, such as 127.0.0.1:29536");
    int client = -1;
    for (int i = 0; i < CONNECT_TRIES && client < 0; i++) {
        if (i > 0)
            poll(NULL, 0, CONNECT_PAUSE_MS);
        client = connect_once(addresses);
        if (client < 0 && errno != ECONNREFUSED)
            break;
    }
    const int reason = errno;
    freeaddrinfo(addresses);
    return client >= 0 ? client : fail(error, bus, strerror(reason), "is `wallwarp-sim run --bus PORT` running there?");
}

/* Reads one "< ... >" and compares it. */
static bool expect(int client, const char *expected, char got[64])
{
    size_t length = 0;
    while (length < 63) {
        char c = 0;
        const ssize_t taken = recv(client, &c, 1, 0);
        if (taken < 0 && errno == EINTR)
            continue;
        if (taken <= 0)
            break;
        got[length++] = c;
        if (c == '>')
            break;
    }
    got[length] = '\0';
    return strcmp(got, expected) == 0;
}

static bool send_all(int client, const char *text, size_t length)
{
    while (length > 0) {
        const ssize_t sent = send(client, text, length, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return false;
        text += sent;
        length -= (size_t)sent;
    }
    return true;
}

static bool shake_hands(int client, const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    static const char *const say[] = {"", "< open can0 >", "< rawmode >"};
    static const char *const hear[] = {"< hi >", "< ok >", "< ok >"};
    for (int i = 0; i < 3; i++) {
        char got[64] = "";
        if (send_all(client, say[i], strlen(say[i])) && expect(client, hear[i], got))
            continue;
        const char *said = i == 0 ? "connect" : say[i];
        char what[128];
        if (got[0] == '\0')
            snprintf(what, sizeof what, "no answer to \"%s\"", said);
        else
            snprintf(what, sizeof what, "the answer to \"%s\" was \"%.30s\"", said, got);
        fail(error, bus, what, "expected a socketcand server with a bus can0 and room for one more");
        return false;
    }
    return true;
}

int pose_link_socketcand_open(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int client = connect_patiently(bus, error);
    if (client < 0)
        return -1;
    if (!shake_hands(client, bus, error)) {
        close(client);
        return -1;
    }
    const struct timeval timeout = {.tv_sec = SEND_TIMEOUT_S};
    setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
    return client;
}

/* Everything on the bus is sent to us; unread, it would stop the server in the end. */
static bool discard_received(int client)
{
    char heard[4096];
    for (;;) {
        const ssize_t got = recv(client, heard, sizeof heard, MSG_DONTWAIT);
        if (got == 0)
            return false;
        if (got < 0)
            return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    }
}

static size_t text_from_frame(char text[LONGEST_SEND], const hal_can_frame_t *frame)
{
    size_t length = (size_t)snprintf(text, LONGEST_SEND, frame->extended ? "< send %08X %X " : "< send %X %X ",
                                     (unsigned)frame->id, (unsigned)frame->length);
    for (int i = 0; i < frame->length; i++)
        length += (size_t)snprintf(text + length, LONGEST_SEND - length, "%x ", (unsigned)frame->data[i]);
    return length + (size_t)snprintf(text + length, LONGEST_SEND - length, ">");
}

bool pose_link_socketcand_send(pose_link_t *link, const hal_can_frame_t *frame, int count,
                               char error[POSE_LINK_MESSAGE_LENGTH])
{
    assert(count >= 1 && count <= MOST_FRAMES);
    char text[MOST_FRAMES * LONGEST_SEND];
    size_t length = 0;
    for (int i = 0; i < count; i++)
        length += text_from_frame(text + length, &frame[i]);
    if (!link->listening && !discard_received(link->socket)) {
        fail(error, link->name, "the server has closed the connection", "has the simulation come to its end?");
        return false;
    }
    if (send_all(link->socket, text, length))
        return true;
    fail(error, link->name, strerror(errno), "has the simulation come to its end?");
    return false;
}

/* The next "< ... >" in the input. @return Its length with what stands before it, or 0; *begin is where it begins. */
static size_t next_word(const pose_link_t *link, size_t *begin)
{
    const char *open = memchr(link->input, '<', link->input_length);
    if (open == NULL)
        return 0;
    *begin = (size_t)(open - link->input);
    const char *close = memchr(open, '>', link->input_length - *begin);
    return close == NULL ? 0 : (size_t)(close - link->input) + 1;
}

/* Take frames from the input until one is whole. */
static bool take_frame(pose_link_t *link, hal_can_frame_t *frame)
{
    size_t begin = 0;
    for (size_t end = next_word(link, &begin); end > 0; end = next_word(link, &begin)) {
        const bool is_frame = socketcand_frame_from_text(frame, link->input + begin, end - begin);
        link->input_length -= end;
        memmove(link->input, link->input + end, link->input_length);
        if (is_frame)
            return true;
    }
    return false;
}

pose_link_heard_t pose_link_socketcand_receive(pose_link_t *link, hal_can_frame_t *frame, int wait_ms,
                                               char error[POSE_LINK_MESSAGE_LENGTH])
{
    for (;;) {
        if (take_frame(link, frame))
            return POSE_LINK_FRAME;
        if (link->input_length == sizeof link->input)
            link->input_length = 0; /* no frame is as long as that: these are no words of this protocol */
        struct pollfd server = {.fd = link->socket, .events = POLLIN};
        if (poll(&server, 1, wait_ms) <= 0)
            return POSE_LINK_QUIET;
        const ssize_t got =
            recv(link->socket, link->input + link->input_length, sizeof link->input - link->input_length, MSG_DONTWAIT);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
            fail(error, link->name, "the server has closed the connection", "the simulation has come to its end");
            return POSE_LINK_ENDED;
        }
        if (got > 0)
            link->input_length += (size_t)got;
    }
}

void pose_link_socketcand_finish(pose_link_t *link)
{
    /* Closing with unread input would reset the connection and lose what is under way. */
    shutdown(link->socket, SHUT_WR);
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const time_t end_s = now.tv_sec + FINISH_TIMEOUT_S;
    struct pollfd server = {.fd = link->socket, .events = POLLIN};
    char heard[4096];
    while (now.tv_sec < end_s && poll(&server, 1, 100) >= 0) {
        if (server.revents != 0 && recv(link->socket, heard, sizeof heard, MSG_DONTWAIT) <= 0)
            return;
        clock_gettime(CLOCK_MONOTONIC, &now);
    }
}
