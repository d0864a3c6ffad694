// SPDX-License-Identifier: Apache-2.0
// Turns a client's commands into frames and what its controller hears into text; all buffers are bounded.
#include "sim/bus/socketcand_client.h"

#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "sim/bus/socketcand_text.h"

enum { READS_PER_POLL = 8 }; /* so that one busy client cannot hold the loop */

void socketcand_client_disconnect(socketcand_client_t *client)
{
    close(client->socket);
    client->socket = -1;
    client->raw = false;
    client->leaving = true;
}

static void flush(socketcand_client_t *client)
{
    if (client->socket < 0 || client->output_length == 0)
        return;
    const ssize_t sent = send(client->socket, client->output, client->output_length, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent <= 0)
        return; /* no room now, or gone: reading tells */
    client->output_length -= (size_t)sent;
    memmove(client->output, client->output + sent, client->output_length);
}

/* Queue text for a client. One that lets its buffer run full is hung up on. */
static void say(socketcand_client_t *client, socketcand_server_stats_t *stats, const char *text)
{
    const size_t length = strlen(text);
    if (client->socket < 0)
        return;
    if (client->output_length + length > SOCKETCAND_OUTPUT_BYTES) {
        stats->dropped++;
        socketcand_client_disconnect(client);
        return;
    }
    memcpy(client->output + client->output_length, text, length);
    client->output_length += length;
}

static void say_error(socketcand_client_t *client, socketcand_server_stats_t *stats, const char *problem)
{
    char text[SOCKETCAND_COMMAND_LENGTH];
    snprintf(text, sizeof text, "< error %s >", problem);
    stats->wrong_commands++;
    say(client, stats, text);
}

/* @return Whether the command is dealt with; false when it must wait for room in the transmit queue. */
static bool send_frame(socketcand_client_t *client, socketcand_server_stats_t *stats, const hal_can_frame_t *frame)
{
    if (!client->open) {
        say_error(client, stats, "no channel is open, expected < open can0 > first");
        return true;
    }
    const hal_status_t status = hal_can_send(client->can, frame);
    if (status == HAL_FULL)
        return false;
    if (status == HAL_OK)
        stats->frames_in++;
    else
        say_error(client, stats, "bus off, the frame is not sent");
    return true;
}

static void open_channel(socketcand_client_t *client, socketcand_server_stats_t *stats, const char *channel)
{
    if (strcmp(channel, "can0") != 0) {
        say_error(client, stats, "could not open bus, expected can0");
        return;
    }
    client->open = true;
    say(client, stats, "< ok >");
}

static void enter_raw_mode(socketcand_client_t *client, socketcand_server_stats_t *stats)
{
    if (!client->open) {
        say_error(client, stats, "no channel is open, expected < open can0 > first");
        return;
    }
    say(client, stats, "< ok >");
    flush(client);
    client->raw = true;
    client->quiet_until_us = sim_bus_now_us(client->bus) + SOCKETCAND_QUIET_US;
}

/* @return As send_frame(). */
static bool perform(socketcand_client_t *client, socketcand_server_stats_t *stats, const socketcand_command_t *command)
{
    switch (command->verb) {
    case SOCKETCAND_SEND:
        return send_frame(client, stats, &command->frame);
    case SOCKETCAND_OPEN:
        open_channel(client, stats, command->channel);
        return true;
    case SOCKETCAND_RAWMODE:
        enter_raw_mode(client, stats);
        return true;
    case SOCKETCAND_ECHO:
        say(client, stats, "< echo >");
        return true;
    case SOCKETCAND_WRONG:
    default:
        say_error(client, stats, command->problem);
        return true;
    }
}

/* Perform the whole commands in the input buffer. @return false when one must wait. */
static bool perform_input(socketcand_client_t *client, socketcand_server_stats_t *stats)
{
    size_t at = 0;
    bool done = true;
    while (client->socket >= 0) {
        const char *end = client->input + client->input_length;
        const char *begin = memchr(client->input + at, '<', client->input_length - at);
        if (begin == NULL) {
            at = client->input_length;
            break;
        }
        const char *close_bracket = memchr(begin, '>', (size_t)(end - begin));
        const size_t length = (size_t)((close_bracket == NULL ? end : close_bracket + 1) - begin);
        at = (size_t)(begin - client->input);
        if (length > SOCKETCAND_COMMAND_LENGTH) {
            say_error(client, stats, "command is longer than 256 characters");
        } else if (close_bracket == NULL) {
            break;
        } else {
            const socketcand_command_t command = socketcand_command_from_text(begin, length);
            done = perform(client, stats, &command);
            if (!done)
                break;
        }
        at += length;
    }
    client->input_length -= at;
    memmove(client->input, client->input + at, client->input_length);
    return done;
}

/* Acknowledge what was read at once. A client that did not ask for TCP_NODELAY, as python-can's, holds a small command
 * back until the one before is acknowledged: up to 40 ms, in which a set of poses would fall apart. */
static void acknowledge(int socket)
{
    const int on = 1;
    (void)setsockopt(socket, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

static void read_commands(socketcand_client_t *client, socketcand_server_stats_t *stats)
{
    bool done = perform_input(client, stats);
    for (int i = 0; i < READS_PER_POLL && done && client->socket >= 0 && !client->ended; i++) {
        const ssize_t got = recv(client->socket, client->input + client->input_length,
                                 SOCKETCAND_INPUT_BYTES - client->input_length, MSG_DONTWAIT);
        if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
            break;
        acknowledge(client->socket);
        client->ended = got <= 0;
        client->input_length += got > 0 ? (size_t)got : 0;
        done = perform_input(client, stats);
    }
    if (client->ended && done && client->socket >= 0) {
        flush(client);
        socketcand_client_disconnect(client);
    }
}

static void write_frames(socketcand_client_t *client, socketcand_server_stats_t *stats)
{
    hal_can_frame_t frame;
    while (hal_can_receive(client->can, &frame) == HAL_OK) {
        if (!client->raw)
            continue;
        if (frame.fd) {
            stats->fd_left_out++;
            continue;
        }
        char text[SOCKETCAND_FRAME_LENGTH + 1] = "\n";
        socketcand_text_from_frame(text + 1, &frame);
        say(client, stats, text);
        stats->frames_out += client->socket >= 0;
    }
    if (sim_bus_now_us(client->bus) >= client->quiet_until_us)
        flush(client);
}

/* A controller driven bus-off comes back by itself, as an interface with restart-ms does. */
static void keep_controller_going(socketcand_client_t *client)
{
    if (hal_can_state(client->can) == HAL_CAN_BUS_OFF && hal_can_restart(client->can) != HAL_OK)
        return; /* stuck: tried again at the next poll */
    if (client->leaving && sim_can_stats(client->can).pending == 0) {
        client->leaving = false;
        sim_bus_fail_unplug(client->can);
    }
}

void socketcand_client_begin(socketcand_client_t *client, int socket)
{
    const int on = 1, buffer = SOCKETCAND_OUTPUT_BYTES;
    static const char greeting[] = "< hi >";
    /* Both only speed things up or save memory: a refusal changes nothing else. */
    (void)setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    (void)setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
    client->socket = socket;
    client->open = client->ended = false;
    client->quiet_until_us = 0;
    client->input_length = 0;
    client->output_length = sizeof greeting - 1;
    memcpy(client->output, greeting, client->output_length);
    sim_bus_replug(client->can);
    flush(client);
}

void socketcand_client_poll(socketcand_client_t *client, socketcand_server_stats_t *stats)
{
    if (client->socket >= 0)
        read_commands(client, stats);
    if (client->socket >= 0 || client->leaving) {
        write_frames(client, stats);
        keep_controller_going(client);
    }
}
