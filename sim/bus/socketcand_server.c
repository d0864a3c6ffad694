// SPDX-License-Identifier: Apache-2.0
// Listens, and gives every client a place with a controller of its own.
#include "sim/bus/socketcand_server.h"

#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "sim/bus/socketcand_client.h"

enum { ACCEPTS_PER_POLL = 16 };

struct socketcand_server {
    int socket, port;
    socketcand_server_stats_t stats;
    socketcand_client_t client[SOCKETCAND_CLIENTS];
};

/* @return A listening socket, with its port; -1 with errno set. */
static int listen_on(int *port)
{
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0)
        return -1;
    struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)*port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof address;
    const int on = 1;
    if (setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        bind(fd, (const struct sockaddr *)&address, size) != 0 || listen(fd, ACCEPTS_PER_POLL) != 0 ||
        getsockname(fd, (struct sockaddr *)&address, &size) != 0) {
        const int why = errno;
        close(fd);
        errno = why;
        return -1;
    }
    *port = ntohs(address.sin_port);
    return fd;
}

socketcand_server_t *socketcand_server_open(int port, sim_bus_t *bus, char error[SOCKETCAND_ERROR_LENGTH])
{
    if (port < 0 || port > 65535) {
        snprintf(error, SOCKETCAND_ERROR_LENGTH, "port %d: expected 0 to 65535", port);
        return NULL;
    }
    socketcand_server_t *server = calloc(1, sizeof *server);
    if (server == NULL) {
        snprintf(error, SOCKETCAND_ERROR_LENGTH, "socketcand server: out of memory");
        return NULL;
    }
    server->port = port;
    server->socket = listen_on(&server->port);
    if (server->socket < 0) {
        snprintf(error, SOCKETCAND_ERROR_LENGTH, "port %d of 127.0.0.1: %s; expected a free port", port,
                 strerror(errno));
        free(server);
        return NULL;
    }
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++)
        server->client[i].socket = -1;
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++) {
        hal_can_t *can = sim_bus_attach(bus);
        if (can == NULL) {
            snprintf(error, SOCKETCAND_ERROR_LENGTH, "simulated bus: no room for %d more controllers, it takes %d",
                     SOCKETCAND_CLIENTS, SIM_BUS_MAX_CONTROLLERS);
            socketcand_server_close(server);
            return NULL;
        }
        server->client[i].bus = bus;
        server->client[i].can = can;
        sim_can_keep_order(can);
        sim_bus_fail_unplug(can);
    }
    return server;
}

void socketcand_server_close(socketcand_server_t *server)
{
    if (server == NULL)
        return;
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++) {
        socketcand_client_t *client = &server->client[i];
        if (client->socket >= 0)
            socketcand_client_disconnect(client);
        if (client->leaving)
            sim_bus_fail_unplug(client->can);
    }
    close(server->socket);
    free(server);
}

int socketcand_server_port(const socketcand_server_t *server)
{
    return server->port;
}

static void welcome(socketcand_server_t *server, int fd)
{
    static const char no_room[] = "< error no room, 8 clients are connected >";
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++) {
        socketcand_client_t *client = &server->client[i];
        if (client->socket < 0 && !client->leaving) {
            server->stats.accepted++;
            socketcand_client_begin(client, fd);
            return;
        }
    }
    server->stats.refused++;
    send(fd, no_room, sizeof no_room - 1, MSG_DONTWAIT | MSG_NOSIGNAL);
    close(fd);
}

void socketcand_server_poll(socketcand_server_t *server)
{
    for (int i = 0; i < ACCEPTS_PER_POLL; i++) {
        const int fd = accept4(server->socket, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (fd < 0)
            break;
        welcome(server, fd);
    }
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++)
        socketcand_client_poll(&server->client[i], &server->stats);
}

socketcand_server_stats_t socketcand_server_stats(const socketcand_server_t *server)
{
    socketcand_server_stats_t stats = server->stats;
    for (int i = 0; i < SOCKETCAND_CLIENTS; i++)
        stats.clients += server->client[i].socket >= 0;
    return stats;
}
