// SPDX-License-Identifier: Apache-2.0
// A board that can't do its work says why: on its wall, on the bus, to its service manager.
//
// For a firmware that was started with the board's own file, which nobody may be there to hear on a console: a wrong
// configuration, room or key, or a device that is not as they want it. It shows the safe picture with the reason, sends
// Heartbeats in state fault with CAN_FAULT_CONFIG and nothing else, executes what operators ask for, feeds the
// watchdog, and takes no part in bus time and frame numbers, as what it knows of the room may be wrong.
#ifndef FIRMWARE_NOTICE_H
#define FIRMWARE_NOTICE_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/projector.h"

typedef struct {
    const char *reason;           /**< one line */
    char board[ROOM_NAME_LENGTH]; /**< its name in the room; without a room, what kind of board it is */
    int32_t node;                 /**< 0: none is known; the board then has no bus */
    bool deaf; /**< does nothing that it is asked for, as there may be a key to tell who may ask, and it has none */
} notice_t;

/**
 * Make a projector ready for notice_step().
 *
 * @param[out] projector  Need not be initialised.
 * @param      devices    As hal_board_open_some() has opened them.
 * @param[out] room       Memory for a room that stands in for the board's own; of no use afterwards.
 */
void notice_init(projector_t *projector, const notice_t *notice, const hal_board_t *devices, room_t *room);

/** In place of projector_step(), after each vertical blank. Never blocks, never allocates. */
void notice_step(projector_t *projector, const notice_t *notice);

#endif
