// SPDX-License-Identifier: Apache-2.0
// What a board has logged, for people.
#include "sim/pose/event_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "firmware/can_protocol.h"
#include "firmware/can_update.h"
#include "sim/pose/request_text.h"

enum { MS_PER_S = 1000, FLAGS = 16 };

void event_fault_names(char names[FAULT_NAMES_LENGTH], uint32_t flags)
{
    static const char *const known[] = {"bus",      "bus-off",  "camera",  "display",    "GPIO",
                                        "watchdog", "deadline", "refused", "no session", "configuration"};
    names[0] = '\0';
    for (size_t bit = 0; bit < FLAGS; bit++) {
        const size_t used = strlen(names);
        if ((flags >> bit & 1U) != 0)
            snprintf(names + used, FAULT_NAMES_LENGTH - used, "%s%s", used > 0 ? ", " : "",
                     bit < sizeof known / sizeof known[0] ? known[bit] : "one of a newer firmware");
    }
}

static const char *time_state_name(int32_t state)
{
    static const char *const known[] = {"none", "gives it", "follows", "goes on without its master"};
    return state >= CAN_TIME_NONE && state <= CAN_TIME_HOLDOVER ? known[state] : "unknown";
}

static void command_text(char value[FAULT_NAMES_LENGTH], uint32_t packed)
{
    const uint8_t kind = (uint8_t)packed, result = (uint8_t)(packed / EVENT_RESULT);
    char argument[REQUEST_ARGUMENT_LENGTH];
    request_argument_text(argument, kind, (uint8_t)(packed / EVENT_ARGUMENT));
    snprintf(value, FAULT_NAMES_LENGTH, "%s%s: %s", request_name(kind),
             result == COMMAND_OK || result == COMMAND_IMPOSSIBLE ? argument : "", request_result_name(result));
}

static void value_text(char value[FAULT_NAMES_LENGTH], const event_t *event)
{
    switch (event->kind) {
    case EVENT_START:
        snprintf(value, FAULT_NAMES_LENGTH, "node %" PRId32, event->value);
        break;
    case EVENT_STATE:
        snprintf(value, FAULT_NAMES_LENGTH, "%s", can_board_state_name((can_board_state_t)event->value));
        break;
    case EVENT_FAULTS:
        event_fault_names(value, (uint32_t)event->value);
        if (value[0] == '\0')
            snprintf(value, FAULT_NAMES_LENGTH, "none");
        break;
    case EVENT_METHOD:
        snprintf(value, FAULT_NAMES_LENGTH, "step %" PRId32, event->value);
        break;
    case EVENT_COMMAND:
        command_text(value, (uint32_t)event->value);
        break;
    case EVENT_BUS_TIME:
        snprintf(value, FAULT_NAMES_LENGTH, "%s", time_state_name(event->value));
        break;
    case EVENT_UPDATE:
        snprintf(value, FAULT_NAMES_LENGTH, "%s", can_update_state_name((can_update_state_t)event->value));
        break;
    case EVENT_KINDS:
        snprintf(value, FAULT_NAMES_LENGTH, "%" PRId32 "; is the board's firmware newer?", event->value);
        break;
    }
}

void event_text(char text[EVENT_TEXT_LENGTH], const event_t *event)
{
    static const char *const kinds[] = {"start",   "state",    "faults", "method",
                                        "command", "bus time", "update", "unknown"};
    char value[FAULT_NAMES_LENGTH];
    value_text(value, event);
    snprintf(text, EVENT_TEXT_LENGTH, "%7" PRIu32 ".%03" PRIu32 " s  %-8s  %s", event->time_ms / MS_PER_S,
             event->time_ms % MS_PER_S, kinds[event->kind], value);
}
