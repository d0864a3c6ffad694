// SPDX-License-Identifier: Apache-2.0
// Writes what a board does into its log: the events of event_log.h, when they happen.
#ifndef FIRMWARE_EVENT_WATCH_H
#define FIRMWARE_EVENT_WATCH_H

#include <stdint.h>

#include "firmware/can_update.h"
#include "firmware/can_protocol.h"
#include "firmware/command.h"
#include "firmware/event_log.h"

typedef struct projector projector_t;

/** The log, and what was logged last. No pointers inside. */
typedef struct {
    event_log_t log;
    can_board_state_t state;
    can_time_state_t time;
    uint32_t fault_flags;
    int32_t step;
    can_update_state_t update;
} event_watch_t;

/** An empty log but for the start. */
void event_watch_init(event_watch_t *watch, int32_t node);

/** Log what has changed. Call it at the end of every step. */
void event_watch_step(projector_t *projector, int64_t now_us);

/**
 * Log a request, but not one that only asks (hello, log, nonce, how an update stands) and is answered.
 *
 * @param command  Its kind may be unknown.
 */
void event_watch_command(projector_t *projector, const command_t *command, command_result_t result, int64_t now_us);

#endif
