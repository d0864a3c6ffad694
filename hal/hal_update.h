// SPDX-License-Identifier: Apache-2.0
// Contract of the update agent: who installs a new version beside the running one, and starts the board in it.
//
// A board has two slots, A and B. It runs from one; an install writes a version into the other; a switch starts the
// board in that one, on trial. A version on trial is marked good by the firmware; one that is not, because it does not
// start, crashes or hangs, is left again by itself, and the board is back in the slot it came from.
//
// The agent takes one request after the other. Nothing here blocks, allocates, or takes more time than reading a few
// hundred bytes of memory. A board without an agent has NULL for a handle, or none answers: every call says HAL_EMPTY.
#ifndef HAL_HAL_UPDATE_H
#define HAL_HAL_UPDATE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_status.h"

typedef struct hal_update hal_update_t;

/** Room for texts, with the zero at their end. All are printable ASCII. */
enum { HAL_UPDATE_SOURCE_LENGTH = 201, HAL_UPDATE_VERSION_LENGTH = 33, HAL_UPDATE_MESSAGE_LENGTH = 129 };

typedef enum {
    HAL_UPDATE_IDLE,       /**< nothing waits */
    HAL_UPDATE_INSTALLING, /**< see progress */
    HAL_UPDATE_READY,      /**< a version waits in the other slot for the switch */
    HAL_UPDATE_FAILED,     /**< the last request came to nothing: see message; what runs is untouched */
    HAL_UPDATE_SWITCHING,  /**< the board is about to start anew */
    HAL_UPDATE_DOINGS
} hal_update_doing_t;

/** What the agent says. */
typedef struct {
    hal_update_doing_t doing;
    int32_t progress; /**< of the install, 0 to 100 % */
    char slot;        /**< that the board runs from: 'A', 'B', or '?' when the agent does not say */
    bool trial;       /**< the running version is not marked good yet */
    char running[HAL_UPDATE_VERSION_LENGTH]; /**< version, "" when the agent does not say; as the others: */
    char waiting[HAL_UPDATE_VERSION_LENGTH]; /**< installed, and waiting for the switch */
    char other[HAL_UPDATE_VERSION_LENGTH]; /**< in the other slot, fit to be switched to: what waits, or after a switch
                                                what ran before */
    char message[HAL_UPDATE_MESSAGE_LENGTH]; /**< for people: why it has failed */
} hal_update_state_t;

/**
 * @param[out] state  Written only when HAL_OK is returned.
 * @return HAL_OK;
 *         HAL_EMPTY  there is no update agent;
 *         HAL_FULL   a request is still waiting: what the agent said before it is out of date; ask again later;
 *         HAL_IO     what it says can't be read, or makes no sense.
 */
MUST_CHECK hal_status_t hal_update_state(hal_update_t *update, hal_update_state_t *state);

/** @return Is this text a source? "usb", an absolute path, or a URL that begins with http:// or https://; at most
 *          HAL_UPDATE_SOURCE_LENGTH - 1 of the characters '!' to '~'. */
bool hal_update_is_source(const char *source);

/** @return Is this text a version? 1 to HAL_UPDATE_VERSION_LENGTH - 1 of the characters '!' to '~'. */
bool hal_update_is_version(const char *version);

/**
 * Ask for an install into the other slot, whatever is there. The agent checks the bundle's signature and board.
 *
 * @return HAL_OK        asked; hal_update_state() tells the rest;
 *         HAL_EMPTY     there is no update agent;
 *         HAL_FULL      an earlier request is still waiting, nothing was asked;
 *         HAL_BAD_CALL  hal_update_is_source() says no;
 *         HAL_IO        the agent can't be told.
 */
MUST_CHECK hal_status_t hal_update_install(hal_update_t *update, const char *source);

/** Ask for a start in the other slot, at once. @return As hal_update_install(). */
MUST_CHECK hal_status_t hal_update_switch(hal_update_t *update);

/** Mark the running version good. @return As hal_update_install(). */
MUST_CHECK hal_status_t hal_update_good(hal_update_t *update);

#endif
