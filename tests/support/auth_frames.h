// SPDX-License-Identifier: Apache-2.0
// For the tests of authentication: a key, messages to sign, and a receiver.
#ifndef TESTS_SUPPORT_AUTH_FRAMES_H
#define TESTS_SUPPORT_AUTH_FRAMES_H

#include <string.h>

#include "firmware/can_auth.h"

static const hal_key_t AUTH_KEY = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};

static const uint64_t AUTH_SESSION = 0x0123456789abcdef, AUTH_TIME_US = 0xa1b2c3d4e5f6;
static const can_auth_fresh_t AUTH_FRESH = {0x0123456789abcdef, 0xa1b2c3d4e5f6};

/** @return A receiver that has heard nothing since just before that time. */
static inline can_auth_stream_t auth_stream_before(uint64_t time_us)
{
    return (can_auth_stream_t){.session = AUTH_SESSION, .newest_us = time_us - 1};
}

static inline can_auth_window_t auth_window_at(uint64_t now_us)
{
    return (can_auth_window_t){.now_us = now_us, .past_us = 100000, .future_us = 5000};
}

static inline hal_can_frame_t auth_fd_frame(void)
{
    hal_can_frame_t frame = {.id = 0x102, .fd = true, .bit_rate_switch = true, .length = CAN_AUTH_FD_PLAIN};
    for (int i = 0; i < CAN_AUTH_FD_PLAIN; i++)
        frame.data[i] = (uint8_t)i;
    return frame;
}

static inline void auth_set_frames(hal_can_frame_t part[3])
{
    for (int p = 0; p < 3; p++) {
        part[p] = (hal_can_frame_t){.id = 0x114 + (uint32_t)p, .length = 8};
        memset(part[p].data, 0x11 * (p + 1), 8);
    }
}

#endif
