// SPDX-License-Identifier: Apache-2.0
// What a played update looked like: the time line, as text, as a table and as a drawing.
#ifndef SIM_UPDATE_UPDATE_RECORD_H
#define SIM_UPDATE_UPDATE_RECORD_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/update/update_play.h"

enum { UPDATE_RECORD_CHANGES = 1024 };

/** A board from a moment on. */
typedef struct {
    int64_t time_us;
    int board; /**< of the room, from 0 */
    update_play_look_t look;
} update_change_t;

/** All zero bytes is one that has seen nothing. */
typedef struct {
    update_change_t change[UPDATE_RECORD_CHANGES];
    int changes; /**< of the boards */
    bool full;   /**< more of them had no room */
    room_update_step_t step;
    bool switching; /**< the operator's task */
    int64_t end_us;
} update_record_t;

/** Note what has changed since the last call, and print it. Call it after each update_play_step(). */
void update_record_take(update_record_t *record, const update_play_t *play, const room_t *room, FILE *file);

/** Write FOLDER/update.csv and FOLDER/update.svg; the folder is made if it is missing. @return false with the reason in
 *  error; so too when changes had no room. */
bool update_record_write(const update_record_t *record, const room_t *room, const char *folder,
                         char error[FILE_ERROR_LENGTH]);

#endif
