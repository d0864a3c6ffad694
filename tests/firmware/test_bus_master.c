// SPDX-License-Identifier: Apache-2.0
// Tests of who gives bus time: the first one, a lost one, a better one, two at once, one that comes back.
#include "tests/firmware/bus_master_bench.h"

enum { SEEDS = 10, BOARDS = 8 };

static const uint8_t NUMBERS[] = {3, 5, 9, 12, 20, 33, 47, 63};

static void test_the_lowest_number_becomes_master(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        bench_open(&b, seed, NUMBERS, BOARDS);
        bench_run(&b, 600);
        for (int i = 0; i < BOARDS; i++)
            assert_int_equal(state_of(&b, i), CAN_TIME_NONE);
        bench_run(&b, 500);
        assert_int_equal(state_of(&b, 0), CAN_TIME_OWN);
        bench_run(&b, LOCK_S * 1000);
        check_master(&b, 0);
        bench_run(&b, 60000);
        check_master(&b, 0);
        assert_in_range(bus_time_of(&b, 3), local_now(&b, 0) - 100, local_now(&b, 0) + 100);
        for (int i = 0; i < BOARDS; i++) {
            const bus_master_t *time = &b.node[i].time;
            assert_true(time->origin == 3 && time->changes == 0 && time->lost == 0 && time->mismatched == 0);
        }
        bench_close(&b);
    }
}

static void test_a_lost_master_is_replaced_without_a_step(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        bench_open(&b, seed, NUMBERS, BOARDS);
        bench_run(&b, 90000);
        bench_measure_anew(&b);
        for (int lost = 0; lost < 3; lost++) {
            b.node[lost].absent = true;
            bench_run(&b, 600);
            assert_int_equal(state_of(&b, 7), CAN_TIME_HOLDOVER);
            bench_run(&b, 1000);
            check_master(&b, lost + 1);
            bench_run(&b, 120000);
            check_master(&b, lost + 1);
            assert_true(b.jump_us <= 100);
        }
        for (int i = 3; i < BOARDS; i++)
            assert_true(b.node[i].time.changes == 3 && b.node[i].time.time.relocks == 0 && b.node[i].time.origin == 3);
        bench_close(&b);
    }
}

/* One that stays away for a while follows when it is back, whatever its number. */
static void test_one_that_comes_back_follows(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        bench_open(&b, seed, NUMBERS, 4);
        bench_run(&b, 90000);
        bench_measure_anew(&b);
        sim_bus_fail_unplug(b.node[0].can);
        bench_run(&b, 10000 + (int64_t)(seed * 137)); /* so that it is in any phase of claiming */
        assert_int_equal(state_of(&b, 1), CAN_TIME_OWN);
        assert_true(state_of(&b, 0) != CAN_TIME_OWN);
        sim_bus_replug(b.node[0].can);
        bench_run(&b, 2000);
        check_master(&b, 1);
        bench_run(&b, 60000);
        check_master(&b, 1);
        for (int i = 0; i < 4; i++)
            assert_int_equal(b.node[i].time.time.relocks, 0);
        bench_close(&b);
    }
}

static void test_a_tracker_takes_over_at_once_and_all_find_its_time(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        rng_t rng = {seed + 1000};
        bench_open(&b, seed, NUMBERS, BOARDS);
        bench_run(&b, 60000);
        check_master(&b, 0);
        bench_add(&b, BUS_MASTER_TRACKER, &rng);
        bench_run(&b, 1000);
        bench_measure_anew(&b);
        for (int i = 0; i < BOARDS; i++)
            assert_int_equal(state_of(&b, i), CAN_TIME_NONE);
        bench_run(&b, LOCK_S * 1000);
        check_master(&b, BOARDS);
        assert_in_range(bus_time_of(&b, 0), local_now(&b, BOARDS) - 100, local_now(&b, BOARDS) + 100);
        b.node[BOARDS].absent = true; /* and when it is gone, a board goes on with its time */
        bench_run(&b, 30000);
        check_master(&b, 0);
        assert_true(b.jump_us <= 100);
        for (int i = 0; i < BOARDS; i++) {
            const bus_master_t *time = &b.node[i].time;
            assert_true(time->changes == 2 && time->time.relocks == 1 && time->origin == BUS_MASTER_TRACKER);
        }
        bench_close(&b);
    }
}

/* Two halves of a bus, each with its master, become one. */
static void test_of_two_masters_the_lower_number_stays(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        bench_open(&b, seed, NUMBERS, 4);
        bench_run(&b, 60000);
        bus_master_t *other = &b.node[2].time;
        other->own = other->any = true; /* as if it had become master elsewhere */
        other->following = false;
        other->master = other->number;
        other->due_us = other->sent_us = local_now(&b, 2);
        other->time.offset_q12 += INT64_C(123456) << 12;
        bench_run(&b, 1000);
        assert_false(other->own);
        bench_run(&b, LOCK_S * 1000);
        bench_measure_anew(&b);
        bench_run(&b, 1000);
        check_master(&b, 0);
        for (int i = 0; i < 4; i++)
            assert_int_equal(b.node[i].time.time.relocks, i == 2);
        bench_close(&b);
    }
}

/* While the wire is taken, one Sync waits, not a queue of old ones. */
static void test_a_sync_that_waits_is_the_only_one(void **state)
{
    (void)state;
    static const hal_can_frame_t flood = {.length = 8};
    bench_t b;
    bench_open(&b, 1, NUMBERS, 2);
    bench_run(&b, 30000);
    assert_int_equal(sim_bus_fail_flood(b.bus, &flood), HAL_OK);
    bench_run(&b, 450);
    assert_int_equal(sim_can_stats(b.node[0].can).pending, 1);
    bench_close(&b);
}

/* An echo of a Sync from before the claim says nothing of the newest one; a lower number ends the claim. */
static void test_a_claim(void **state)
{
    (void)state;
    bench_t b;
    bench_open(&b, 1, NUMBERS, 2);
    bench_run(&b, 1000);
    bus_master_t *time = &b.node[1].time;
    hal_can_frame_t frame;
    b.node[0].absent = true;
    for (int i = 0; i < 100 && !(time->claiming && time->on_its_way); i++)
        bench_step(&b);
    assert_true(time->claiming && !time->claimed);
    assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 5, .counter = (uint8_t)((time->counter + 7) % 15)}));
    frame.own = true;
    frame.time_us = local_now(&b, 1);
    assert_int_equal(bus_master_hear(time, &frame), CAN_CHECK_OK);
    assert_false(time->claimed || time->sent_any);
    frame.own = false; /* a Sync with its own number from another node is ignored */
    assert_int_equal(bus_master_hear(time, &frame), CAN_CHECK_OK);
    assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 6}));
    assert_int_equal(bus_master_hear(time, &frame), CAN_CHECK_OK);
    assert_true(time->claiming);
    assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 4}));
    assert_int_equal(bus_master_hear(time, &frame), CAN_CHECK_OK);
    assert_false(time->claiming);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_lowest_number_becomes_master),
        cmocka_unit_test(test_a_lost_master_is_replaced_without_a_step),
        cmocka_unit_test(test_one_that_comes_back_follows),
        cmocka_unit_test(test_a_tracker_takes_over_at_once_and_all_find_its_time),
        cmocka_unit_test(test_of_two_masters_the_lower_number_stays),
        cmocka_unit_test(test_a_sync_that_waits_is_the_only_one),
        cmocka_unit_test(test_a_claim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
