// SPDX-License-Identifier: Apache-2.0
// What hal_can.h promises, of any HAL: test_hal_can [INTERFACE INTERFACE classic|fd]
// The build decides whose controllers these are; the simulator's need no arguments and are both kinds one by one.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/can_pair.h"

enum { KEPT = 256, BURST = 80, PACE = 4, PATIENCE = 2000, PATIENCE_US = 1000, QUIET_US = 20000 };

typedef struct {
    const char *names[2];
    bool fd;
    can_pair_t *pair;
} bench_t;

static int set_up(void **state)
{
    bench_t *bench = *state;
    bench->pair = can_pair_open(bench->names, bench->fd);
    return 0;
}

static int tear_down(void **state)
{
    bench_t *bench = *state;
    can_pair_close(bench->pair);
    return 0;
}

static hal_can_t *controller(void **state, int number)
{
    const bench_t *bench = *state;
    return can_pair_controller(bench->pair, number);
}

static void pass_time(void **state, int64_t time_us)
{
    const bench_t *bench = *state;
    can_pair_wait(bench->pair, time_us);
}

static int64_t now_us(void **state)
{
    const bench_t *bench = *state;
    return can_pair_now_us(bench->pair);
}

static hal_can_frame_t frame_of(uint32_t id, uint8_t length)
{
    hal_can_frame_t frame = {.id = id, .length = length};
    for (uint8_t i = 0; i < HAL_CAN_MAX_LENGTH; i++)
        frame.data[i] = (uint8_t)(id + 7U * i);
    return frame;
}

/* The next frame, as soon as it is there. */
static hal_can_frame_t receive(void **state, int number)
{
    hal_can_frame_t frame;
    for (int i = 0; i < PATIENCE; i++) {
        const hal_status_t status = hal_can_receive(controller(state, number), &frame);
        if (status == HAL_OK)
            return frame;
        assert_int_equal(status, HAL_EMPTY);
        pass_time(state, PATIENCE_US);
    }
    fail_msg("no frame after %d ms", PATIENCE * PATIENCE_US / 1000);
    return frame;
}

static void assert_nothing_there(void **state, int number)
{
    hal_can_frame_t frame, untouched;
    memset(&untouched, 0xA5, sizeof untouched);
    memcpy(&frame, &untouched, sizeof frame);
    pass_time(state, QUIET_US);
    assert_int_equal(hal_can_receive(controller(state, number), &frame), HAL_EMPTY);
    assert_memory_equal(&frame, &untouched, sizeof frame);
}

static void assert_same(const hal_can_frame_t *received, const hal_can_frame_t *sent)
{
    assert_int_equal(received->id, sent->id);
    assert_int_equal(received->extended, sent->extended);
    assert_int_equal(received->fd, sent->fd);
    assert_int_equal(received->bit_rate_switch, sent->bit_rate_switch);
    assert_int_equal(received->length, sent->length);
    assert_memory_equal(received->data, sent->data, sent->length);
}

/* Sent by 0, received by 1, as it was, stamped meanwhile. */
static void assert_passes(void **state, const hal_can_frame_t *sent)
{
    const int64_t before_us = now_us(state);
    assert_int_equal(hal_can_send(controller(state, 0), sent), HAL_OK);
    const hal_can_frame_t received = receive(state, 1);
    assert_same(&received, sent);
    assert_false(received.own);
    assert_true(received.time_us >= before_us && received.time_us <= now_us(state));
}

static void classic_frames_pass(void **state)
{
    static const uint32_t ids[2][3] = {{0, 0x123, 0x7FF}, {0, 0x12345678, 0x1FFFFFFF}};
    for (uint8_t length = 0; length <= 8; length++)
        for (int n = 0; n < 6; n++) {
            hal_can_frame_t frame = frame_of(ids[n % 2][n / 2], length);
            frame.extended = n % 2;
            assert_passes(state, &frame);
        }
    assert_nothing_there(state, 1);
    assert_nothing_there(state, 0);
}

static void fd_frames_pass(void **state)
{
    static const uint8_t lengths[] = {0, 1, 8, 12, 16, 20, 24, 32, 48, 64};
    const bench_t *bench = *state;
    for (size_t i = 0; i < sizeof lengths; i++)
        for (int n = 0; n < 4; n++) {
            hal_can_frame_t frame = frame_of(n % 2 ? 0x12345678 : 0x123, lengths[i]);
            frame.extended = n % 2;
            frame.fd = true;
            frame.bit_rate_switch = n / 2;
            if (bench->fd)
                assert_passes(state, &frame);
            else
                assert_int_equal(hal_can_send(controller(state, 0), &frame), HAL_BAD_CALL);
        }
    assert_nothing_there(state, 1);
}

static void illegal_frames_are_refused(void **state)
{
    const bench_t *bench = *state;
    hal_can_frame_t wrong[6];
    for (int i = 0; i < 6; i++)
        wrong[i] = frame_of(1, 8);
    wrong[0].id = 0x800;
    wrong[1].id = 0x20000000;
    wrong[1].extended = true;
    wrong[2].length = 9;
    wrong[3].length = 255;
    wrong[4].fd = wrong[5].fd = true;
    wrong[4].length = 13;
    wrong[5].length = 65;
    for (int i = 0; i < 6; i++)
        assert_int_equal(hal_can_send(controller(state, 0), &wrong[i]), HAL_BAD_CALL);
    assert_nothing_there(state, bench->fd);
}

static void own_frames_come_back_if_asked_for(void **state)
{
    for (uint8_t n = 0; n < 20; n++) {
        hal_can_frame_t frame = frame_of(0x40, 8);
        frame.data[0] = n;
        frame.own = n % 2;
        const int64_t before_us = now_us(state);
        assert_int_equal(hal_can_send(controller(state, 0), &frame), HAL_OK);
        const hal_can_frame_t heard = receive(state, 1);
        assert_same(&heard, &frame);
        assert_false(heard.own);
        if (frame.own) {
            const hal_can_frame_t back = receive(state, 0);
            assert_same(&back, &frame);
            assert_true(back.own);
            assert_true(back.time_us >= before_us && back.time_us <= now_us(state));
            frame.own = false; /* the same once more */
            assert_int_equal(hal_can_send(controller(state, 0), &frame), HAL_OK);
            (void)receive(state, 1);
        }
    }
    assert_nothing_there(state, 0);
}

/* All that the sender takes at once, and no other, arrives, in the order of one identifier. */
static void the_queue_takes_whole_frames_or_none(void **state)
{
    int taken = 0, refused = 0;
    for (int i = 0; i < BURST; i++) {
        hal_can_frame_t frame = frame_of(0x123, 8);
        frame.data[0] = (uint8_t)taken;
        const hal_status_t status = hal_can_send(controller(state, 0), &frame);
        assert_true(status == HAL_OK || status == HAL_FULL);
        taken += status == HAL_OK;
        refused += status == HAL_FULL;
    }
    assert_int_equal(taken + refused, BURST);
    for (int i = 0; i < taken; i++)
        assert_int_equal(receive(state, 1).data[0], (uint8_t)i);
    assert_nothing_there(state, 1);
}

/* Nobody takes them meanwhile. */
static void received_frames_are_kept(void **state)
{
    int64_t last_us = 0;
    const uint32_t lost = hal_can_lost(controller(state, 1));
    for (int i = 0; i < KEPT; i++) {
        hal_can_frame_t frame = frame_of((uint32_t)i, 8);
        hal_status_t status = HAL_FULL;
        for (int wait = 0; wait < PATIENCE && status == HAL_FULL; wait++) {
            status = hal_can_send(controller(state, 0), &frame);
            if (status == HAL_FULL)
                pass_time(state, PATIENCE_US);
        }
        assert_int_equal(status, HAL_OK);
        if (i % PACE == 0) /* emulated wires are faster than the controllers on them */
            pass_time(state, PATIENCE_US);
    }
    pass_time(state, 500000);
    bool seen[KEPT] = {false};
    for (int i = 0; i < KEPT; i++) {
        const hal_can_frame_t frame = receive(state, 1);
        assert_true(frame.id < KEPT && !seen[frame.id]);
        assert_true(frame.time_us >= last_us);
        last_us = frame.time_us;
        seen[frame.id] = true;
    }
    assert_nothing_there(state, 1);
    assert_int_equal(hal_can_lost(controller(state, 1)), lost);
}

static void a_good_bus_needs_no_restart(void **state)
{
    for (int number = 0; number < 2; number++) {
        assert_int_equal(hal_can_state(controller(state, number)), HAL_CAN_ERROR_ACTIVE);
        assert_int_equal(hal_can_restart(controller(state, number)), HAL_OK);
        assert_int_equal(hal_can_state(controller(state, number)), HAL_CAN_ERROR_ACTIVE);
    }
    const hal_can_frame_t frame = frame_of(0x123, 8);
    assert_passes(state, &frame);
}

static int run(bench_t *bench)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate_setup_teardown(classic_frames_pass, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(fd_frames_pass, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(illegal_frames_are_refused, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(own_frames_come_back_if_asked_for, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(the_queue_takes_whole_frames_or_none, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(received_frames_are_kept, set_up, tear_down, bench),
        cmocka_unit_test_prestate_setup_teardown(a_good_bus_needs_no_restart, set_up, tear_down, bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int argc, char **argv)
{
    bench_t bench = {.fd = argc == 4 && strcmp(argv[3], "fd") == 0};
    if (argc == 4) {
        bench.names[0] = argv[1];
        bench.names[1] = argv[2];
        return run(&bench);
    }
    const int failed = run(&bench);
    bench.fd = true;
    return failed + run(&bench);
}
