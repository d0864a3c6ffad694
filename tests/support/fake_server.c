// SPDX-License-Identifier: Apache-2.0
// A socketcand server made up in a thread: greets, answers two commands as the test likes, and hears what comes.
#include "tests/support/fake_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

/* To the end of a command, or to the end of everything. */
static void hear(fake_server_t *server, int client, bool everything)
{
    char c = '\0';
    while ((everything || c != '>') && server->length < FAKE_SERVER_HEARD - 1 && recv(client, &c, 1, 0) == 1)
        server->heard[server->length++] = c;
}

static void say(int client, const char *text)
{
    if (send(client, text, strlen(text), MSG_NOSIGNAL) < 0)
        return; /* the client has left: what it makes of that is the test */
}

static void *serve(void *context)
{
    fake_server_t *server = context;
    const int client = accept(server->listening, NULL, NULL);
    if (client < 0)
        return NULL;
    say(client, server->greeting);
    if (server->answer == NULL) {
        close(client);
        return NULL;
    }
    hear(server, client, false);
    say(client, server->answer);
    hear(server, client, false);
    say(client, "< ok >< frame 123 1.5 1122 >");
    for (int i = 0; i < 1000; i++)
        say(client, "< frame 700 2.5 1122334455667788 >");
    hear(server, client, true);
    close(client);
    return NULL;
}

void fake_server_start(fake_server_t *server, const char *greeting, const char *answer)
{
    memset(server, 0, sizeof *server);
    server->greeting = greeting;
    server->answer = answer;
    server->listening = socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof address;
    assert_int_equal(bind(server->listening, (struct sockaddr *)&address, size), 0);
    assert_int_equal(listen(server->listening, 1), 0);
    assert_int_equal(getsockname(server->listening, (struct sockaddr *)&address, &size), 0);
    snprintf(server->address, sizeof server->address, "127.0.0.1:%u", (unsigned)ntohs(address.sin_port));
    assert_int_equal(pthread_create(&server->thread, NULL, serve, server), 0);
}

void fake_server_stop(fake_server_t *server)
{
    assert_int_equal(pthread_join(server->thread, NULL), 0);
    close(server->listening);
    server->heard[server->length] = '\0';
}
