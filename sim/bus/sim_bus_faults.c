// SPDX-License-Identifier: Apache-2.0
// Faults of the simulated bus: what is set, and what it does to the frame at hand.
#include <stddef.h>

#include "sim/bus/sim_bus_internal.h"

static const int64_t longest_delay_us = 3600000000;

static bool strikes(sim_bus_t *bus, sim_bus_fault_t fault)
{
    sim_bus_fail_t *fail = &bus->fail[fault];
    if (fail->next > 0) {
        fail->next--;
        return true;
    }
    return fail->ppm > 0 && rng_next(&bus->random) % 1000000 < fail->ppm;
}

bool sim_bus_is_destroyed(sim_bus_t *bus, const hal_can_t *sender)
{
    const hal_can_t *only = bus->fail[SIM_BUS_ERROR].only;
    return (only == NULL || only == sender) && strikes(bus, SIM_BUS_ERROR);
}

/* A fault at one listener concerns only the frames that one hears. */
static bool strikes_delivery(sim_bus_t *bus, sim_bus_fault_t fault, const hal_can_t *sender)
{
    const hal_can_t *only = bus->fail[fault].only;
    return (only == NULL || (only != sender && sim_can_is_on_bus(only))) && strikes(bus, fault);
}

static bool concerns(const sim_bus_t *bus, sim_bus_fault_t fault, const hal_can_t *can)
{
    return bus->fail[fault].only == NULL || bus->fail[fault].only == can;
}

/* Flip one to three neighbouring bits; frames have 8 bits or more here, so none is flipped back. */
static hal_can_frame_t corrupted_copy(sim_bus_t *bus, const hal_can_frame_t *frame)
{
    hal_can_frame_t copy = *frame;
    const unsigned bits = frame->length * 8U;
    const unsigned first = (unsigned)(rng_next(&bus->random) % bits);
    const unsigned count = 1 + (unsigned)(rng_next(&bus->random) % 3);
    for (unsigned i = 0; i < count; i++) {
        const unsigned at = (first + i) % bits;
        copy.data[at / 8] = (uint8_t)(copy.data[at / 8] ^ 1U << at % 8);
    }
    return copy;
}

void sim_bus_deliver(sim_bus_t *bus, const hal_can_t *sender, const hal_can_frame_t *frame)
{
    const bool lost = strikes_delivery(bus, SIM_BUS_LOSE, sender);
    const bool corrupted = frame->length > 0 && strikes_delivery(bus, SIM_BUS_CORRUPT, sender);
    const bool duplicated = strikes_delivery(bus, SIM_BUS_DUPLICATE, sender);
    const hal_can_frame_t wrong = corrupted ? corrupted_copy(bus, frame) : *frame;
    bus->stats.lost += lost;
    bus->stats.corrupted += corrupted;
    bus->stats.duplicated += duplicated;
    for (int i = 0; i < bus->count; i++) {
        hal_can_t *can = bus->controller[i];
        if (can == sender || !sim_can_is_on_bus(can) || (lost && concerns(bus, SIM_BUS_LOSE, can)))
            continue;
        const hal_can_frame_t *heard = corrupted && concerns(bus, SIM_BUS_CORRUPT, can) ? &wrong : frame;
        sim_can_hear(can, heard);
        if (duplicated && concerns(bus, SIM_BUS_DUPLICATE, can))
            sim_can_deliver(can, heard);
    }
}

void sim_bus_fail(sim_bus_t *bus, sim_bus_fault_t fault, sim_bus_fail_t fail)
{
    bus->fail[fault] = fail;
}

hal_status_t sim_bus_fail_flood(sim_bus_t *bus, const hal_can_frame_t *frame)
{
    if (frame != NULL && !sim_bus_carries(bus, frame))
        return HAL_BAD_CALL;
    if (frame != NULL)
        bus->flood = sim_bus_pending(bus, frame);
    bus->flooding = frame != NULL;
    return HAL_OK;
}

void sim_bus_fail_delay(hal_can_t *can, int64_t delay_us)
{
    const int64_t delay = delay_us < longest_delay_us ? delay_us : longest_delay_us;
    can->delay_ns = delay > 0 ? delay * 1000 : 0;
}

void sim_bus_fail_bus_off(hal_can_t *can)
{
    sim_can_go_bus_off(can);
}

void sim_bus_fail_unplug(hal_can_t *can)
{
    can->plugged = false;
    sim_can_settle(can);
}

void sim_bus_replug(hal_can_t *can)
{
    can->plugged = true;
    sim_can_settle(can);
}

void sim_bus_fail_driver(hal_can_t *can, bool stuck)
{
    can->stuck = stuck;
}
