// SPDX-License-Identifier: Apache-2.0
// The key `frames` of a room file: refresh rate, and which pose and picture belong together.
#ifndef FIRMWARE_ROOM_ROOM_FRAMES_H
#define FIRMWARE_ROOM_ROOM_FRAMES_H

#include "firmware/room/room_checks.h"

/** Check and store it; room->camera must be known. @return false when a value was refused. */
bool room_frames_check(const room_checker_t *checker, const room_yaml_frames_t *yaml, room_t *room);

#endif
