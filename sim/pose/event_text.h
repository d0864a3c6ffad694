// SPDX-License-Identifier: Apache-2.0
// What a board has logged, for people.
#ifndef SIM_POSE_EVENT_TEXT_H
#define SIM_POSE_EVENT_TEXT_H

#include <stdint.h>

#include "firmware/event_log.h"

enum { EVENT_TEXT_LENGTH = 320, FAULT_NAMES_LENGTH = 256 };

/** "     12.345 s  state     running": time since the board's start, what, and what it is now. */
void event_text(char text[EVENT_TEXT_LENGTH], const event_t *event);

/** "camera, deadline"; "" for no fault. @param flags  Of can_fault_flag_t. */
void event_fault_names(char names[FAULT_NAMES_LENGTH], uint32_t flags);

#endif
