// SPDX-License-Identifier: Apache-2.0
// Tells boards with a key which session a tracker's messages are of.
#include "sim/pose/session_teller.h"

#include "firmware/byte_order.h"
#include "firmware/command.h"

enum { HEADER_BYTES = 2, NONCE_BYTES = 8, GIVE_UP_US = 1500000, KEYLESS_US = 10000000 };

void session_teller_init(session_teller_t *teller, can_auth_t *auth, uint64_t session)
{
    *teller = (session_teller_t){.auth = auth, .session = session};
}

static void send(session_board_t *board, const command_t *request, const session_teller_t *teller, uint64_t nonce,
                 int64_t now_us)
{
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    int length = command_encode(bytes, request);
    const can_auth_command_t plain = {board->link.send_id, bytes, length, nonce};
    if (request->kind != COMMAND_NONCE && can_auth_sign_command(teller->auth, &plain, bytes + length))
        length += CAN_AUTH_COMMAND_BYTES;
    (void)isotp_send(&board->link, bytes, length, now_us);
}

static void take_heartbeat(session_teller_t *teller, const can_heartbeat_t *heartbeat, int64_t now_us)
{
    session_board_t *board = &teller->board[heartbeat->node];
    const bool wants = (heartbeat->fault_flags & CAN_FAULT_SESSION) != 0;
    if (board->stage != SESSION_IDLE || (board->told && !wants) || now_us < board->again_us)
        return;
    isotp_init(&board->link, CAN_ID_REPLY + (uint32_t)heartbeat->node, CAN_ID_COMMAND + (uint32_t)heartbeat->node);
    send(board, &(command_t){.kind = COMMAND_NONCE}, teller, 0, now_us);
    board->stage = SESSION_ASKED;
    board->begun_us = now_us;
}

static void take_nonce(session_teller_t *teller, session_board_t *board, const uint8_t *reply, int length,
                       int64_t now_us, uint64_t bus_us)
{
    if (reply[1] != COMMAND_OK || length != HEADER_BYTES + NONCE_BYTES) {
        board->stage = SESSION_IDLE; /* it has no key */
        board->again_us = now_us + KEYLESS_US;
        return;
    }
    const command_t request = {.kind = COMMAND_SESSION, .session = teller->session, .bus_time_us = bus_us};
    const uint64_t nonce = get_u64(reply + HEADER_BYTES);
    send(board, &request, teller, nonce, now_us);
    board->stage = SESSION_SENT;
}

static void take_reply(session_teller_t *teller, session_board_t *board, int64_t now_us, uint64_t bus_us)
{
    uint8_t reply[HEADER_BYTES + NONCE_BYTES] = {0};
    const uint8_t *bytes;
    const int length = isotp_received(&board->link, &bytes);
    if (length == 0)
        return;
    for (int i = 0; i < length && i < (int)sizeof reply; i++)
        reply[i] = bytes[i];
    isotp_taken(&board->link);
    if (board->stage == SESSION_ASKED && reply[0] == (COMMAND_NONCE | COMMAND_REPLY_FLAG)) {
        take_nonce(teller, board, reply, length, now_us, bus_us);
    } else if (board->stage == SESSION_SENT && reply[0] == (COMMAND_SESSION | COMMAND_REPLY_FLAG)) {
        board->told = reply[1] == COMMAND_OK;
        board->stage = SESSION_IDLE;
        teller->told += board->told;
        teller->refused += !board->told;
    }
}

void session_teller_hear(session_teller_t *teller, const hal_can_frame_t *frame, int64_t now_us, uint64_t bus_us)
{
    can_heartbeat_t heartbeat;
    if (can_heartbeat_decode(&heartbeat, frame) == CAN_CHECK_OK) {
        take_heartbeat(teller, &heartbeat, now_us);
        return;
    }
    session_board_t *board = &teller->board[frame->id & CAN_MAX_NODE];
    if (board->stage != SESSION_IDLE && isotp_take(&board->link, frame, now_us))
        take_reply(teller, board, now_us, bus_us);
}

bool session_teller_next(session_teller_t *teller, hal_can_frame_t *frame, int64_t now_us)
{
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        session_board_t *board = &teller->board[node];
        if (board->stage == SESSION_IDLE)
            continue;
        if (isotp_next(&board->link, frame, now_us))
            return true;
        if (now_us - board->begun_us > GIVE_UP_US)
            board->stage = SESSION_IDLE;
    }
    return false;
}
