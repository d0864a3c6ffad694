// SPDX-License-Identifier: Apache-2.0
// How a board's update stands, as bytes.
#include "firmware/update_status.h"

#include <string.h>

#include "firmware/byte_order.h"
#include "firmware/projector.h"

enum { NUMBERS_BYTES = 20, TRIAL = 1, KNOWS_TIME = 2, PLAN_SHIFT = 4, PLAN_MASK = 3, MOST_PERCENT = 100 };

_Static_assert(NUMBERS_BYTES + 3 * HAL_UPDATE_VERSION_LENGTH + HAL_UPDATE_MESSAGE_LENGTH <= (int)UPDATE_STATUS_BYTES,
               "each text takes as much as with its zero");

update_status_t update_status_of(const projector_t *p, int64_t now_us)
{
    const update_t *u = &p->update;
    update_status_t status = {
        .state = can_update_state_of(u),
        .progress = u->said.progress,
        .slot = u->agent ? u->said.slot : '?',
        .trial = u->said.trial,
        .knows_time = bus_master_knows(&p->time, now_us),
        .plan = u->plan,
        .bus_time_us = (uint64_t)bus_time_from_local(&p->time.time, now_us),
        .switch_bus_us = u->plan == UPDATE_NO_PLAN ? 0 : u->switch_bus_us,
    };
    memcpy(status.running, u->said.running, sizeof status.running);
    memcpy(status.waiting, u->said.waiting, sizeof status.waiting);
    memcpy(status.other, u->said.other, sizeof status.other);
    memcpy(status.message, u->said.message, sizeof status.message);
    return status;
}

static int put_text(uint8_t *bytes, const char *text)
{
    const size_t length = strlen(text);
    bytes[0] = (uint8_t)length;
    memcpy(bytes + 1, text, length);
    return 1 + (int)length;
}

int update_status_encode(uint8_t bytes[UPDATE_STATUS_BYTES], const update_status_t *status)
{
    int used = NUMBERS_BYTES;
    bytes[0] = (uint8_t)status->state;
    bytes[1] = (uint8_t)status->progress;
    bytes[2] = (uint8_t)status->slot;
    bytes[3] = (uint8_t)((status->trial ? TRIAL : 0) | (status->knows_time ? KNOWS_TIME : 0) |
                         (int)status->plan << PLAN_SHIFT);
    put_u64(bytes + 4, status->bus_time_us);
    put_u64(bytes + 12, status->switch_bus_us);
    used += put_text(bytes + used, status->running);
    used += put_text(bytes + used, status->waiting);
    used += put_text(bytes + used, status->other);
    return used + put_text(bytes + used, status->message);
}

/* What is left of the bytes. */
typedef struct {
    const uint8_t *bytes;
    int length;
} rest_t;

static bool take_text(rest_t *rest, char *text, int size)
{
    if (rest->length < 1 || rest->bytes[0] >= size || rest->bytes[0] >= rest->length)
        return false;
    const int length = rest->bytes[0];
    for (int i = 0; i < length; i++) {
        const uint8_t byte = rest->bytes[1 + i];
        text[i] = byte >= ' ' && byte <= '~' ? (char)byte : '?';
    }
    text[length] = '\0';
    *rest = (rest_t){rest->bytes + 1 + length, rest->length - 1 - length};
    return true;
}

bool update_status_decode(update_status_t *status, const uint8_t *bytes, int length)
{
    if (length < NUMBERS_BYTES || bytes[0] >= CAN_UPDATE_STATES || bytes[1] > MOST_PERCENT)
        return false;
    update_status_t read = {
        .state = (can_update_state_t)bytes[0],
        .progress = bytes[1],
        .slot = bytes[2] == 'A' || bytes[2] == 'B' ? (char)bytes[2] : '?',
        .trial = (bytes[3] & TRIAL) != 0,
        .knows_time = (bytes[3] & KNOWS_TIME) != 0,
        .plan = (update_plan_t)(bytes[3] >> PLAN_SHIFT & PLAN_MASK),
        .bus_time_us = get_u64(bytes + 4),
        .switch_bus_us = get_u64(bytes + 12),
    };
    rest_t rest = {bytes + NUMBERS_BYTES, length - NUMBERS_BYTES};
    const bool whole =
        take_text(&rest, read.running, sizeof read.running) && take_text(&rest, read.waiting, sizeof read.waiting) &&
        take_text(&rest, read.other, sizeof read.other) && take_text(&rest, read.message, sizeof read.message);
    if (!whole || read.plan >= UPDATE_PLANS)
        return false;
    *status = read;
    return true;
}
