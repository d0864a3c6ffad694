// SPDX-License-Identifier: Apache-2.0
// What the answers of a room's boards mean for its update: room_update.c's own.
#ifndef SIM_POSE_ROOM_UPDATE_JUDGE_H
#define SIM_POSE_ROOM_UPDATE_JUDGE_H

#include "sim/pose/room_update.h"

/** @return Is no board in the way? */
bool room_update_all_well(const room_update_t *update);

/** After a look during an install: go on, or how it has ended. */
void room_update_judge_installs(room_update_t *update, int64_t now_us);

/** Which version to switch to, and which boards have to. Those that can't are in the way. */
void room_update_choose_boards(room_update_t *update);

/** One moment for all of them. @return false, and nothing is changed, when their bus times are not one. */
bool room_update_choose_moment(room_update_t *update, int64_t now_us);

/** After a look behind the moment: go on, or how it has ended. */
void room_update_judge_starts(room_update_t *update, int64_t now_us);

/** After a look behind a cancellation: has a board switched all the same, or may one have? Go on, or how it has ended.
 */
void room_update_judge_cancellation(room_update_t *update, int64_t now_us);

#endif
