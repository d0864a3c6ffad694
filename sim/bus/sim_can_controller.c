// SPDX-License-Identifier: Apache-2.0
// The simulated CAN controller: its queues, its error counters, and the calls of hal_can.h.
#include <stddef.h>

#include "hal/hal_can.h"
#include "sim/bus/sim_bus_internal.h"
#include "sim/bus/sim_can_bits.h"

static bool goes_first(const hal_can_t *can, const sim_can_pending_t *a, const sim_can_pending_t *b)
{
    if (can->keep_order || a->key == b->key)
        return a->sequence < b->sequence;
    return a->key < b->key;
}

/* The place must be there. */
static void insert(hal_can_t *can, const sim_can_pending_t *pending)
{
    int at = can->transmit_count++;
    for (; at > 0 && goes_first(can, pending, &can->transmit[at - 1]); at--)
        can->transmit[at] = can->transmit[at - 1];
    can->transmit[at] = *pending;
}

sim_can_pending_t sim_can_take_first(hal_can_t *can)
{
    const sim_can_pending_t first = can->transmit[0];
    can->transmit_count--;
    for (int i = 0; i < can->transmit_count; i++)
        can->transmit[i] = can->transmit[i + 1];
    can->in_flight = true;
    return first;
}

static bool is_error_passive(const hal_can_t *can)
{
    return can->stats.tec >= SIM_CAN_PASSIVE_LIMIT || can->stats.rec >= SIM_CAN_PASSIVE_LIMIT;
}

static void suspend_if_passive(hal_can_t *can)
{
    if (is_error_passive(can))
        can->resume_ns = can->bus->free_ns + sim_bus_bits_ns(can->bus, SIM_CAN_SUSPEND_BITS);
}

bool sim_can_is_on_bus(const hal_can_t *can)
{
    return can->plugged && !can->bus_off;
}

void sim_can_settle(hal_can_t *can)
{
    const int64_t now_ns = can->bus->now_ns;
    if (can->recovered_ns != 0 && now_ns >= can->recovered_ns) {
        can->bus_off = false;
        can->recovered_ns = 0;
        can->stats.tec = can->stats.rec = 0;
    }
    const bool unanswered = !can->plugged && !can->bus_off && can->transmit_count > 0;
    if (!unanswered)
        can->unanswered_ns = 0;
    else if (can->unanswered_ns == 0)
        can->unanswered_ns = now_ns;
    else if (now_ns - can->unanswered_ns >= sim_bus_bits_ns(can->bus, SIM_CAN_UNANSWERED_BITS) &&
             can->stats.tec < SIM_CAN_PASSIVE_LIMIT)
        can->stats.tec = SIM_CAN_PASSIVE_LIMIT;
}

void sim_can_was_sent(hal_can_t *can)
{
    can->in_flight = false;
    can->stats.sent++;
    suspend_if_passive(can);
    if (can->stats.tec > 0)
        can->stats.tec--;
}

void sim_can_was_destroyed(hal_can_t *can, const sim_can_pending_t *pending)
{
    can->in_flight = false;
    if (can->bus_off) {
        can->stats.discarded++;
        return;
    }
    can->stats.transmit_errors++;
    can->stats.tec += 8;
    suspend_if_passive(can);
    insert(can, pending);
    if (can->stats.tec >= SIM_CAN_BUS_OFF_LIMIT)
        sim_can_go_bus_off(can);
}

void sim_can_go_bus_off(hal_can_t *can)
{
    if (!can->bus_off)
        can->stats.bus_offs++;
    can->bus_off = true;
    can->recovered_ns = 0;
    can->stats.tec = SIM_CAN_BUS_OFF_LIMIT;
    can->stats.discarded += can->transmit_count;
    can->transmit_count = 0;
}

void sim_can_hear(hal_can_t *can, const hal_can_frame_t *frame)
{
    if (can->stats.rec >= SIM_CAN_PASSIVE_LIMIT)
        can->stats.rec = SIM_CAN_PASSIVE_LIMIT - 1;
    else if (can->stats.rec > 0)
        can->stats.rec--;
    sim_can_deliver(can, frame);
}

void sim_can_hear_error(hal_can_t *can)
{
    if (can->stats.rec < SIM_CAN_PASSIVE_LIMIT)
        can->stats.rec++;
}

void sim_can_deliver(hal_can_t *can, const hal_can_frame_t *frame)
{
    if (can->receive_count == SIM_CAN_RECEIVE_FRAMES) {
        can->stats.overruns++;
        return;
    }
    const uint64_t jitter_us = can->jitter_us == 0 ? 0 : rng_next(&can->random) % (can->jitter_us + UINT64_C(1));
    const int64_t due_ns = can->bus->now_ns + can->delay_ns + (int64_t)jitter_us * 1000;
    if (can->receive_count == 0 || due_ns > can->last_due_ns)
        can->last_due_ns = due_ns;
    sim_can_heard_t *heard = &can->receive[(can->receive_first + can->receive_count) % SIM_CAN_RECEIVE_FRAMES];
    heard->due_ns = can->last_due_ns;
    heard->frame = *frame;
    const int64_t time_us = can->last_due_ns / 1000;
    heard->frame.time_us = can->stamp == NULL ? time_us : can->stamp(can->stamp_context, time_us);
    can->receive_count++;
    can->stats.received++;
}

void sim_can_set_stamps(hal_can_t *can, sim_can_stamp_fn *stamp, void *context, uint32_t jitter_us)
{
    can->stamp = stamp;
    can->stamp_context = context;
    can->jitter_us = jitter_us;
}

void sim_can_keep_order(hal_can_t *can)
{
    can->keep_order = true;
}

sim_can_stats_t sim_can_stats(const hal_can_t *can)
{
    sim_can_stats_t stats = can->stats;
    stats.pending = can->transmit_count + can->in_flight;
    return stats;
}

hal_status_t hal_can_receive(hal_can_t *can, hal_can_frame_t *frame)
{
    if (can->stuck)
        return HAL_IO;
    const sim_can_heard_t *oldest = &can->receive[can->receive_first];
    if (can->receive_count == 0 || oldest->due_ns > can->bus->now_ns)
        return HAL_EMPTY;
    *frame = oldest->frame;
    can->receive_first = (can->receive_first + 1) % SIM_CAN_RECEIVE_FRAMES;
    can->receive_count--;
    return HAL_OK;
}

hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame)
{
    if (!sim_bus_carries(can->bus, frame))
        return HAL_BAD_CALL;
    if (can->stuck || can->bus_off)
        return HAL_IO;
    if (can->transmit_count + can->in_flight >= SIM_CAN_TRANSMIT_FRAMES)
        return HAL_FULL;
    const sim_can_pending_t pending = sim_bus_pending(can->bus, frame);
    insert(can, &pending);
    return HAL_OK;
}

uint32_t hal_can_lost(const hal_can_t *can)
{
    return (uint32_t)can->stats.overruns;
}

hal_can_state_t hal_can_state(const hal_can_t *can)
{
    if (can->bus_off)
        return HAL_CAN_BUS_OFF;
    return is_error_passive(can) ? HAL_CAN_ERROR_PASSIVE : HAL_CAN_ERROR_ACTIVE;
}

hal_status_t hal_can_restart(hal_can_t *can)
{
    if (can->stuck)
        return HAL_IO;
    if (can->bus_off && can->recovered_ns == 0)
        can->recovered_ns = can->bus->now_ns + sim_bus_bits_ns(can->bus, SIM_CAN_RECOVERY_BITS);
    return HAL_OK;
}
