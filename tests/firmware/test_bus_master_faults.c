// SPDX-License-Identifier: Apache-2.0
// Tests of bus time on a bus with faults: an hour of them, and frames that are late, repeated, mixed up or wrong.
#include "tests/firmware/bus_master_bench.h"

enum { SEEDS = 3, BOARDS = 8, EVENTS = 18, EVENT_MS = 200000 };

static const uint8_t NUMBERS[] = {3, 5, 9, 12, 20, 33, 47, 63};

static int master_of(const bench_t *b)
{
    for (int i = 0; i < b->count; i++)
        if (!b->node[i].absent && state_of(b, i) == CAN_TIME_OWN)
            return i;
    fail_msg("seed %llu: nobody is master", (unsigned long long)b->seed);
    return 0;
}

/* Something happens to the master or to another board, and is over 5 s later. */
static void happen(bench_t *b, int event)
{
    static const hal_can_frame_t flood = {.length = 8};
    const int victim = event % 2 == 0 ? master_of(b) : event % BOARDS;
    node_t *node = &b->node[victim];
    switch (event % 6) {
    case 0:
        node->absent = true;
        bench_run(b, 5000);
        node->absent = false;
        break;
    case 1:
    case 2:
        sim_bus_fail_bus_off(node->can);
        bench_run(b, 5000);
        break;
    case 3:
        assert_int_equal(sim_bus_fail_flood(b->bus, &flood), HAL_OK);
        bench_run(b, 5000);
        assert_int_equal(sim_bus_fail_flood(b->bus, NULL), HAL_OK);
        break;
    case 4:
        sim_bus_fail_unplug(node->can);
        bench_run(b, 5000);
        sim_bus_replug(node->can);
        break;
    default:
        sim_bus_fail_driver(node->can, true);
        bench_run(b, 5000);
        sim_bus_fail_driver(node->can, false);
        break;
    }
}

/* 1 % of the frames lost, 1 % damaged, 1 % twice, 1 % destroyed and sent again; and every 200 s something worse. */
static void test_an_hour_of_faults(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        bench_t b;
        bench_open(&b, seed, NUMBERS, BOARDS);
        for (sim_bus_fault_t fault = SIM_BUS_LOSE; fault < SIM_BUS_FAULTS; fault++)
            sim_bus_fail(b.bus, fault, (sim_bus_fail_t){.ppm = 10000});
        bench_run(&b, 60000);
        check_master(&b, 0);
        for (int event = 0; event < EVENTS; event++) {
            happen(&b, event);
            bench_run(&b, 5000);
            check_master(&b, master_of(&b));
            bench_run(&b, EVENT_MS - 10000);
            check_master(&b, master_of(&b));
            if (b.worst_us > 100 || b.jump_us > 100)
                fail_msg("seed %llu event %d: %lld us apart, jumped %lld us", (unsigned long long)seed, event,
                         (long long)b.worst_us, (long long)b.jump_us);
        }
        for (int i = 0; i < BOARDS; i++)
            assert_int_equal(b.node[i].time.time.relocks, 0);
        print_message("seed %llu: at most %lld us apart\n", (unsigned long long)seed, (long long)b.worst_us);
        bench_close(&b);
    }
}

/* A node that hears frames made by hand, at moments of its clock. */
static bus_master_t listener(void)
{
    bus_master_t time;
    bus_master_init(&time, 7, 0);
    return time;
}

static can_check_t hear_sync(bus_master_t *time, uint8_t number, uint8_t counter, int64_t time_us)
{
    const can_sync_t sync = {.number = number, .counter = counter, .origin = number};
    hal_can_frame_t frame;
    assert_true(can_sync_encode(&frame, &sync));
    frame.time_us = time_us;
    return bus_master_hear(time, &frame);
}

static can_check_t hear_follow_up(bus_master_t *time, uint8_t number, uint8_t counter, int64_t time_us)
{
    const can_follow_up_t follow_up = {.number = number, .counter = counter, .time_us = (uint64_t)time_us / 125000};
    hal_can_frame_t frame;
    assert_true(can_follow_up_encode(&frame, &follow_up));
    frame.time_us = time_us;
    return bus_master_hear(time, &frame);
}

static void hear_pair(bus_master_t *time, uint8_t number, uint8_t counter, int64_t time_us)
{
    assert_int_equal(hear_sync(time, number, counter, time_us), CAN_CHECK_OK);
    assert_int_equal(hear_follow_up(time, number, counter, time_us + 17000), CAN_CHECK_OK);
}

static void test_only_pairs_that_belong_together_count(void **state)
{
    (void)state;
    bus_master_t time = listener();
    hear_follow_up(&time, 3, 0, 1000); /* without a Sync */
    assert_int_equal(time.mismatched, 1);
    hear_sync(&time, 3, 1, 125000);
    hear_follow_up(&time, 3, 2, 130000); /* of another counter */
    hear_follow_up(&time, 4, 1, 130000); /* of another sender */
    hear_follow_up(&time, 3, 1, 225001); /* too late */
    assert_int_equal(time.mismatched, 4);
    assert_false(time.following);
    assert_int_equal(time.time.pairs, 0);

    hear_pair(&time, 3, 2, 250000);
    assert_true(time.following && time.master == 3 && time.origin == 3);
    hear_follow_up(&time, 3, 2, 270000); /* again */
    assert_int_equal(time.mismatched, 5);
    assert_int_equal(time.time.pairs, 1);
    hear_sync(&time, 3, 3, 375000);
    hear_sync(&time, 3, 3, 375300); /* again: the first stamp stays */
    hear_follow_up(&time, 3, 3, 390000);
    assert_int_equal(time.time.pairs, 2);
    assert_int_equal(time.time.paired_us, 375000);
    assert_int_equal(time.lost, 0);
}

static void test_lost_pairs_are_counted(void **state)
{
    (void)state;
    bus_master_t time = listener();
    hear_pair(&time, 3, 13, 0);
    hear_pair(&time, 3, 1, 375000); /* 14 and 0 are missing */
    assert_int_equal(time.lost, 2);
    hear_sync(&time, 3, 2, 500000); /* its FollowUp is missing */
    hear_pair(&time, 3, 3, 625000);
    assert_int_equal(time.lost, 3);
    hear_pair(&time, 3, 2, 750000); /* older than the newest */
    assert_int_equal(time.time.pairs, 3);
    hear_pair(&time, 3, 9, 2000000); /* after a silence any counter will do, and nothing is known of those before */
    assert_int_equal(time.lost, 3);
    assert_int_equal(time.time.paired_us, 2000000);
}

static void test_a_worse_master_is_followed_only_in_silence(void **state)
{
    (void)state;
    bus_master_t time = listener();
    hear_pair(&time, 3, 0, 0);
    hear_pair(&time, 9, 0, 60000);
    hear_pair(&time, 3, 1, 125000);
    assert_int_equal(time.master, 3);
    hear_pair(&time, 9, 1, 185000);
    hear_pair(&time, 9, 2, 600000);
    assert_int_equal(time.master, 3);
    hear_pair(&time, 9, 3, 725000); /* 3 was last heard 583 ms ago */
    assert_int_equal(time.master, 9);
    hear_sync(&time, 3, 2, 800000); /* a Sync alone is no master */
    assert_int_equal(time.master, 9);
    hear_pair(&time, 3, 3, 860000);
    assert_int_equal(time.master, 3);
    assert_int_equal(time.changes, 2);
}

static void test_what_is_wrong_is_refused(void **state)
{
    (void)state;
    bus_master_t time = listener();
    const bus_master_t before = time;
    hal_can_frame_t frame;
    assert_true(can_sync_encode(&frame, &(can_sync_t){.number = 3}));
    frame.data[4] ^= 1;
    assert_int_equal(bus_master_hear(&time, &frame), CAN_CHECK_CRC);
    frame.length = 7;
    assert_int_equal(bus_master_hear(&time, &frame), CAN_CHECK_LENGTH);
    frame.id = CAN_ID_POSE_FD;
    assert_int_equal(bus_master_hear(&time, &frame), CAN_CHECK_OTHER);
    hear_pair(&time, 7, 0, 0); /* its own number, of another node */
    assert_memory_equal(&time, &before, sizeof before);
}

/* A clock that bus time could not begin with: it begins at 1 s. */
static void test_a_clock_that_does_not_fit_the_message(void **state)
{
    (void)state;
    static const int64_t NOW_US[] = {-5000, INT64_C(1) << 47, INT64_C(1000000000000000)};
    const uint8_t number = BUS_MASTER_TRACKER;
    for (size_t i = 0; i < sizeof NOW_US / sizeof NOW_US[0]; i++) {
        bench_t b;
        bench_open(&b, 1, &number, 1);
        bus_master_t *time = &b.node[0].time;
        bus_master_init(time, number, NOW_US[i]);
        for (int step = 0; step < 3; step++) {
            hal_can_frame_t frame;
            bus_master_step(time, b.node[0].can, NOW_US[i] + step);
            sim_bus_advance(b.bus, b.now_us += 1000);
            if (hal_can_receive(b.node[0].can, &frame) == HAL_OK) {
                frame.time_us = NOW_US[i] + step;
                assert_int_equal(bus_master_hear(time, &frame), CAN_CHECK_OK);
            }
        }
        assert_true(time->own);
        assert_in_range(bus_time_from_local(&time->time, NOW_US[i] + 100), 1000000, 1000100);
        assert_int_equal(time->unsent, 0);
        bench_close(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_hour_of_faults),
        cmocka_unit_test(test_only_pairs_that_belong_together_count),
        cmocka_unit_test(test_lost_pairs_are_counted),
        cmocka_unit_test(test_a_worse_master_is_followed_only_in_silence),
        cmocka_unit_test(test_what_is_wrong_is_refused),
        cmocka_unit_test(test_a_clock_that_does_not_fit_the_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
