// SPDX-License-Identifier: Apache-2.0
// A ring of events, and how they travel.
#include "firmware/event_log.h"

#include "firmware/byte_order.h"

void event_log_add(event_log_t *log, event_t event)
{
    log->entry[log->count++ % EVENT_LOG_ENTRIES] = event;
}

int event_log_pack(const event_log_t *log, uint8_t *bytes, uint32_t *first, int most)
{
    const uint32_t oldest = log->count > EVENT_LOG_ENTRIES ? log->count - EVENT_LOG_ENTRIES : 0;
    if (*first < oldest)
        *first = oldest;
    int packed = 0;
    for (uint32_t i = *first; i < log->count && packed < most; i++, packed++) {
        const event_t *event = &log->entry[i % EVENT_LOG_ENTRIES];
        uint8_t *to = bytes + EVENT_BYTES * packed;
        put_u32(to, event->time_ms);
        to[4] = (uint8_t)event->kind;
        put_u32(to + 5, (uint32_t)event->value);
    }
    return packed;
}

bool event_unpack(event_t *event, const uint8_t bytes[EVENT_BYTES])
{
    *event = (event_t){
        .time_ms = get_u32(bytes),
        .kind = bytes[4] < EVENT_KINDS ? (event_kind_t)bytes[4] : EVENT_KINDS,
        .value = (int32_t)get_u32(bytes + 5),
    };
    return event->kind != EVENT_KINDS;
}
