// SPDX-License-Identifier: Apache-2.0
// Tells boards with a key which session a tracker's messages are of: all boards at its start, and whoever asks later,
// because it has started anew or has believed another tracker meanwhile.
//
// Boards are known by their heartbeats. Each is asked for a number and then told, both over ISO-TP (command.h); what
// goes wrong begins again with the board's next heartbeat. The heartbeats are not signed: a stranger who makes some up
// makes us talk, and nothing else.
#ifndef SIM_POSE_SESSION_TELLER_H
#define SIM_POSE_SESSION_TELLER_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_auth.h"
#include "firmware/can_protocol.h"
#include "firmware/isotp.h"

/** What one board has been told. */
typedef struct {
    bool told;
    enum { SESSION_IDLE, SESSION_ASKED, SESSION_SENT } stage;
    int64_t begun_us, again_us; /**< when the talk began; and when the next may */
    isotp_t link;
} session_board_t;

typedef struct {
    can_auth_t *auth;
    uint64_t session;
    int told;    /**< times that a board has taken the session */
    int refused; /**< times that one has not: has it another key? */
    session_board_t board[CAN_MAX_NODE + 1];
} session_teller_t;

/** Begin; nobody has been told. @param auth  Must outlive the teller. */
void session_teller_init(session_teller_t *teller, can_auth_t *auth, uint64_t session);

/** Hear a frame from the bus. @param now_us  Of any steady clock. @param bus_us  Bus time now. */
void session_teller_hear(session_teller_t *teller, const hal_can_frame_t *frame, int64_t now_us, uint64_t bus_us);

/** @return Is there a frame to be sent now? Call it until there is none, about every 5 ms. */
bool session_teller_next(session_teller_t *teller, hal_can_frame_t *frame, int64_t now_us);

#endif
