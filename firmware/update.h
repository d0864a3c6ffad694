// SPDX-License-Identifier: Apache-2.0
// A board's update: installs and switches that an operator asks for over the bus, and the mark that the running version
// is good.
//
// A room switches as one. Its operator has every board install, and when each has the same version waiting, has each
// promise (`switch`) to start in it at one moment of bus time; only when all have promised does he confirm that moment
// to each. A promise that is not confirmed by its moment is dropped, so as long as one board is missing none switches.
// The moment is turned into the board's own time when the promise is given: what becomes of bus time after that is of
// no account. Boards begin at their first refresh after the moment: within a refresh and 2 ms of each other. One that
// gets to it UPDATE_LATE_US late leaves it be.
//
// A version on trial is told to be good after UPDATE_GOOD_FRAMES healthy frames, once. A frame is healthy when a
// picture of any kind (corrected, safe, pattern) was on its way to the panel before the vertical blank that it was made
// for. A late one, or a wall that an operator froze, counts for nothing. The count begins anew with every frame in
// which a device of the board fails: the state is fault, as with a display that refuses; camera, lines or watchdog are
// counted up in projector_faults_t; or the bus controller is off. A bus without traffic is no fault: the cable may be
// out.
//
// The agent's state is read once a second, outside the stages of a frame. No heap, no waiting, no pointers inside.
#ifndef FIRMWARE_UPDATE_H
#define FIRMWARE_UPDATE_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/command.h"
#include "hal/hal_update.h"

typedef struct projector projector_t;

enum {
    UPDATE_GOOD_FRAMES = 600, /**< 10 s at 60 Hz */
    UPDATE_READ_US = 1000000,
    UPDATE_TOLD_US = 2000000,        /**< so long after a request what it leads to is taken for the agent's state */
    UPDATE_MOST_AHEAD_US = 60000000, /**< of a switch: in so long no crystal runs away by more than a refresh */
    UPDATE_LATE_US = 250000
};

/** Why a request was not done: behind COMMAND_IMPOSSIBLE. Numbers are never reused for something else. */
typedef enum {
    UPDATE_DONE = 0,
    UPDATE_NO_AGENT = 1,  /**< the board has no update agent */
    UPDATE_BUSY = 2,      /**< an install or a switch is under way; or one is promised, and has to be cancelled first */
    UPDATE_NOT_THERE = 3, /**< the version is not the one in the other slot */
    UPDATE_ON_TRIAL = 4,  /**< the running version is not good yet, and an install would overwrite the good one */
    UPDATE_NO_TIME = 5,   /**< the board does not know bus time within 1 ms */
    UPDATE_BAD_TIME = 6,  /**< the moment is over, or more than UPDATE_MOST_AHEAD_US ahead */
    UPDATE_NO_PROMISE = 7, /**< nothing was promised for that moment */
    UPDATE_NOT_TOLD = 8    /**< the agent could not be told */
} update_refusal_t;

/** A switch at a moment to come. */
typedef enum { UPDATE_NO_PLAN = 0, UPDATE_PROMISED = 1, UPDATE_CONFIRMED = 2, UPDATE_PLANS } update_plan_t;

typedef struct {
    bool agent;              /**< there is one; */
    hal_update_state_t said; /**< its state, or what a request will make of it */
    update_plan_t plan;      /**< the rest of the plan means something unless there is none: */
    uint64_t switch_bus_us;  /**< its moment in bus time, */
    int64_t switch_us;       /**< and on the board's clock */
    char version[HAL_UPDATE_VERSION_LENGTH];
    char source[HAL_UPDATE_SOURCE_LENGTH]; /**< of the newest install */
    int32_t healthy;                       /**< frames, up to UPDATE_GOOD_FRAMES */
    bool told_good;
    int64_t read_due_us;
    uint32_t seen_faults;
} update_t;

/** Begin; the agent is looked at in the first step. */
void update_init(update_t *update, int64_t now_us);

/** Do what a COMMAND_UPDATE asks for. Doing it twice is the same as once. @return UPDATE_DONE, or why not. */
update_refusal_t update_execute(projector_t *projector, const command_t *command, int64_t now_us);

/** Judge the frame, switch when it is time, read the agent's state. Call it once a step, when all else is done. */
void update_step(projector_t *projector, int64_t now_us);

#endif
