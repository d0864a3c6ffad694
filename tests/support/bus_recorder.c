// SPDX-License-Identifier: Apache-2.0
// Log and random frames for tests of the simulated bus.
#include "tests/support/bus_recorder.h"

void bus_recorder_note(void *context, int sender, const hal_can_frame_t *frame)
{
    bus_recorder_t *recorder = context;
    if (recorder->count == BUS_RECORDER_FRAMES)
        return;
    recorder->sender[recorder->count] = sender;
    recorder->frame[recorder->count++] = *frame;
}

uint64_t bus_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

hal_can_frame_t bus_random_frame(uint64_t *state, bool may_be_fd)
{
    hal_can_frame_t frame = {.extended = bus_random(state) % 2, .fd = may_be_fd && bus_random(state) % 2};
    frame.bit_rate_switch = frame.fd && bus_random(state) % 2;
    frame.id = (uint32_t)bus_random(state) & (frame.extended ? 0x1FFFFFFFU : 0x7FFU);
    frame.length = (uint8_t)(frame.fd ? 16 * (bus_random(state) % 3) : bus_random(state) % 9);
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = (uint8_t)bus_random(state);
    return frame;
}
