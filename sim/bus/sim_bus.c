// SPDX-License-Identifier: Apache-2.0
// The wire: who starts when, how long it takes, who hears it, and how busy it has been.
#include "sim/bus/sim_bus.h"

#include <stdlib.h>

#include "sim/bus/sim_bus_internal.h"
#include "sim/bus/sim_can_bits.h"

static const int64_t window_ns = (int64_t)SIM_BUS_WINDOW_US * 1000;
static const int64_t longest_time_us = INT64_MAX / 1000000; /* 292 years: no sum in here can overflow */

sim_bus_t *sim_bus_create(const sim_bus_config_t *config)
{
    if (config->bitrate < 10000 || config->bitrate > 1000000 || config->start_us < 0 ||
        config->start_us > longest_time_us)
        return NULL;
    if (config->fd && (config->data_bitrate < config->bitrate || config->data_bitrate > 8000000))
        return NULL;
    sim_bus_t *bus = calloc(1, sizeof *bus);
    if (bus == NULL)
        return NULL;
    bus->bitrate = config->bitrate;
    bus->data_bitrate = config->fd ? config->data_bitrate : config->bitrate;
    bus->fd = config->fd;
    bus->seed = config->seed;
    bus->random = (rng_t){config->seed};
    bus->start_ns = config->start_us * 1000;
    bus->now_ns = bus->free_ns = bus->window_start_ns = bus->start_ns;
    return bus;
}

void sim_bus_destroy(sim_bus_t *bus)
{
    if (bus == NULL)
        return;
    for (int i = 0; i < bus->count; i++)
        free(bus->controller[i]);
    free(bus);
}

hal_can_t *sim_bus_attach(sim_bus_t *bus)
{
    if (bus->count == SIM_BUS_MAX_CONTROLLERS)
        return NULL;
    hal_can_t *can = calloc(1, sizeof *can);
    if (can == NULL)
        return NULL;
    can->bus = bus;
    can->index = bus->count;
    can->plugged = true;
    can->random = (rng_t){bus->seed + (uint64_t)can->index};
    bus->controller[bus->count++] = can;
    return can;
}

int64_t sim_bus_now_us(const sim_bus_t *bus)
{
    return bus->now_ns / 1000;
}

void sim_bus_set_log(sim_bus_t *bus, sim_bus_log_fn *log, void *context)
{
    bus->log = log;
    bus->log_context = context;
}

bool sim_bus_carries(const sim_bus_t *bus, const hal_can_frame_t *frame)
{
    const uint32_t last_id = frame->extended ? 0x1FFFFFFFU : 0x7FFU;
    if (frame->id > last_id || (frame->fd && !bus->fd))
        return false;
    const unsigned n = frame->length;
    return n <= 8 || (frame->fd && ((n <= 24 && n % 4 == 0) || n == 32 || n == 48 || n == 64));
}

/* Bits in the order sent: base identifier, SRR and IDE (recessive in extended frames), its rest, FDF. */
static uint32_t arbitration_key(const hal_can_frame_t *frame)
{
    const uint32_t fd = frame->fd ? 1 : 0;
    if (!frame->extended)
        return frame->id << 20 | fd;
    return (frame->id >> 18) << 20 | 1U << 19 | (frame->id & 0x3FFFFU) << 1 | fd;
}

sim_can_pending_t sim_bus_pending(sim_bus_t *bus, const hal_can_frame_t *frame)
{
    sim_can_pending_t pending = {.key = arbitration_key(frame), .sequence = bus->sequence++, .frame = *frame};
    pending.frame.bit_rate_switch = frame->fd && frame->bit_rate_switch;
    for (int i = frame->length; i < HAL_CAN_MAX_LENGTH; i++)
        pending.frame.data[i] = 0; /* whatever the sender had there does not travel */
    return pending;
}

static int64_t rounded_ns(int64_t bits, int64_t rate)
{
    return (bits * 1000000000 + rate / 2) / rate;
}

int64_t sim_bus_bits_ns(const sim_bus_t *bus, int64_t bits)
{
    return rounded_ns(bits, bus->bitrate);
}

/* Busy time up to a moment not before now: what is on the wire now is all that is known of the future. */
static int64_t busy_until(const sim_bus_t *bus, int64_t time_ns)
{
    return bus->stats.busy_ns - (bus->free_ns > time_ns ? bus->free_ns - time_ns : 0);
}

static void move_now(sim_bus_t *bus, int64_t time_ns)
{
    const int64_t windows = (time_ns - bus->window_start_ns) / window_ns;
    if (windows > 0) {
        const int64_t end_ns = bus->window_start_ns + windows * window_ns;
        const int64_t begin_busy_ns = windows == 1 ? bus->window_start_busy_ns : busy_until(bus, end_ns - window_ns);
        bus->window_start_ns = end_ns;
        bus->window_start_busy_ns = busy_until(bus, end_ns);
        bus->last_window_busy_ns = bus->window_start_busy_ns - begin_busy_ns;
    }
    bus->now_ns = time_ns;
    for (int i = 0; i < bus->count; i++)
        sim_can_settle(bus->controller[i]);
}

static bool wants_to_send(const hal_can_t *can)
{
    return can->transmit_count > 0 && sim_can_is_on_bus(can);
}

/* When the next frame starts as things are: nobody starts while the wire is taken, or before now. */
static int64_t next_start_ns(const sim_bus_t *bus)
{
    const int64_t earliest = bus->free_ns > bus->now_ns ? bus->free_ns : bus->now_ns;
    if (bus->flooding)
        return earliest;
    int64_t start = INT64_MAX;
    for (int i = 0; i < bus->count; i++) {
        const hal_can_t *can = bus->controller[i];
        const int64_t ready = can->resume_ns > earliest ? can->resume_ns : earliest;
        if (wants_to_send(can) && ready < start)
            start = ready;
    }
    return start;
}

/* Let all who are ready arbitrate. NULL: the flooding node won. */
static hal_can_t *winner_of_arbitration(sim_bus_t *bus)
{
    hal_can_t *winner = NULL;
    const sim_can_pending_t *best = bus->flooding ? &bus->flood : NULL;
    bool collision = false;
    for (int i = 0; i < bus->count; i++) {
        hal_can_t *can = bus->controller[i];
        if (!wants_to_send(can) || can->resume_ns > bus->now_ns)
            continue;
        const sim_can_pending_t *first = &can->transmit[0];
        const bool same_id = best != NULL && first->key >> 1 == best->key >> 1;
        const bool older = same_id && first->key == best->key && first->sequence < best->sequence;
        if (best == NULL || first->key < best->key || older) {
            collision = same_id;
            best = first;
            winner = can;
        } else {
            collision |= same_id;
        }
    }
    bus->stats.collisions += collision;
    return winner;
}

static void start_frame(sim_bus_t *bus)
{
    hal_can_t *sender = winner_of_arbitration(bus);
    sim_wire_t *wire = &bus->wire;
    wire->busy = true;
    wire->sender = sender;
    wire->pending = sender == NULL ? bus->flood : sim_can_take_first(sender);
    wire->destroyed = sim_bus_is_destroyed(bus, sender);

    const sim_can_bits_t bits = sim_can_bits(&wire->pending.frame);
    const int64_t nominal = wire->destroyed
                                ? bits.arbitration - SIM_CAN_TAIL_BITS + SIM_CAN_ERROR_BITS + SIM_CAN_INTERMISSION_BITS
                                : bits.arbitration;
    const int64_t taken_ns = sim_bus_bits_ns(bus, nominal) + rounded_ns(bits.data, bus->data_bitrate);
    bus->free_ns = bus->now_ns + taken_ns;
    wire->done_ns = bus->free_ns - sim_bus_bits_ns(bus, SIM_CAN_INTERMISSION_BITS);
    bus->stats.busy_ns += taken_ns;
    bus->stats.bits += nominal + bits.data;
}

static void end_destroyed_frame(sim_bus_t *bus)
{
    const sim_wire_t *wire = &bus->wire;
    bus->stats.error_frames++;
    for (int i = 0; i < bus->count; i++)
        if (bus->controller[i] != wire->sender && sim_can_is_on_bus(bus->controller[i]))
            sim_can_hear_error(bus->controller[i]);
    if (wire->sender != NULL)
        sim_can_was_destroyed(wire->sender, &wire->pending);
}

static void end_frame(sim_bus_t *bus)
{
    sim_wire_t *wire = &bus->wire;
    wire->busy = false;
    if (wire->destroyed || (wire->sender != NULL && !sim_can_is_on_bus(wire->sender))) {
        end_destroyed_frame(bus);
        return;
    }
    bus->stats.frames++;
    bus->stats.flood_frames += wire->sender == NULL;
    if (wire->sender != NULL)
        sim_can_was_sent(wire->sender);
    hal_can_frame_t frame = wire->pending.frame;
    frame.time_us = bus->now_ns / 1000;
    frame.own = false;
    const int number = wire->sender == NULL ? SIM_BUS_FLOOD_SENDER : wire->sender->index;
    sim_bus_deliver(bus, wire->sender, &frame);
    if (wire->sender != NULL && wire->pending.frame.own)
        sim_can_deliver(wire->sender, &wire->pending.frame);
    if (bus->log != NULL)
        bus->log(bus->log_context, number, &frame);
}

void sim_bus_advance(sim_bus_t *bus, int64_t until_us)
{
    const int64_t until_ns = (until_us < longest_time_us ? until_us : longest_time_us) * 1000;
    while (until_ns > bus->now_ns) {
        const int64_t next_ns = bus->wire.busy ? bus->wire.done_ns : next_start_ns(bus);
        /* Nobody starts at the very end: who queues a frame at that moment still takes part in the arbitration. */
        if (bus->wire.busy ? next_ns > until_ns : next_ns >= until_ns)
            break;
        move_now(bus, next_ns);
        if (bus->wire.busy)
            end_frame(bus);
        else
            start_frame(bus);
    }
    if (until_ns > bus->now_ns)
        move_now(bus, until_ns);
}

static int32_t ppm_of(int64_t part, int64_t whole)
{
    return whole > 0 ? (int32_t)(1e6 * (double)part / (double)whole + 0.5) : 0;
}

sim_bus_stats_t sim_bus_stats(const sim_bus_t *bus)
{
    sim_bus_stats_t stats = bus->stats;
    stats.busy_ns = busy_until(bus, bus->now_ns);
    stats.elapsed_ns = bus->now_ns - bus->start_ns;
    stats.load_ppm = ppm_of(stats.busy_ns, stats.elapsed_ns);
    const bool one_is_full = bus->window_start_ns > bus->start_ns;
    stats.window_load_ppm = one_is_full ? ppm_of(bus->last_window_busy_ns, window_ns) : stats.load_ppm;
    return stats;
}
