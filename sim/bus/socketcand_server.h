// SPDX-License-Identifier: Apache-2.0
// Opens a simulated CAN bus to TCP clients of this machine, in the socketcand protocol.
#ifndef SIM_BUS_SOCKETCAND_SERVER_H
#define SIM_BUS_SOCKETCAND_SERVER_H

#include <stdint.h>

#include "sim/bus/sim_bus.h"

/**
 * The bus is channel "can0" on 127.0.0.1, for up to 8 clients at a time. Every client has a controller of its own, so
 * clients hear each other but not themselves, and what one sends stays in order.
 *
 * Understood: < open can0 >, < rawmode >, < send ID LENGTH B0 ... >, < echo >. Anything else is answered with
 * < error TEXT >. A client in raw mode hears classic frames; FD frames have no words here, they are left out and
 * counted. Time stamps are the bus's. When a client's transmit queue is full its commands wait in its socket.
 *
 * Two kindnesses to python-can 4.1, which other clients do not notice: each frame is sent with a line feed before it
 * (that reader loses the character after the last whole frame it has got), and the first frame leaves
 * SOCKETCAND_QUIET_US of bus time after the answer to < rawmode > (which it expects alone in a packet).
 *
 * Everything is done in socketcand_server_poll(), without blocking and without the heap.
 */
typedef struct socketcand_server socketcand_server_t;

enum { SOCKETCAND_CLIENTS = 8, SOCKETCAND_ERROR_LENGTH = 256, SOCKETCAND_QUIET_US = 50000 };

/**
 * Listen.
 *
 * @param port   1 to 65535, or 0 for any free one.
 * @param bus    Gets SOCKETCAND_CLIENTS controllers, which stay with it when the server is closed. Must outlive the
 *               server. The caller advances it, to the wall clock when clients are to see real time.
 * @param error  On failure: one line, what failed and what was expected.
 * @return The server, for socketcand_server_close(); NULL on failure.
 */
socketcand_server_t *socketcand_server_open(int port, sim_bus_t *bus, char error[SOCKETCAND_ERROR_LENGTH]);

/** Disconnect everyone and free the server. NULL is allowed. */
void socketcand_server_close(socketcand_server_t *server);

/** @return The port it listens on. */
int socketcand_server_port(const socketcand_server_t *server);

/** Let clients in, queue their frames on the bus, write them what the bus has delivered. Never blocks. */
void socketcand_server_poll(socketcand_server_t *server);

typedef struct {
    int64_t accepted;       /**< clients let in */
    int64_t refused;        /**< clients turned away because 8 were there */
    int64_t dropped;        /**< clients disconnected because they did not read */
    int64_t wrong_commands; /**< answered with an error */
    int64_t frames_in;      /**< frames queued on the bus for clients */
    int64_t frames_out;     /**< frames written for clients */
    int64_t fd_left_out;    /**< FD frames not shown to a client */
    int32_t clients;        /**< connected now */
} socketcand_server_stats_t;

socketcand_server_stats_t socketcand_server_stats(const socketcand_server_t *server);

#endif
