// SPDX-License-Identifier: Apache-2.0
// Plays a room's update in virtual time: the real firmware of every board, the operator's room_update_t, and failures.
//
// First all boards install, then they switch. Panels and camera are small and nobody is tracked: pictures are not what
// this is about, and the safe picture is as healthy as any.
#ifndef SIM_UPDATE_UPDATE_PLAY_H
#define SIM_UPDATE_UPDATE_PLAY_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/room.h"
#include "sim/files/file_io.h"
#include "sim/pose/room_update.h"

typedef struct update_play update_play_t;

/** What goes wrong on a board. */
typedef enum {
    UPDATE_PLAY_WELL,
    UPDATE_PLAY_INSTALL, /**< its install fails */
    UPDATE_PLAY_CRASH,   /**< the new version does not start on it: it falls back */
    UPDATE_PLAY_SILENT,  /**< its bus cable is out when it is to promise the switch */
    UPDATE_PLAY_DEAF, /**< its bus cable is out when it is to hear that the moment holds, until that is over by 5 s */
    UPDATE_PLAY_LOST, /**< its bus cable is out from when all have promised until the moment is over by 5 s */
    UPDATE_PLAY_FAILURES
} update_play_failure_t;

/** @return "well", "install", "crash", "silent", "deaf", "lost". */
const char *update_play_failure_name(update_play_failure_t failure);

typedef struct {
    const room_t *room;
    update_play_failure_t failure[ROOM_MAX_BOARDS]; /**< in the order of the room file */
    int64_t install_us, reboot_us, ahead_us;        /**< see sim_update.h and room_update.h */
    uint32_t lose_ppm;                              /**< of all frames on the bus are lost, of a million */
    can_auth_t *key; /**< of the room, must outlive the play: a tracker with it gives bus time then; NULL: none */
    uint64_t seed;
} update_play_settings_t;

/** How a board is, in one word: the rows of the time line. */
typedef enum {
    UPDATE_PLAY_IDLE,
    UPDATE_PLAY_INSTALLING,
    UPDATE_PLAY_READY,
    UPDATE_PLAY_PROMISED, /**< or confirmed */
    UPDATE_PLAY_DOWN,
    UPDATE_PLAY_TRIAL,
    UPDATE_PLAY_NEW, /**< it runs the new version, and that is good */
    UPDATE_PLAY_FAILED,
    UPDATE_PLAY_LOOKS
} update_play_look_t;

/** @return "installing". */
const char *update_play_look_name(update_play_look_t look);

/** Uses the heap. @return NULL with the reason in error: no memory, or settings out of range. */
update_play_t *update_play_open(const update_play_settings_t *settings, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void update_play_close(update_play_t *play);

/** One refresh. @return false when it has come to its end, or the world has failed: see update_play_error(). */
bool update_play_step(update_play_t *play);

/** @return NULL, or what has failed in the simulation itself. */
const char *update_play_error(const update_play_t *play);

/** @return Since the start. */
int64_t update_play_now_us(const update_play_t *play);

/** @return The operator's side as it is: of the install, then of the switch. */
const room_update_t *update_play_operator(const update_play_t *play);

/** @return The result of the install, while the switch goes on and after; ROOM_UPDATE_WORKING before. */
room_update_result_t update_play_installed(const update_play_t *play);

update_play_look_t update_play_look(const update_play_t *play, int board);

/** @return Of its install. */
int32_t update_play_progress(const update_play_t *play, int board);

/** @return When the board told its agent to switch, since the start; INT64_MIN: never. */
int64_t update_play_switched_us(const update_play_t *play, int board);

/** @return The version that the board runs, or is starting. */
const char *update_play_running(const update_play_t *play, int board);

/** @return Does the board know of the new version as installed in its other slot? */
bool update_play_has_bundle(const update_play_t *play, int board);

extern const char update_play_old[], update_play_new[];

#endif
