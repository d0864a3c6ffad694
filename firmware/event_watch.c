// SPDX-License-Identifier: Apache-2.0
// Writes what a board does into its log.
#include "firmware/event_watch.h"

#include "firmware/projector.h"

enum { US_PER_MS = 1000 };

void event_watch_init(event_watch_t *watch, int32_t node)
{
    *watch = (event_watch_t){.state = CAN_BOARD_WAITING};
    event_log_add(&watch->log, (event_t){.kind = EVENT_START, .value = node});
}

static void add(projector_t *p, event_kind_t kind, int32_t value, int64_t now_us)
{
    const int64_t time_ms = (now_us - p->telemetry.start_us) / US_PER_MS;
    event_log_add(&p->events.log, (event_t){.time_ms = (uint32_t)time_ms, .kind = kind, .value = value});
}

void event_watch_step(projector_t *p, int64_t now_us)
{
    event_watch_t *w = &p->events;
    const can_time_state_t time = bus_master_state(&p->time, now_us);
    const can_update_state_t update = can_update_state_of(&p->update);
    if (w->state != p->report.state)
        add(p, EVENT_STATE, (int32_t)p->report.state, now_us);
    if (w->fault_flags != p->telemetry.fault_flags)
        add(p, EVENT_FAULTS, (int32_t)p->telemetry.fault_flags, now_us);
    if (w->step != p->degrade.step)
        add(p, EVENT_METHOD, p->degrade.step, now_us);
    if (w->time != time)
        add(p, EVENT_BUS_TIME, (int32_t)time, now_us);
    if (w->update != update)
        add(p, EVENT_UPDATE, (int32_t)update, now_us);
    w->state = p->report.state;
    w->fault_flags = p->telemetry.fault_flags;
    w->step = p->degrade.step;
    w->time = time;
    w->update = update;
}

void event_watch_command(projector_t *p, const command_t *command, command_result_t result, int64_t now_us)
{
    const bool asks = command->kind == COMMAND_HELLO || command->kind == COMMAND_LOG ||
                      command->kind == COMMAND_NONCE ||
                      (command->kind == COMMAND_UPDATE && command->update == COMMAND_UPDATE_STATUS);
    const bool read = result == COMMAND_OK || result == COMMAND_IMPOSSIBLE;
    const int32_t argument = read ? command_argument(command) : 0;
    if (!asks || result != COMMAND_OK)
        add(p, EVENT_COMMAND, (int32_t)command->kind + EVENT_RESULT * (int32_t)result + EVENT_ARGUMENT * argument,
            now_us);
}
