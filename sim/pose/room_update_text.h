// SPDX-License-Identifier: Apache-2.0
// A room's update in words: its boards as a table, what came of it, and what to do.
#ifndef SIM_POSE_ROOM_UPDATE_TEXT_H
#define SIM_POSE_ROOM_UPDATE_TEXT_H

#include <stdio.h>

#include "sim/pose/room_update.h"

enum { ROOM_UPDATE_TEXT_LENGTH = 320 };

/** "ready, 0.6 waits", "installing 37 %", "runs 0.6, on trial": how a board is, and what is in the way. */
void room_update_board_text(char text[ROOM_UPDATE_TEXT_LENGTH], const room_update_board_t *board);

/** @return Why a board did not do what it was asked for, and what to do. @param refusal  An update_refusal_t, or newer.
 */
const char *room_update_refusal(uint8_t refusal);

/** Every board as a row. */
void room_update_print_table(FILE *file, const room_update_t *update);

/** What came of it, and when the room is mixed how it can be made one again. */
void room_update_print_result(FILE *file, const room_update_t *update);

#endif
