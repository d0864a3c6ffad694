// SPDX-License-Identifier: Apache-2.0
// For tests of the socketcand server: a bus with a board, the server, and clients that talk to it.
#ifndef TESTS_SUPPORT_SOCKETCAND_BENCH_H
#define TESTS_SUPPORT_SOCKETCAND_BENCH_H

#include <stddef.h>

#include "sim/bus/socketcand_server.h"

enum { SOCKETCAND_BENCH_TEXT = 65536 };

typedef struct {
    sim_bus_t *bus;
    hal_can_t *board;
    socketcand_server_t *server;
} socketcand_bench_t;

/** All of these fail the running test when something does not work. */
socketcand_bench_t socketcand_bench_begin(void);
void socketcand_bench_end(const socketcand_bench_t *bench);

/** @return The socket of a new client, for close(). */
int socketcand_bench_connect(const socketcand_bench_t *bench);

/** @return The socket of a new client in raw mode, past its quiet time. */
int socketcand_bench_raw_client(const socketcand_bench_t *bench);

/** Turn the loop as the simulator does, in steps of 1 ms of bus time. */
void socketcand_bench_turn(const socketcand_bench_t *bench, int times);

/** Send for a client, see to it that the server's socket has it, and turn the loop twice. */
void socketcand_bench_say(const socketcand_bench_t *bench, int client, const char *text);

/** Send without turning the loop. */
void socketcand_bench_put(int client, const char *text);

/** Take what has come for a client, waiting a second at most when nothing has. @return Its length. */
size_t socketcand_bench_hear(int client, char text[SOCKETCAND_BENCH_TEXT]);

/** What comes next for the client is this, and when it is "", nothing is there. */
void socketcand_bench_expect(int client, const char *text);

#endif
