// SPDX-License-Identifier: Apache-2.0
// Serves a simulated bus in real time for python-can to talk to: serve_bus SECONDS [FRAMES_PER_SECOND]
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "sim/bus/sim_bus.h"
#include "sim/bus/socketcand_server.h"
#include "sim/devices/sim_clock.h"

/* Run the bus with the clock; a board sends a counter as identifier 7FF at the rate asked for. */
static void serve(sim_bus_t *bus, socketcand_server_t *server, int64_t seconds, int64_t rate)
{
    hal_can_t *board = sim_bus_attach(bus);
    const int64_t start_us = sim_clock_monotonic_us();
    int64_t now_us = 0, count = 0;
    while (board != NULL && now_us < seconds * 1000000) {
        now_us = sim_clock_monotonic_us() - start_us;
        sim_bus_advance(bus, now_us);
        for (; count * 1000000 < now_us * rate; count++) {
            const hal_can_frame_t frame = {.id = 0x7FF, .length = 2, .data = {(uint8_t)(count >> 8), (uint8_t)count}};
            if (hal_can_send(board, &frame) != HAL_OK)
                break;
        }
        socketcand_server_poll(server);
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
}

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 3) {
        fprintf(stderr, "usage: serve_bus SECONDS [FRAMES_PER_SECOND]\n");
        return 2;
    }
    char error[SOCKETCAND_ERROR_LENGTH];
    sim_bus_t *bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 500000});
    socketcand_server_t *server = bus == NULL ? NULL : socketcand_server_open(0, bus, error);
    if (server == NULL) {
        fprintf(stderr, "serve_bus: %s\n", bus == NULL ? "out of memory" : error);
        sim_bus_destroy(bus);
        return 1;
    }
    printf("%d\n", socketcand_server_port(server));
    fflush(stdout);
    serve(bus, server, strtoll(argv[1], NULL, 10), argc > 2 ? strtoll(argv[2], NULL, 10) : 0);
    const socketcand_server_stats_t stats = socketcand_server_stats(server);
    printf("%" PRId64 " clients, %" PRId64 " frames in, %" PRId64 " out, %" PRId64 " wrong commands, %" PRId64
           " dropped\n",
           stats.accepted, stats.frames_in, stats.frames_out, stats.wrong_commands, stats.dropped);
    socketcand_server_close(server);
    sim_bus_destroy(bus);
    return 0;
}
