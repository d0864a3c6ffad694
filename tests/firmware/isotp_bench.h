// SPDX-License-Identifier: Apache-2.0
// One end of an ISO-TP link, frame by frame, for its tests.
#ifndef TESTS_FIRMWARE_ISOTP_BENCH_H
#define TESTS_FIRMWARE_ISOTP_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/isotp.h"

enum { TOOL_ID = 0x601, BOARD_ID = 0x641, MS = 1000 };

static inline void assert_next(isotp_t *link, int64_t now_us, uint32_t id, const char *bytes)
{
    hal_can_frame_t frame;
    assert_true(isotp_next(link, &frame, now_us));
    assert_int_equal(frame.id, id);
    assert_int_equal(frame.length, 8);
    assert_false(frame.fd);
    assert_memory_equal(frame.data, bytes, 8);
}

static inline void assert_no_next(isotp_t *link, int64_t now_us)
{
    hal_can_frame_t frame;
    assert_false(isotp_next(link, &frame, now_us));
}

/* Takes a frame of 8 bytes. */
static inline void take(isotp_t *link, const char *bytes, int64_t now_us)
{
    hal_can_frame_t frame = {.id = link->receive_id, .length = 8};
    memcpy(frame.data, bytes, 8);
    assert_true(isotp_take(link, &frame, now_us));
}

static inline void assert_received(isotp_t *link, const void *data, int length)
{
    const uint8_t *found = NULL;
    assert_int_equal(isotp_received(link, &found), length);
    assert_memory_equal(found, data, (size_t)length);
    isotp_taken(link);
    assert_int_equal(isotp_received(link, &found), 0);
}

#endif
