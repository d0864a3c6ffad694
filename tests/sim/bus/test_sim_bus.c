// SPDX-License-Identifier: Apache-2.0
// The wire without faults: arbitration, timing, delivery, load, and the contract of hal_can.h.
#include "sim/bus/sim_bus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/bus_recorder.h"

static const sim_bus_config_t classic = {.bitrate = 500000};
static const sim_bus_config_t fd = {.bitrate = 1000000, .data_bitrate = 5000000, .fd = true};

static void test_rates_out_of_range_make_no_bus(void **state)
{
    (void)state;
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 0}));
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 9999}));
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 1000001}));
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 499999, .fd = true}));
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 8000001, .fd = true}));
    assert_null(sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .start_us = -1}));
    sim_bus_destroy(NULL);
}

static void test_64_controllers_and_no_more(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic);
    for (int i = 0; i < SIM_BUS_MAX_CONTROLLERS; i++)
        assert_non_null(sim_bus_attach(bus));
    assert_null(sim_bus_attach(bus));
    sim_bus_destroy(bus);
}

/* Identifier 0 without data: 53 bits of 2 us, of which 3 are intermission. */
static void test_frame_is_heard_by_the_others_when_its_last_bit_is_over(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic);
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus), *c = sim_bus_attach(bus);
    hal_can_frame_t heard = {.id = 99};
    sim_bus_advance(bus, 1000);
    assert_int_equal(hal_can_send(a, &(hal_can_frame_t){.id = 0}), HAL_OK);
    sim_bus_advance(bus, 1099);
    assert_int_equal(hal_can_receive(b, &heard), HAL_EMPTY);
    assert_int_equal(heard.id, 99);
    sim_bus_advance(bus, 1100);
    assert_int_equal(hal_can_receive(b, &heard), HAL_OK);
    assert_int_equal(heard.time_us, 1100);
    assert_int_equal(hal_can_receive(b, &heard), HAL_EMPTY);
    assert_int_equal(hal_can_receive(c, &heard), HAL_OK);
    assert_int_equal(hal_can_receive(a, &heard), HAL_EMPTY);
    assert_int_equal(sim_bus_stats(bus).busy_ns, 100000);
    sim_bus_advance(bus, 2000);
    assert_int_equal(sim_bus_stats(bus).busy_ns, 106000);
    assert_int_equal(sim_bus_now_us(bus), 2000);
    sim_bus_advance(bus, 500);
    assert_int_equal(sim_bus_now_us(bus), 2000);
    sim_bus_destroy(bus);
}

static void test_illegal_frames_are_refused(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic), *fd_bus = sim_bus_create(&fd);
    hal_can_t *can = sim_bus_attach(bus), *fd_can = sim_bus_attach(fd_bus);
    assert_int_equal(hal_can_send(can, &(hal_can_frame_t){.id = 0x800}), HAL_BAD_CALL);
    assert_int_equal(hal_can_send(can, &(hal_can_frame_t){.id = 0x20000000, .extended = true}), HAL_BAD_CALL);
    assert_int_equal(hal_can_send(can, &(hal_can_frame_t){.length = 9}), HAL_BAD_CALL);
    assert_int_equal(hal_can_send(can, &(hal_can_frame_t){.fd = true}), HAL_BAD_CALL);
    static const uint8_t legal[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    for (int length = 0; length < 256; length++) {
        const bool good = memchr(legal, length, sizeof legal) != NULL;
        const hal_can_frame_t frame = {.fd = true, .length = (uint8_t)length};
        assert_int_equal(hal_can_send(fd_can, &frame), good ? HAL_OK : HAL_BAD_CALL);
    }
    assert_int_equal(sim_can_stats(can).pending, 0);
    sim_bus_destroy(bus);
    sim_bus_destroy(fd_bus);
}

static void test_queues_are_bounded(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic);
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus);
    hal_can_frame_t frame = {.id = 5, .length = 2};
    for (int sent = 0; sent < 300;) {
        for (int i = 0; i < 64; i++, sent++) {
            frame.data[0] = (uint8_t)sent;
            frame.data[1] = (uint8_t)(sent >> 8);
            assert_int_equal(hal_can_send(a, &frame), HAL_OK);
        }
        assert_int_equal(hal_can_send(a, &frame), HAL_FULL);
        sim_bus_advance(bus, sim_bus_now_us(bus) + 10);
        assert_int_equal(hal_can_send(a, &frame), HAL_FULL); /* the one on the wire keeps its place */
        sim_bus_advance(bus, sim_bus_now_us(bus) + 20000);
    }
    for (int i = 0; i < 256; i++) {
        assert_int_equal(hal_can_receive(b, &frame), HAL_OK);
        assert_int_equal(frame.data[0] | frame.data[1] << 8, i);
    }
    assert_int_equal(hal_can_receive(b, &frame), HAL_EMPTY);
    assert_int_equal(sim_can_stats(b).overruns, 320 - 256);
    assert_int_equal(hal_can_lost(b), 320 - 256);
    assert_int_equal(hal_can_lost(a), 0);
    sim_bus_destroy(bus);
}

static void test_sender_that_keeps_order_does_not_sort(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic);
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus);
    sim_can_keep_order(a);
    for (uint32_t id = 3; id > 0; id--)
        assert_int_equal(hal_can_send(a, &(hal_can_frame_t){.id = id}), HAL_OK);
    sim_bus_advance(bus, 1000);
    hal_can_frame_t frame;
    for (uint32_t id = 3; id > 0; id--) {
        assert_int_equal(hal_can_receive(b, &frame), HAL_OK);
        assert_int_equal(frame.id, id);
    }
    sim_bus_destroy(bus);
}

static void test_equal_identifiers_keep_order_and_collisions_are_counted(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&classic);
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus), *c = sim_bus_attach(bus);
    for (uint8_t i = 0; i < 20; i++) {
        const hal_can_frame_t frame = {.id = 7, .length = 1, .data = {i}};
        assert_int_equal(hal_can_send(i % 2 == 0 ? b : a, &frame), HAL_OK);
    }
    sim_bus_advance(bus, 10000);
    hal_can_frame_t frame;
    for (int i = 0; i < 20; i++) {
        assert_int_equal(hal_can_receive(c, &frame), HAL_OK);
        assert_int_equal(frame.data[0], i);
    }
    assert_int_equal(sim_bus_stats(bus).collisions, 19);
    sim_bus_destroy(bus);
}

/* A later frame of a lower identifier, queued at the same moment by a board that steps later, still wins. */
static void test_frames_queued_at_the_moment_reached_arbitrate_together(void **state)
{
    (void)state;
    static bus_recorder_t log = {.count = 0};
    sim_bus_t *bus = sim_bus_create(&classic);
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus);
    sim_bus_set_log(bus, bus_recorder_note, &log);
    assert_int_equal(hal_can_send(a, &(hal_can_frame_t){.id = 0}), HAL_OK); /* the wire is free again at 106 us */
    sim_bus_advance(bus, 50);
    assert_int_equal(hal_can_send(a, &(hal_can_frame_t){.id = 9}), HAL_OK);
    sim_bus_advance(bus, 106);
    assert_int_equal(hal_can_send(b, &(hal_can_frame_t){.id = 8}), HAL_OK);
    sim_bus_advance(bus, 1000);
    assert_int_equal(log.count, 3);
    assert_int_equal(log.sender[1], 1);
    assert_int_equal(log.sender[2], 0);
    sim_bus_destroy(bus);
}

/* One frame of 53 bits of 10 us begins 100 us before a window ends. */
static void test_window_load_is_that_of_the_last_full_second(void **state)
{
    (void)state;
    sim_bus_t *bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 100000, .start_us = 5000000});
    hal_can_t *can = sim_bus_attach(bus);
    sim_bus_advance(bus, 5999900);
    assert_int_equal(hal_can_send(can, &(hal_can_frame_t){.id = 0}), HAL_OK);
    sim_bus_advance(bus, 6000000);
    assert_int_equal(sim_bus_stats(bus).window_load_ppm, 100);
    sim_bus_advance(bus, 6500000);
    assert_int_equal(sim_bus_stats(bus).window_load_ppm, 100);
    sim_bus_advance(bus, 7000000);
    assert_int_equal(sim_bus_stats(bus).window_load_ppm, 430);
    assert_int_equal(sim_bus_stats(bus).load_ppm, 265);
    sim_bus_advance(bus, 9000000);
    assert_int_equal(sim_bus_stats(bus).window_load_ppm, 0);
    sim_bus_advance(bus, INT64_MAX);
    assert_int_equal(sim_bus_stats(bus).busy_ns, 530000);
    sim_bus_destroy(bus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rates_out_of_range_make_no_bus),
        cmocka_unit_test(test_64_controllers_and_no_more),
        cmocka_unit_test(test_frame_is_heard_by_the_others_when_its_last_bit_is_over),
        cmocka_unit_test(test_illegal_frames_are_refused),
        cmocka_unit_test(test_queues_are_bounded),
        cmocka_unit_test(test_sender_that_keeps_order_does_not_sort),
        cmocka_unit_test(test_equal_identifiers_keep_order_and_collisions_are_counted),
        cmocka_unit_test(test_frames_queued_at_the_moment_reached_arbitrate_together),
        cmocka_unit_test(test_window_load_is_that_of_the_last_full_second),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
