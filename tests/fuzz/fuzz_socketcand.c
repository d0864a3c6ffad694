// SPDX-License-Identifier: Apache-2.0
// Fuzzes one client's conversation with the simulated bus: any bytes in any pieces, with frames and faults between.
//
// Bytes below EVENTS are what the client says; those from there on are events of the other side.
#include "sim/bus/socketcand_client.h"

#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/fuzz/input.h"

enum {
    EVENTS = 0xF4,
    TURN = EVENTS, /* the server looks */
    SEND_CLASSIC,  /* another board sends: what it sends is taken from the input */
    SEND_FD,
    STICK,   /* the client's driver is stuck, */
    UNSTICK, /* or no longer */
    BUS_OFF,
    UNPLUG,
    REPLUG,
    READ,    /* the client reads what it has been told */
    WAIT,    /* time passes */
    HANG_UP, /* the client says no more */
    REPEAT   /* the client says its last piece again, many times */
};

typedef struct {
    sim_bus_t *bus;
    hal_can_t *board;
    socketcand_client_t *client;
    socketcand_server_stats_t stats;
    int peer; /* the client's end of the line */
    bool hung_up;
    const uint8_t *said; /* the last piece */
    size_t said_length;
    int depth;
    size_t echo; /* characters of "< echo >" heard in a row */
} bench_t;

static void hear(bench_t *bench)
{
    static const char echo[] = "< echo >";
    char text[8192];
    for (ssize_t got; (got = recv(bench->peer, text, sizeof text, MSG_DONTWAIT)) > 0;) {
        for (ssize_t i = 0; i < got; i++) {
            const char c = text[i];
            fuzz_check((c >= ' ' && c <= '~') || (c == '\n' && bench->depth == 0), "the server speaks text");
            bench->depth += (c == '<') - (c == '>');
            fuzz_check(bench->depth >= 0 && bench->depth <= 2, "the server's brackets match");
            if (bench->echo < sizeof echo - 1)
                bench->echo = c == echo[bench->echo] ? bench->echo + 1 : c == '<';
        }
    }
}

static void check_board(hal_can_t *board)
{
    hal_can_frame_t frame;
    while (hal_can_receive(board, &frame) == HAL_OK) {
        fuzz_check(!frame.fd && frame.length <= 8, "a client sends classic frames");
        fuzz_check(frame.id <= (frame.extended ? 0x1FFFFFFFU : 0x7FFU), "a client's identifiers are legal");
    }
}

static void turn(bench_t *bench, int64_t duration_us)
{
    sim_bus_advance(bench->bus, sim_bus_now_us(bench->bus) + duration_us);
    socketcand_client_poll(bench->client, &bench->stats);
    fuzz_check(bench->client->input_length <= SOCKETCAND_INPUT_BYTES, "the input buffer holds");
    fuzz_check(bench->client->socket >= 0 || bench->hung_up || bench->stats.dropped > 0, "nobody is cut off who reads");
    fuzz_check(bench->client->output_length <= SOCKETCAND_OUTPUT_BYTES, "the output buffer holds");
    check_board(bench->board);
}

static void board_sends(bench_t *bench, input_t *input, bool fd)
{
    static const uint8_t lengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    hal_can_frame_t frame = {.id = (uint32_t)input_bits(input, 4), .fd = fd};
    frame.extended = frame.id > 0x7FF;
    frame.length = lengths[input_byte(input) % 16];
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = input_byte(input);
    const bool legal = frame.id <= 0x1FFFFFFF && (fd || frame.length <= 8);
    fuzz_check((hal_can_send(bench->board, &frame) == HAL_BAD_CALL) == !legal, "only illegal frames are bad calls");
}

/* A full line loses some of it: as good a text as any. @return false then. */
static bool say(const bench_t *bench)
{
    return send(bench->peer, bench->said, bench->said_length, MSG_DONTWAIT | MSG_NOSIGNAL) ==
           (ssize_t)bench->said_length;
}

static void one_event(bench_t *bench, input_t *input, uint8_t event)
{
    switch (event) {
    case SEND_CLASSIC:
    case SEND_FD:
        board_sends(bench, input, event == SEND_FD);
        break;
    case STICK:
    case UNSTICK:
        sim_bus_fail_driver(bench->client->can, event == STICK);
        break;
    case BUS_OFF:
        sim_bus_fail_bus_off(bench->client->can);
        break;
    case UNPLUG:
        sim_bus_fail_unplug(bench->client->can);
        break;
    case REPLUG:
        sim_bus_replug(bench->client->can);
        break;
    case READ:
        hear(bench);
        break;
    case WAIT:
        turn(bench, 1000 * (int64_t)input_byte(input));
        break;
    case HANG_UP:
        shutdown(bench->peer, SHUT_WR);
        bench->hung_up = true;
        break;
    case REPEAT:
        for (int times = input_byte(input) % 64; times > 0 && bench->said_length > 0 && say(bench); times--)
            continue;
        break;
    case TURN:
    default:
        turn(bench, 1000);
    }
}

/* Whatever came before: on a bus that works again, a client that reads is heard and answered. */
static void check_alive(bench_t *bench)
{
    sim_bus_fail_driver(bench->client->can, false);
    if (bench->client->socket >= 0)
        sim_bus_replug(bench->client->can);
    for (int i = 0; i < 200 && (i < 2 || sim_can_stats(bench->client->can).pending > 0); i++) {
        turn(bench, 10000);
        hear(bench);
    }
    static const char question[] = ">< echo >";
    bench->echo = 0;
    const bool asked = send(bench->peer, question, sizeof question - 1, MSG_DONTWAIT | MSG_NOSIGNAL) > 0;
    for (int i = 0; i < 1000 && bench->echo < 8 && bench->client->socket >= 0; i++) {
        turn(bench, 10000);
        hear(bench);
    }
    fuzz_check(!asked || bench->client->socket < 0 || bench->echo == 8, "a client is answered in the end");
}

static void talk(bench_t *bench, input_t *input)
{
    while (input->left > 0) {
        size_t said = 0;
        while (said < input->left && input->bytes[said] < EVENTS)
            said++;
        if (said > 0) {
            bench->said = input->bytes;
            bench->said_length = said;
            (void)say(bench);
        }
        input->bytes += said;
        input->left -= said;
        if (input->left > 0)
            one_event(bench, input, input_byte(input));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    int pair[2];
    static socketcand_client_t client; /* large, and all zero again for each input */
    bench_t bench = {.client = &client};
    bench.bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 2000000, .fd = true});
    bench.board = sim_bus_attach(bench.bus);
    memset(&client, 0, sizeof client);
    client.bus = bench.bus;
    client.can = sim_bus_attach(bench.bus);
    sim_can_keep_order(client.can);
    sim_bus_fail_unplug(client.can);
    fuzz_check(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair) == 0, "a line is there");
    bench.peer = pair[1];
    socketcand_client_begin(&client, pair[0]);
    talk(&bench, &input);
    check_alive(&bench);
    if (client.socket >= 0)
        socketcand_client_disconnect(&client);
    close(bench.peer);
    sim_bus_destroy(bench.bus);
    return 0;
}
