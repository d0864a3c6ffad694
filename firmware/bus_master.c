// SPDX-License-Identifier: Apache-2.0
// Who gives bus time: hearing pairs, changing masters, being one.
#include "firmware/bus_master.h"

#include "firmware/can_e2e.h"

enum { FOLLOWED, ANOTHER, COUNTED_US = 1000000, FIRST_TIME_US = 1000000 };

static const int64_t LAST_TIME_US = (INT64_C(1) << 47) - 1;

void bus_master_init(bus_master_t *master, uint8_t number, int64_t now_us)
{
    *master = (bus_master_t){.number = number, .master = number, .heard_us = now_us};
}

static bool is_better(const bus_master_t *m, uint8_t number)
{
    if (m->own)
        return number < m->number;
    return !m->following || number < m->master;
}

/* @return Is it news? Counts what was skipped. */
static bool count_sync(bus_master_t *m, uint8_t counter, int64_t local_us)
{
    uint32_t lost = 0;
    if (local_us - m->counted_us <= COUNTED_US) {
        const can_e2e_step_t step = can_e2e_step(m->counted, counter, CAN_E2E_P01_COUNTERS, &lost);
        if (step == CAN_E2E_DUPLICATE || step == CAN_E2E_STALE)
            return false;
    }
    m->lost += lost + m->pending[FOLLOWED].any;
    m->counted = counter;
    m->counted_us = local_us;
    return true;
}

static void hear_sync(bus_master_t *m, const can_sync_t *sync, int64_t local_us)
{
    if (sync->number == m->number) /* a room has each number once */
        return;
    if (local_us > m->heard_us)
        m->heard_us = local_us;
    if (m->claiming && sync->number < m->number)
        m->claiming = false;
    const bool followed = m->following && sync->number == m->master;
    if (followed && !count_sync(m, sync->counter, local_us))
        return;
    m->pending[followed ? FOLLOWED : ANOTHER] = (bus_sync_t){
        .any = true, .number = sync->number, .counter = sync->counter, .origin = sync->origin, .local_us = local_us};
}

static void set_master(bus_master_t *m, uint8_t number)
{
    m->changes += m->any && number != m->master;
    m->any = true;
    m->master = number;
}

static void follow(bus_master_t *m, const bus_sync_t *sync)
{
    set_master(m, sync->number);
    m->own = m->claiming = m->on_its_way = m->sent_any = false;
    m->following = true;
    m->pending[FOLLOWED].any = false;
    m->counted = sync->counter;
    m->counted_us = sync->local_us;
}

static void hear_follow_up(bus_master_t *m, const can_follow_up_t *follow_up, int64_t local_us)
{
    const int which = m->following && follow_up->number == m->master ? FOLLOWED : ANOTHER;
    bus_sync_t *sync = &m->pending[which];
    if (follow_up->number == m->number)
        return;
    if (!sync->any || sync->number != follow_up->number || sync->counter != follow_up->counter ||
        local_us < sync->local_us || local_us - sync->local_us > BUS_MASTER_PAIR_US) {
        m->mismatched++;
        return;
    }
    sync->any = false;
    if (which == ANOTHER) {
        const bool silent = !m->own && local_us - m->paired_us > BUS_MASTER_SILENT_US;
        if (!silent && !is_better(m, sync->number))
            return;
        follow(m, sync);
    }
    m->paired_us = local_us;
    m->origin = sync->origin;
    bus_time_pair(&m->time, sync->local_us, (int64_t)follow_up->time_us);
}

static void hear_own(bus_master_t *m, const can_sync_t *sync, int64_t local_us)
{
    if (!(m->own || m->claiming) || !m->on_its_way || sync->counter != m->sent.counter)
        return;
    if (!m->claimed)
        m->claimed_us = local_us;
    m->claimed = true;
    m->on_its_way = false;
    m->sent_any = true;
    m->sent.local_us = m->sent_us = local_us;
}

can_check_t bus_master_hear(bus_master_t *master, const hal_can_frame_t *frame)
{
    can_sync_t sync;
    can_follow_up_t follow_up;
    can_check_t check = can_sync_decode(&sync, frame);
    if (check == CAN_CHECK_OK && frame->own)
        hear_own(master, &sync, frame->time_us);
    else if (check == CAN_CHECK_OK)
        hear_sync(master, &sync, frame->time_us);
    if (check != CAN_CHECK_OTHER)
        return check;
    check = can_follow_up_decode(&follow_up, frame);
    if (check == CAN_CHECK_OK && !frame->own)
        hear_follow_up(master, &follow_up, frame->time_us);
    return check;
}

/* Can bus time be this? It must fit its message, for years. */
static bool fits(int64_t time_us)
{
    return time_us >= 0 && time_us <= LAST_TIME_US;
}

static void claim(bus_master_t *m, int64_t now_us)
{
    m->claiming = true;
    m->claimed = m->on_its_way = m->sent_any = false;
    m->due_us = m->sent_us = now_us;
}

static void take_over(bus_master_t *m, int64_t now_us)
{
    if (!m->time.known || !fits(bus_time_from_local(&m->time, now_us))) {
        bus_time_begin(&m->time, now_us, fits(now_us) ? now_us : FIRST_TIME_US);
        m->origin = m->number;
    }
    set_master(m, m->number);
    m->own = true;
    m->following = m->claiming = false;
}

static void send(bus_master_t *m, hal_can_t *can, bool encoded, hal_can_frame_t *frame)
{
    if (!encoded || hal_can_send(can, frame) != HAL_OK)
        m->unsent++;
}

static void send_sync(bus_master_t *m, hal_can_t *can, int64_t now_us)
{
    const can_sync_t sync = {.number = m->number, .counter = m->counter, .origin = m->origin};
    hal_can_frame_t frame;
    m->due_us += CAN_SYNC_PERIOD_MS * 1000;
    if (m->due_us <= now_us)
        m->due_us = now_us + CAN_SYNC_PERIOD_MS * 1000;
    m->sent = (bus_sync_t){.counter = m->counter, .origin = m->origin};
    m->counter = (uint8_t)((m->counter + 1) % CAN_E2E_P01_COUNTERS);
    const bool encoded = can_sync_encode(&frame, &sync);
    frame.own = true;
    const uint32_t unsent = m->unsent;
    send(m, can, encoded, &frame);
    m->on_its_way = m->unsent == unsent;
}

static void send_follow_up(bus_master_t *m, hal_can_t *can)
{
    const can_follow_up_t follow_up = {.number = m->number,
                                       .counter = m->sent.counter,
                                       .time_us = (uint64_t)bus_time_from_local(&m->time, m->sent.local_us)};
    const can_sync_t sync = {.number = m->number, .counter = m->sent.counter, .origin = m->sent.origin};
    const bool encoded = can_sync_encode(&m->pair[0], &sync) && can_follow_up_encode(&m->pair[1], &follow_up);
    const uint32_t unsent = m->unsent;
    m->sent_any = false;
    send(m, can, encoded, &m->pair[1]);
    m->paired = m->unsent == unsent;
}

static void give_up(bus_master_t *m, int64_t now_us)
{
    m->own = m->claiming = m->on_its_way = m->sent_any = false;
    m->heard_us = now_us;
}

void bus_master_step(bus_master_t *m, hal_can_t *can, int64_t now_us)
{
    const bool tracker = m->number == BUS_MASTER_TRACKER;
    const int64_t wait_us = tracker ? 0 : BUS_MASTER_SILENT_US + m->number * BUS_MASTER_STEP_US;
    m->paired = false;
    if (m->own)
        bus_time_keep(&m->time, now_us);
    if ((m->own || m->claiming) && now_us - m->sent_us > BUS_MASTER_SILENT_US)
        give_up(m, now_us);
    if (!m->own && !m->claiming && now_us - m->heard_us >= wait_us)
        claim(m, now_us);
    if (m->claiming && m->claimed && now_us - m->claimed_us >= (tracker ? 0 : BUS_MASTER_CLAIM_US))
        take_over(m, now_us);
    if (!m->own && !m->claiming)
        return;
    if (m->own && m->sent_any)
        send_follow_up(m, can);
    if (now_us >= m->due_us && !m->on_its_way)
        send_sync(m, can, now_us);
}

can_time_state_t bus_master_state(const bus_master_t *m, int64_t now_us)
{
    if (m->own)
        return CAN_TIME_OWN;
    if (!m->time.locked)
        return CAN_TIME_NONE;
    return now_us - m->time.paired_us > BUS_TIME_SILENT_US ? CAN_TIME_HOLDOVER : CAN_TIME_LOCKED;
}

uint32_t bus_master_error_us(const bus_master_t *m, int64_t now_us)
{
    return m->own ? 0 : bus_time_error_us(&m->time, now_us);
}

bool bus_master_knows(const bus_master_t *m, int64_t now_us)
{
    return m->time.known && bus_master_error_us(m, now_us) <= BUS_TIME_STEP_US;
}
