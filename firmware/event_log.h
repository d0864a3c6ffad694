// SPDX-License-Identifier: Apache-2.0
// What happened on a board, newest last: a ring that is read over the bus.
#ifndef FIRMWARE_EVENT_LOG_H
#define FIRMWARE_EVENT_LOG_H

#include <stdbool.h>
#include <stdint.h>

enum {
    EVENT_LOG_ENTRIES = 256,
    EVENT_BYTES = 9, /**< of an entry as it travels */
    EVENT_RESULT = 256,
    EVENT_ARGUMENT = 65536
};

/** Numbers are never reused for something else. */
typedef enum {
    EVENT_START = 0,    /**< value: node */
    EVENT_STATE = 1,    /**< value: can_board_state_t that it is in now */
    EVENT_FAULTS = 2,   /**< value: can_fault_flag_t of the last half second, when they are others than before */
    EVENT_METHOD = 3,   /**< value: steps below the room's method, or below the one that an operator wants */
    EVENT_COMMAND = 4,  /**< value: command_kind_t, plus EVENT_RESULT times command_result_t, plus EVENT_ARGUMENT
                             times the request's command_argument() */
    EVENT_BUS_TIME = 5, /**< value: state of the bus time */
    EVENT_UPDATE = 6,   /**< value: can_update_state_t that it is in now */
    EVENT_KINDS
} event_kind_t;

typedef struct {
    uint32_t time_ms; /**< since the board's start; wraps after 49 days */
    event_kind_t kind;
    int32_t value;
} event_t;

/** All zero bytes is an empty log. No pointers inside. */
typedef struct {
    uint32_t count; /**< events since the start; the oldest that is kept is count - EVENT_LOG_ENTRIES */
    event_t entry[EVENT_LOG_ENTRIES];
} event_log_t;

/** Add one; when the log is full, the oldest goes. */
void event_log_add(event_log_t *log, event_t event);

/**
 * Pack events for the bus.
 *
 * @param[out]    bytes  EVENT_BYTES each: time (4), kind (1), value (4), all low byte first.
 * @param[in,out] first  Which event to begin with, counted from 0 at start; the oldest kept when that one is gone.
 * @param         most   Entries that there is room for.
 * @return Entries packed.
 */
int event_log_pack(const event_log_t *log, uint8_t *bytes, uint32_t *first, int most);

/** The inverse, for one entry. @return false when its kind is unknown: event.kind is then EVENT_KINDS. */
bool event_unpack(event_t *event, const uint8_t bytes[EVENT_BYTES]);

#endif
