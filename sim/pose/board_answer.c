// SPDX-License-Identifier: Apache-2.0
// What a board has answered, in words.
#include "sim/pose/board_answer.h"

#include <inttypes.h>
#include <stdio.h>

#include "firmware/byte_order.h"
#include "sim/pose/event_text.h"
#include "sim/pose/request_text.h"

enum { NUMBER_BYTES = 4, HELLO_BYTES = 5 };

static bool say(const char *program, int node, const char *what)
{
    fprintf(stderr, "%s: board %d %s\n", program, node, what);
    return false;
}

/* A latency that the room cannot have. */
static bool say_latency(const char *program, const board_talk_t *talk)
{
    char text[128];
    const double least_ms = get_u32(talk->answer) / 1e3, most_ms = get_u32(talk->answer + NUMBER_BYTES) / 1e3;
    snprintf(text, sizeof text, "cannot: its room's slowest board takes %.1f ms, the fastest can wait until %.1f",
             least_ms, most_ms);
    return say(program, talk->node, text);
}

bool board_answer_silent(const char *program, const board_talk_t *talk)
{
    return say(program, talk->node,
               talk->answering ? "replies, but no reply comes whole: frames are lost; see `wallwarp-pose check`"
               : talk->alive   ? "sends its heartbeat, but does not reply; is another asking it, or its firmware older?"
                               : "is silent, without a heartbeat; power, cable, bit rate? Its node number? "
                                 "`wallwarp-pose monitor` shows who is there");
}

bool board_answer_done(const char *program, const board_talk_t *talk)
{
    if (!talk->replied)
        return board_answer_silent(program, talk);
    if (talk->keyless)
        return say(program, talk->node, "has no key; leave --key out");
    if (talk->tries > 1)
        fprintf(stderr, "%s: board %d had to be asked %d times; are frames lost? See `wallwarp-pose check`\n", program,
                talk->node, talk->tries);
    if (talk->result == COMMAND_IMPOSSIBLE && talk->request.kind == COMMAND_LATENCY && talk->length >= 2 * NUMBER_BYTES)
        return say_latency(program, talk);
    if (talk->result != COMMAND_OK)
        return say(program, talk->node, request_refusal(talk->request.kind, talk->result));
    const bool short_hello = talk->request.kind == COMMAND_HELLO && talk->length < HELLO_BYTES;
    const bool short_number =
        (talk->request.kind == COMMAND_LATENCY || talk->request.kind == COMMAND_LOG) && talk->length < NUMBER_BYTES;
    if (short_hello || short_number)
        return say(program, talk->node, "replies with less than it should; is its firmware of this version?");
    return true;
}

void board_answer_print(const board_talk_t *talk)
{
    const uint8_t *answer = talk->answer;
    switch (talk->request.kind) {
    case COMMAND_HELLO:
        printf("board %d: %.*s, %" PRIu32 " events\n", talk->node, talk->length - HELLO_BYTES,
               (const char *)answer + HELLO_BYTES, get_u32(answer + 1));
        break;
    case COMMAND_LATENCY:
        printf("board %d: pose to photon will be %.1f ms\n", talk->node, get_u32(answer) / 1e3);
        break;
    case COMMAND_REBOOT:
        printf("board %d: starts anew when its watchdog ends, in about 2 s\n", talk->node);
        break;
    case COMMAND_METHOD:
    case COMMAND_FREEZE:
    case COMMAND_PATTERN:
    case COMMAND_LOG:
    case COMMAND_NONCE:
    case COMMAND_SESSION:
    case COMMAND_UPDATE:
        printf("board %d: done\n", talk->node);
        break;
    }
}

int board_answer_print_events(const board_talk_t *talk)
{
    const int events = (talk->length - NUMBER_BYTES) / EVENT_BYTES;
    for (int i = 0; i < events; i++) {
        char text[EVENT_TEXT_LENGTH];
        event_t event;
        (void)event_unpack(&event, talk->answer + NUMBER_BYTES + EVENT_BYTES * i);
        event_text(text, &event);
        printf("board %d: %s\n", talk->node, text);
    }
    return events;
}
