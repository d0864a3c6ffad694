// SPDX-License-Identifier: Apache-2.0
// Are a room's boards, and poses for them, on this bus? A part of `wallwarp-pose check --room`.
#ifndef SIM_POSE_BUS_CHECK_ROOM_H
#define SIM_POSE_BUS_CHECK_ROOM_H

#include <stdio.h>

#include "firmware/room.h"
#include "sim/pose/bus_watch.h"

/**
 * Print a line for each board of the room that is silent, for each that is heard but not of the room, for each viewer
 * that boards follow and that has no poses while another has, for each whose newest pose is within 20 mm of the origin,
 * as in metres, or behind the wall of a board that follows it, all bad; and for each that has poses which nobody
 * follows. A bus without any frame gets no line: bus_check_print() says that.
 *
 * @param watch  As for bus_check_print(), which looks at what is there.
 * @return Bad things found.
 */
int bus_check_room(FILE *file, const bus_watch_t *watch, const room_t *room);

#endif
