// SPDX-License-Identifier: Apache-2.0
// One client of the socketcand server: its buffers and its conversation.
#ifndef SIM_BUS_SOCKETCAND_CLIENT_H
#define SIM_BUS_SOCKETCAND_CLIENT_H

#include <stdbool.h>
#include <stddef.h>

#include "sim/bus/socketcand_server.h"

enum { SOCKETCAND_INPUT_BYTES = 4096, SOCKETCAND_OUTPUT_BYTES = 65536 };

typedef struct {
    sim_bus_t *bus;
    hal_can_t *can;
    int socket;     /**< -1: nobody */
    bool leaving;   /**< disconnected, but its last frames are still to be sent */
    bool open, raw; /**< has sent the commands */
    bool ended;     /**< has sent its last byte */
    int64_t quiet_until_us;
    size_t input_length, output_length;
    char input[SOCKETCAND_INPUT_BYTES], output[SOCKETCAND_OUTPUT_BYTES];
} socketcand_client_t;

/** Take a place for the client behind a non-blocking socket, plug its controller in, and greet. */
void socketcand_client_begin(socketcand_client_t *client, int socket);

/** Read what is there, do it, and write what the bus has delivered; nothing blocks. Counts what happens. */
void socketcand_client_poll(socketcand_client_t *client, socketcand_server_stats_t *stats);

/** Hang up. Frames it has queued still go onto the bus while socketcand_client_poll() is called. */
void socketcand_client_disconnect(socketcand_client_t *client);

#endif
