// SPDX-License-Identifier: Apache-2.0
// Updates all boards of a room as one: the operator's side of firmware/update.h.
//
// Install: every board is asked how it is; when all are well, each is told to install; done when each has the same
// version waiting. Nothing that runs changes.
//
// Switch: when every board has the version in its other slot, all are asked to promise it for one moment of bus time;
// when all have promised, all are told that it holds. When one refuses or is silent, all are told to drop it: none
// switches, whatever is lost then, as long as not one was told that it holds. After the moment the boards are watched
// until each runs the version and has marked it good, or is back in its former slot. Boards that run the version
// already are left alone, so the same brings a part of a room back.
//
// Of two boards of which one was told that it holds and the other was not heard, the first may switch alone if it does
// not hear the cancellation either; that is seen, and told, after the moment.
//
// Any clock, any bus: the caller hands frames to and fro. No heap.
#ifndef SIM_POSE_ROOM_UPDATE_H
#define SIM_POSE_ROOM_UPDATE_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/room.h"
#include "firmware/update_status.h"
#include "sim/pose/board_talk.h"

enum {
    ROOM_UPDATE_LEAST_AHEAD_US = 5000000, /**< promises and confirmations take so long when frames are lost */
    ROOM_UPDATE_PROMISED_US = 2000000,    /**< before the moment all must have promised, */
    ROOM_UPDATE_CONFIRMED_US = 700000,    /**< and all must have heard that it holds */
    ROOM_UPDATE_QUIET_US = 400000,        /**< a board that is silent for so long is asked again */
    ROOM_UPDATE_TALK_US = 1300000,        /**< all tries of one request take at most so long */
    ROOM_UPDATE_LOOKS_AGAIN = 2,          /**< for boards that are silent, before anything is begun */
    ROOM_UPDATE_ROUND_US = 1000000,       /**< between looks at the boards */
    ROOM_UPDATE_PATIENCE = 5,             /**< looks in a row at which an installing board may be silent */
    ROOM_UPDATE_INSTALL_US = 1800000000,  /**< an install that takes longer has failed */
    ROOM_UPDATE_START_US = 300000000,     /**< so has a version that is not good by then */
    ROOM_UPDATE_AFTER_US = 60000000       /**< a board that may have switched all the same is looked for so long */
};

typedef enum { ROOM_UPDATE_STATUS, ROOM_UPDATE_INSTALL, ROOM_UPDATE_SWITCH, ROOM_UPDATE_CANCEL } room_update_task_t;

typedef struct {
    room_update_task_t task;
    const char *source;  /**< of an install */
    const char *version; /**< to switch to; NULL: the one that waits on all boards */
    int64_t ahead_us; /**< the switch is to be in so long; ROOM_UPDATE_LEAST_AHEAD_US to UPDATE_MOST_AHEAD_US - 1 s */
    can_auth_t *auth; /**< of the room's key; NULL: it has none */
} room_update_settings_t;

/** What came of it. */
typedef enum {
    ROOM_UPDATE_WORKING,
    ROOM_UPDATE_DONE,    /**< status: all answer; install: all are ready; switch: all run the version, and it is good */
    ROOM_UPDATE_REFUSED, /**< a board is missing or cannot do it: nothing was begun */
    ROOM_UPDATE_FAILED,  /**< an install failed on a board; what runs is untouched everywhere */
    ROOM_UPDATE_CANCELLED, /**< a board refused the switch or was silent: none has switched */
    ROOM_UPDATE_MIXED      /**< boards run different versions, or one has not been heard since the switch */
} room_update_result_t;

/** Why a board is in the way. */
typedef enum {
    ROOM_BOARD_WELL,
    ROOM_BOARD_SILENT, /**< no answer */
    ROOM_BOARD_KEY,    /**< it has no key, or another one */
    ROOM_BOARD_OLD,    /**< its firmware does not know updates, or knows them in another way */
    ROOM_BOARD_NO_AGENT,
    ROOM_BOARD_REFUSES, /**< see refusal */
    ROOM_BOARD_FAILED,  /**< its agent has: see status.message */
    ROOM_BOARD_OTHER,   /**< it has not the version that is wanted, or another than the others */
    ROOM_BOARD_TIME,    /**< it does not know bus time */
    ROOM_BOARD_BACK,    /**< it has switched, and is back in its former slot */
    ROOM_BOARD_TRIAL    /**< it has not marked its version good */
} room_board_trouble_t;

typedef struct {
    const char *name;
    uint8_t node;
    bool known;             /**< it has said how it is: */
    update_status_t status; /**< the newest */
    int64_t bus_us;         /**< its bus time less the caller's clock, then; up to half a second too little */
    room_board_trouble_t trouble;
    uint8_t refusal; /**< an update_refusal_t, or a newer one */
    int missed;      /**< looks in a row at which it did not do as expected */
    bool switches;   /**< it has to switch; others run the version already */
    bool told;       /**< that the moment holds; maybe it has heard it */
    bool asked;      /**< by the newest request */
    bool answered;   /**< it has answered the newest request to it */
} room_update_board_t;

typedef enum {
    ROOM_UPDATE_LOOK,
    ROOM_UPDATE_BEGIN_INSTALL,
    ROOM_UPDATE_WAIT_INSTALL,
    ROOM_UPDATE_PROMISE,
    ROOM_UPDATE_CONFIRM,
    ROOM_UPDATE_UNDO,
    ROOM_UPDATE_LOOK_AFTER, /**< after what was cancelled */
    ROOM_UPDATE_WATCH       /**< the boards start */
} room_update_step_t;

typedef struct {
    room_update_settings_t settings;
    room_update_result_t result;
    int boards;
    room_update_board_t board[ROOM_MAX_BOARDS];
    char version[HAL_UPDATE_VERSION_LENGTH]; /**< that is installed or switched to; "" as long as it is not known */
    uint64_t switch_bus_us;                  /**< the moment; 0: none yet */
    int64_t switch_us;                       /**< on the caller's clock, up to half a second late */

    room_update_step_t step;
    int64_t begun_us; /**< of an install */

    bool talking; /**< the module's own from here on */
    int64_t next_us;
    int again; /**< times that the silent ones were looked for again */
    int talks;
    board_talk_t talk[ROOM_MAX_BOARDS];
    int of_board[ROOM_MAX_BOARDS];
} room_update_t;

/** Begin. @param room  Its boards take part, all of them; must outlive the update. */
void room_update_init(room_update_t *update, const room_update_settings_t *settings, const room_t *room,
                      int64_t now_us);

/** Hear a frame from the bus. @param now_us  Of any steady clock, as in all these calls. */
void room_update_hear(room_update_t *update, const hal_can_frame_t *frame, int64_t now_us);

/** Go on. Call it every millisecond or so until result is not ROOM_UPDATE_WORKING; then frames are not needed more. */
void room_update_step(room_update_t *update, int64_t now_us);

/** @return Is there a frame to be sent now? Call it until there is none, after each step. */
bool room_update_next(room_update_t *update, hal_can_frame_t *frame, int64_t now_us);

/** Give up, as when the operator wants no more: a switch that is under way is cancelled on all boards first, as far as
 *  its moment is not over. Go on stepping. */
void room_update_stop(room_update_t *update, int64_t now_us);

#endif
