// SPDX-License-Identifier: Apache-2.0
// An operator on the bus of projector_bench.h, who talks to the first of its boards, for tests of commands.
#ifndef TESTS_FIRMWARE_OPERATOR_BENCH_H
#define TESTS_FIRMWARE_OPERATOR_BENCH_H

#include <string.h>

#include "tests/firmware/projector_bench.h"

enum { OPERATED_NODE = 5, REPLY_STEPS = 3 * ROOM_BENCH_HZ };

static struct {
    hal_can_t *can;
    isotp_t link;
    uint8_t reply[COMMAND_REPLY_BYTES];
    int length; /* of it */
    int most;   /* frames of the board's replies between two steps */
} operator;

static inline int open_operator(void **state)
{
    open_bench(state);
    operator.can = sim_bus_attach(sim_world_bus(bench.world));
    operator.most = 0;
    isotp_init(&operator.link, CAN_ID_REPLY + OPERATED_NODE, CAN_ID_COMMAND + OPERATED_NODE);
    bench.tracking = true;
    room_bench_run(&bench, 500);
    return 0;
}

/* A step of the room, then the operator's turn. */
static inline void operator_step(void)
{
    hal_can_frame_t frame;
    int replies = 0;
    room_bench_step(&bench);
    while (hal_can_receive(operator.can, &frame) == HAL_OK)
        replies += isotp_take(&operator.link, &frame, room_bench_now_us(&bench));
    operator.most = replies> operator.most ? replies : operator.most;
    while (isotp_next(&operator.link, &frame, room_bench_now_us(&bench)))
        assert_int_equal(hal_can_send(operator.can, &frame), HAL_OK);
}

static inline void operator_send(const void *bytes, int length)
{
    assert_true(isotp_send(&operator.link, bytes, length, room_bench_now_us(&bench)));
}

/* @return Did a reply come? */
static inline bool operator_wait(void)
{
    operator.length = 0;
    for (int i = 0; i < REPLY_STEPS && operator.length == 0; i++) {
        const uint8_t *bytes;
        operator_step();
        operator.length = isotp_received(&operator.link, &bytes);
        if (operator.length> 0)
            memcpy(operator.reply, bytes, (size_t) operator.length);
        isotp_taken(&operator.link);
    }
    return operator.length> 0;
}

/* The reply to a request has this result; what belongs to it is in operator.reply. */
static inline void ask(const void *bytes, int length, command_result_t result)
{
    operator_send(bytes, length);
    assert_true(operator_wait());
    assert_true(operator.length >= 2);
    assert_int_equal(operator.reply[0], *(const uint8_t *)bytes | COMMAND_REPLY_FLAG);
    assert_int_equal(operator.reply[1], result);
}

static inline void ask_command(command_t command, command_result_t result)
{
    uint8_t bytes[COMMAND_MAX_BYTES];
    ask(bytes, command_encode(bytes, &command), result);
}

#endif
