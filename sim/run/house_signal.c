// SPDX-License-Identifier: Apache-2.0
// The house's genlock signal of a run: edges on the boards' inputs, and how far from them refreshes begin.
#include "sim/run/house_signal.h"

#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_gpio.h"

enum { MILLION = 1000000 };

static int64_t edge_us(const house_signal_t *house, int64_t n)
{
    const int64_t length_us = sim_rate_time_us(&house->refresh, n) - house->refresh.start_us;
    return house->refresh.start_us + length_us - length_us * house->options.ppm / (MILLION + house->options.ppm);
}

void house_signal_advance(house_signal_t *house, const sim_world_t *world, const room_t *room, int64_t now_us)
{
    for (; house->options.on && edge_us(house, house->next) <= now_us; house->next++)
        for (int32_t i = 0; i < room->board_count; i++) {
            const hal_board_t *devices = sim_world_devices(world, i);
            if (house->options.node == 0 || house->options.node == room->board[i].node)
                sim_gpio_genlock(devices->gpio, sim_clock_shows_us(devices->clock, edge_us(house, house->next)));
        }
}

/* The newest edge that a board has seen, less the begin of the refresh that is nearest to it. */
static int32_t edge_off_us(const projector_t *projector)
{
    const int64_t house_us = bus_time_from_local(&projector->time.time, projector->choice.house_us);
    return frame_clock_off_us(&projector->choice.clock, house_us);
}

void house_signal_note(run_frame_t *frame, const sim_world_t *world, const room_t *room)
{
    for (int32_t i = 0; i < room->board_count; i++) {
        const projector_t *projector = sim_world_projector(world, i);
        const int32_t node = room->board[i].node;
        if (!projector->choice.clock.leading || (frame->leader != 0 && frame->leader < node))
            continue; /* of two that have begun at once the lower one stays */
        frame->leader = (uint8_t)node;
        frame->housed = projector->choice.house_any;
        frame->house_off_us = frame->housed ? edge_off_us(projector) : 0;
    }
}
