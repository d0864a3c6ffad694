// SPDX-License-Identifier: Apache-2.0
// Rooms of many boards with pictures so small that they cost nothing, for tests of what boards do together.
#ifndef TESTS_SUPPORT_SMALL_ROOM_H
#define TESTS_SUPPORT_SMALL_ROOM_H

#include "firmware/room.h"

/** Board N, from 1, is called wallN; its wall of 4 m by 2.25 m stands N metres before the world's origin. */
typedef struct {
    int boards;               /**< 1 to 8 */
    int nodes_apart;          /**< board N has node N times this */
    bool classic;             /**< the bus has no FD */
    bool viewers;             /**< board N is viewer N % CAN_VIEWERS's; else all are viewer 0's */
    const double *display_ms; /**< display_delay_ms of each board; NULL: 0 */
} small_room_t;

/** The room. The test fails when that fails. */
void small_room_load(room_t *room, const small_room_t *settings);

/** The room of a room file's text. The test fails when it is wrong. */
void room_from_text(room_t *room, const char *text);

#endif
