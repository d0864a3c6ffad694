// SPDX-License-Identifier: Apache-2.0
// How late the walls of a room are, and how late they can be made.
#include "firmware/frame_latency.h"

enum { US_PER_MS = 1000, MOST_TARGET_MS = UINT8_MAX /* as it is sent */ };

int32_t frame_latency_held(const frame_clock_t *clock, int32_t target_ms)
{
    const int32_t period_us = frame_rate_period_us(clock->rate), short_us = target_ms * US_PER_MS - clock->display_us;
    const int32_t held = short_us < 0 ? 0 : (short_us + period_us / 2) / period_us;
    return held < FRAME_CLOCK_MOST_HELD ? held : FRAME_CLOCK_MOST_HELD;
}

static int32_t latency_us(const frame_clock_t *clock, int32_t display_us)
{
    return clock->pose_delay_us + frame_rate_period_us(clock->rate) * 3 / 2 + display_us;
}

int32_t frame_latency_target_ms(const frame_clock_t *clock, const room_latency_sum_t *sum)
{
    if (sum->wanted_ms == 0)
        return 0;
    const int32_t wanted_us = sum->wanted_ms * US_PER_MS - latency_us(clock, 0),
                  target_us = wanted_us > sum->most_display_us ? wanted_us : sum->most_display_us,
                  target_ms = (target_us + US_PER_MS - 1) / US_PER_MS;
    return target_ms < MOST_TARGET_MS ? target_ms : MOST_TARGET_MS;
}

frame_latency_t frame_latency_of_wish(const frame_clock_t *clock, int32_t wanted_ms, int64_t now_us)
{
    room_latency_t room = clock->room;
    room.board[clock->node].wanted_ms = wanted_ms;
    const room_latency_sum_t sum = room_latency_sum(&room, now_us);
    const int32_t period_us = frame_rate_period_us(clock->rate), target_ms = frame_latency_target_ms(clock, &sum),
                  most_us = sum.least_display_us + FRAME_CLOCK_MOST_HELD * period_us + period_us / 2;
    return (frame_latency_t){
        .will_us = latency_us(clock, clock->display_us + frame_latency_held(clock, target_ms) * period_us),
        .least_us = latency_us(clock, sum.most_display_us),
        .most_us = latency_us(clock, most_us),
        .possible = target_ms * US_PER_MS <= most_us,
    };
}
