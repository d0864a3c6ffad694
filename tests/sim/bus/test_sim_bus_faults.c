// SPDX-License-Identifier: Apache-2.0
// Every fault the simulated bus can be asked for does what it says, and nothing else.
#include "sim/bus/sim_bus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/bus_bench.h"

static void test_next_frames_are_lost_to_all_or_to_one(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    hal_can_frame_t frame;
    sim_bus_fail(bench.bus, SIM_BUS_LOSE, (sim_bus_fail_t){.next = 2});
    bus_bench_send_numbers(&bench, 5);
    assert_int_equal(hal_can_receive(bench.b, &frame), HAL_OK);
    assert_int_equal(bus_bench_number(&frame), 2);
    assert_int_equal(bus_bench_count_heard(bench.b), 2);
    assert_int_equal(bus_bench_count_heard(bench.c), 3);
    sim_bus_fail(bench.bus, SIM_BUS_LOSE, (sim_bus_fail_t){.next = 1, .only = bench.b});
    bus_bench_send_numbers(&bench, 5);
    assert_int_equal(bus_bench_count_heard(bench.b), 4);
    assert_int_equal(bus_bench_count_heard(bench.c), 5);
    assert_int_equal(sim_bus_stats(bench.bus).lost, 3);
    assert_int_equal(sim_bus_stats(bench.bus).frames, 10);
    sim_bus_destroy(bench.bus);
}

static void test_chance_is_as_set_and_the_same_again(void **state)
{
    (void)state;
    int64_t lost[2];
    for (int run = 0; run < 2; run++) {
        const bus_bench_t bench = bus_bench_begin();
        sim_bus_fail(bench.bus, SIM_BUS_LOSE, (sim_bus_fail_t){.ppm = 250000});
        for (int i = 0; i < 20; i++) {
            bus_bench_send_numbers(&bench, 100);
            bus_bench_count_heard(bench.b);
        }
        lost[run] = sim_bus_stats(bench.bus).lost;
        sim_bus_destroy(bench.bus);
    }
    assert_in_range(lost[0], 440, 560); /* 500 expected, standard deviation 19 */
    assert_int_equal(lost[0], lost[1]);
    assert_int_equal(lost[0], 502); /* on every machine */
}

static void test_corrupt_frames_differ_in_one_to_three_payload_bits(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail(bench.bus, SIM_BUS_CORRUPT, (sim_bus_fail_t){.ppm = 1000000, .only = bench.b});
    for (int i = 0; i < 200; i++) {
        bus_bench_send_numbers(&bench, 1);
        hal_can_frame_t good, wrong;
        assert_int_equal(hal_can_receive(bench.b, &wrong), HAL_OK);
        assert_int_equal(hal_can_receive(bench.c, &good), HAL_OK);
        assert_int_equal(wrong.id, good.id);
        assert_int_equal(wrong.length, good.length);
        int flipped = 0;
        for (int bit = 0; bit < 32; bit++)
            flipped += (wrong.data[bit / 8] ^ good.data[bit / 8]) >> bit % 8 & 1;
        assert_in_range(flipped, 1, 3);
    }
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 5}), HAL_OK); /* nothing to flip */
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(sim_bus_stats(bench.bus).corrupted, 200);
    sim_bus_destroy(bench.bus);
}

static void test_duplicates_come_twice(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    sim_bus_fail(bench.bus, SIM_BUS_DUPLICATE, (sim_bus_fail_t){.next = 1});
    bus_bench_send_numbers(&bench, 2);
    hal_can_frame_t frame;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(hal_can_receive(bench.b, &frame), HAL_OK);
        assert_int_equal(bus_bench_number(&frame), i == 2 ? 1 : 0);
    }
    assert_int_equal(bus_bench_count_heard(bench.b), 0);
    assert_int_equal(bus_bench_count_heard(bench.c), 3);
    assert_int_equal(sim_bus_stats(bench.bus).frames, 2);
    sim_bus_destroy(bench.bus);
}

static void test_delay_is_of_one_controller_and_keeps_order(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    hal_can_frame_t late, prompt;
    sim_bus_fail_delay(bench.b, 2500);
    bus_bench_send_numbers(&bench, 1);
    assert_int_equal(hal_can_receive(bench.c, &prompt), HAL_OK);
    assert_int_equal(hal_can_receive(bench.b, &late), HAL_EMPTY);
    sim_bus_fail_delay(bench.b, 0);
    bus_bench_send_numbers(&bench, 1);
    assert_int_equal(hal_can_receive(bench.b, &late), HAL_EMPTY); /* behind the late one */
    sim_bus_advance(bench.bus, prompt.time_us + 2500);
    assert_int_equal(hal_can_receive(bench.b, &late), HAL_OK);
    assert_int_equal(late.time_us, prompt.time_us + 2500);
    assert_int_equal(hal_can_receive(bench.b, &late), HAL_OK);
    assert_int_equal(late.time_us, prompt.time_us + 2500); /* stamps do not go back */
    sim_bus_destroy(bench.bus);
}

static void test_flood_leaves_the_wire_to_lower_identifiers_only(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    assert_int_equal(sim_bus_fail_flood(bench.bus, &(hal_can_frame_t){.id = 0x900}), HAL_BAD_CALL);
    assert_int_equal(sim_bus_fail_flood(bench.bus, &(hal_can_frame_t){.id = 0x100, .length = 8}), HAL_OK);
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0x0FF}), HAL_OK);
    assert_int_equal(hal_can_send(bench.a, &(hal_can_frame_t){.id = 0x101}), HAL_OK);
    bus_bench_run_for(&bench, 20000);
    assert_int_equal(sim_can_stats(bench.a).sent, 1);
    assert_int_equal(sim_bus_stats(bench.bus).load_ppm, 1000000);
    assert_true(sim_bus_stats(bench.bus).flood_frames > 70);
    assert_true(bus_bench_count_heard(bench.b) > 70);
    assert_int_equal(sim_bus_fail_flood(bench.bus, NULL), HAL_OK);
    bus_bench_run_for(&bench, 1000);
    assert_int_equal(sim_can_stats(bench.a).sent, 2);
    sim_bus_destroy(bench.bus);
}

static void test_stuck_driver_fails_every_call(void **state)
{
    (void)state;
    const bus_bench_t bench = bus_bench_begin();
    bus_bench_send_numbers(&bench, 1);
    sim_bus_fail_driver(bench.b, true);
    hal_can_frame_t frame = {.id = 99};
    assert_int_equal(hal_can_receive(bench.b, &frame), HAL_IO);
    assert_int_equal(frame.id, 99);
    assert_int_equal(hal_can_send(bench.b, &(hal_can_frame_t){.id = 1}), HAL_IO);
    assert_int_equal(hal_can_restart(bench.b), HAL_IO);
    sim_bus_fail_driver(bench.b, false);
    assert_int_equal(hal_can_receive(bench.b, &frame), HAL_OK);
    sim_bus_destroy(bench.bus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_next_frames_are_lost_to_all_or_to_one),
        cmocka_unit_test(test_chance_is_as_set_and_the_same_again),
        cmocka_unit_test(test_corrupt_frames_differ_in_one_to_three_payload_bits),
        cmocka_unit_test(test_duplicates_come_twice),
        cmocka_unit_test(test_delay_is_of_one_controller_and_keeps_order),
        cmocka_unit_test(test_flood_leaves_the_wire_to_lower_identifiers_only),
        cmocka_unit_test(test_stuck_driver_fails_every_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
