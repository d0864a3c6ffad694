// SPDX-License-Identifier: Apache-2.0
// Fits every wall of a room to its corners, and warns of the odd ones.
#ifndef FIRMWARE_ROOM_ROOM_WALLS_H
#define FIRMWARE_ROOM_ROOM_WALLS_H

#include <stdbool.h>

#include "firmware/room.h"
#include "firmware/room/room_checks.h"

/**
 * Make room->board[].wall from room->board[].corners.
 *
 * Warns of a point more than 5 mm off its plane, of a marker more than 5 mm from where the corners put its pixel, of
 * three corners more than 1 degree from a right angle, and of a wall that looks mirrored.
 *
 * @return false with the report's error written at the first wall without a plane.
 */
bool room_walls_fit(const room_checker_t *checker, room_t *room);

#endif
