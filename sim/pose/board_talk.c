// SPDX-License-Identifier: Apache-2.0
// Requests to boards over a bus, and their replies.
#include "sim/pose/board_talk.h"

#include <string.h>

#include "sim/devices/sim_clock.h"

enum { HEADER_BYTES = 2, WAIT_MS = 1 };

static void begin(board_talk_t *talk, int64_t now_us)
{
    uint8_t bytes[COMMAND_MAX_BYTES];
    isotp_init(&talk->link, CAN_ID_REPLY + (uint32_t)talk->node, CAN_ID_COMMAND + (uint32_t)talk->node);
    (void)isotp_send(&talk->link, bytes, command_encode(bytes, &talk->request), now_us);
    talk->begun = true;
}

/* A reply to someone else's request is not ours. */
static void take_reply(board_talk_t *talk)
{
    const uint8_t *bytes;
    const int length = isotp_received(&talk->link, &bytes);
    if (length >= HEADER_BYTES && bytes[0] == ((uint8_t)talk->request.kind | COMMAND_REPLY_FLAG)) {
        talk->replied = true;
        talk->result = bytes[1];
        talk->length = length - HEADER_BYTES;
        memcpy(talk->answer, bytes + HEADER_BYTES, (size_t)talk->length);
    }
    if (length > 0)
        isotp_taken(&talk->link);
}

static bool send_due(pose_link_t *bus, board_talk_t *talk, int count, char error[POSE_LINK_MESSAGE_LENGTH])
{
    hal_can_frame_t frame;
    for (int i = 0; i < count; i++)
        while (talk[i].begun && isotp_next(&talk[i].link, &frame, sim_clock_monotonic_us()))
            if (!pose_link_send(bus, &frame, 1, error))
                return false;
    return true;
}

/* @return Was it one of a reply? */
static bool take_frame(board_talk_t *talk, int count, const hal_can_frame_t *frame)
{
    for (int i = 0; i < count; i++) {
        if (!talk[i].begun || talk[i].replied || !isotp_take(&talk[i].link, frame, sim_clock_monotonic_us()))
            continue;
        take_reply(&talk[i]);
        return true;
    }
    return false;
}

static bool all_replied(const board_talk_t *talk, int count)
{
    int replied = 0;
    for (int i = 0; i < count; i++)
        replied += talk[i].replied;
    return replied == count;
}

bool board_talk(pose_link_t *bus, board_talk_t *talk, int count, int64_t quiet_us, const volatile sig_atomic_t *stop,
                char error[POSE_LINK_MESSAGE_LENGTH])
{
    int64_t heard_us = sim_clock_monotonic_us();
    for (int i = 0; i < count; i++)
        talk[i].begun = talk[i].replied = false;
    int begun = 0; /* one request a turn: many at once would fill the queue of an interface */
    while (!all_replied(talk, count) && sim_clock_monotonic_us() - heard_us < quiet_us && !*stop) {
        if (begun < count)
            begin(&talk[begun++], sim_clock_monotonic_us());
        if (!send_due(bus, talk, count, error))
            return false;
        hal_can_frame_t frame;
        const pose_link_heard_t heard = pose_link_receive(bus, &frame, WAIT_MS, error);
        if (heard == POSE_LINK_ENDED)
            return false;
        if (heard == POSE_LINK_FRAME && take_frame(talk, count, &frame))
            heard_us = sim_clock_monotonic_us();
    }
    return true;
}
