// SPDX-License-Identifier: Apache-2.0
// Requests to boards over a bus, and their replies.
#include "sim/pose/board_talk.h"

#include <string.h>

#include "firmware/byte_order.h"
#include "firmware/can_protocol.h"
#include "sim/devices/sim_clock.h"

enum { HEADER_BYTES = 2, NUMBER_BYTES = 4, NONCE_BYTES = 8, WAIT_MS = 1 };

static void ask(board_talk_t *talk, int64_t now_us)
{
    static const command_t nonce = {.kind = COMMAND_NONCE};
    uint8_t bytes[COMMAND_MAX_BYTES];
    isotp_init(&talk->link, CAN_ID_REPLY + (uint32_t)talk->node, CAN_ID_COMMAND + (uint32_t)talk->node);
    (void)isotp_send(&talk->link, bytes, command_encode(bytes, talk->auth == NULL ? &talk->request : &nonce), now_us);
    talk->coded = false;
    talk->tries++;
    talk->heard_us = now_us;
}

void board_talk_begin(board_talk_t *talk, int count)
{
    for (int i = 0; i < count; i++)
        talk[i] = (board_talk_t){.node = talk[i].node, .request = talk[i].request, .auth = talk[i].auth};
}

void board_talk_ask(board_talk_t *talk, int count, int64_t quiet_us, int64_t now_us)
{
    for (int i = 0; i < count; i++) {
        const bool due = talk[i].tries == 0 || now_us - talk[i].heard_us >= quiet_us;
        if (talk[i].replied || !due || talk[i].tries == BOARD_TALK_TRIES)
            continue;
        ask(&talk[i], now_us);
        return;
    }
}

/* The board has given a number, or knows of none. */
static void take_nonce(board_talk_t *talk, const uint8_t *reply, int length, int64_t now_us)
{
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    if (length < HEADER_BYTES || reply[0] != (COMMAND_NONCE | COMMAND_REPLY_FLAG))
        return;
    if (reply[1] != COMMAND_OK || length != HEADER_BYTES + NONCE_BYTES) {
        talk->replied = talk->keyless = true;
        talk->result = COMMAND_UNKNOWN;
        return;
    }
    const int plain = command_encode(bytes, &talk->request);
    const can_auth_command_t command = {talk->link.send_id, bytes, plain, get_u64(reply + HEADER_BYTES)};
    if (can_auth_sign_command(talk->auth, &command, bytes + plain))
        talk->coded = isotp_send(&talk->link, bytes, plain + CAN_AUTH_COMMAND_BYTES, now_us);
}

/* A reply to someone else's request is not ours; nor is a late one to a request for earlier events. */
static bool is_ours(const board_talk_t *talk, const uint8_t *bytes, int length)
{
    if (length < HEADER_BYTES || bytes[0] != ((uint8_t)talk->request.kind | COMMAND_REPLY_FLAG))
        return false;
    return talk->request.kind != COMMAND_LOG || length < HEADER_BYTES + NUMBER_BYTES ||
           get_u32(bytes + HEADER_BYTES) >= talk->request.first_event;
}

static void take_reply(board_talk_t *talk, int64_t now_us)
{
    const uint8_t *bytes;
    const int length = isotp_received(&talk->link, &bytes);
    const bool coding = talk->auth != NULL && !talk->coded;
    if (coding) {
        take_nonce(talk, bytes, length, now_us);
    } else if (length > 0 && is_ours(talk, bytes, length) && bytes[1] == COMMAND_REFUSED && talk->auth != NULL &&
               talk->tries < BOARD_TALK_TRIES) {
        ask(talk, now_us);
        return;
    } else if (length > 0 && is_ours(talk, bytes, length)) {
        talk->replied = true;
        talk->result = bytes[1];
        talk->length = length - HEADER_BYTES;
        memcpy(talk->answer, bytes + HEADER_BYTES, (size_t)talk->length);
    }
    if (length > 0)
        isotp_taken(&talk->link);
}

bool board_talk_next(board_talk_t *talk, int count, hal_can_frame_t *frame, int64_t now_us)
{
    for (int i = 0; i < count; i++)
        if (talk[i].tries > 0 && isotp_next(&talk[i].link, frame, now_us))
            return true;
    return false;
}

void board_talk_hear(board_talk_t *talk, int count, const hal_can_frame_t *frame, int64_t now_us)
{
    for (int i = 0; i < count; i++) {
        talk[i].alive |= !frame->extended && frame->id == CAN_ID_HEARTBEAT + (uint32_t)talk[i].node;
        if (talk[i].tries == 0 || talk[i].replied || !isotp_take(&talk[i].link, frame, now_us))
            continue;
        talk[i].heard_us = now_us;
        talk[i].answering = true;
        take_reply(&talk[i], now_us);
    }
}

bool board_talk_settled(const board_talk_t *talk, int count, int64_t quiet_us, int64_t now_us)
{
    int settled = 0;
    for (int i = 0; i < count; i++)
        settled += talk[i].replied || (talk[i].tries == BOARD_TALK_TRIES && now_us - talk[i].heard_us >= quiet_us);
    return settled == count;
}

bool board_talk(pose_link_t *bus, board_talk_t *talk, int count, int64_t quiet_us, const volatile sig_atomic_t *stop,
                char error[POSE_LINK_MESSAGE_LENGTH])
{
    hal_can_frame_t frame;
    board_talk_begin(talk, count);
    while (!board_talk_settled(talk, count, quiet_us, sim_clock_monotonic_us()) && !*stop) {
        board_talk_ask(talk, count, quiet_us, sim_clock_monotonic_us());
        while (board_talk_next(talk, count, &frame, sim_clock_monotonic_us()))
            if (!pose_link_send(bus, &frame, 1, error))
                return false;
        const pose_link_heard_t heard = pose_link_receive(bus, &frame, WAIT_MS, error);
        if (heard == POSE_LINK_ENDED)
            return false;
        if (heard == POSE_LINK_FRAME)
            board_talk_hear(talk, count, &frame, sim_clock_monotonic_us());
    }
    return true;
}
