// SPDX-License-Identifier: Apache-2.0
// Tests of capture times: a board knows in bus time when a tracker measured a pose, or says that it does not.
#include "tests/firmware/bus_master_bench.h"

enum { TRACKER, BOARD, AGO_US = 20000 };

/* The tracker sends a pose measured so long ago, and the board hears it. */
static void send_pose(bench_t *b, bool fd, int number, int64_t ago_us)
{
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const can_pose_t pose = {
        .pose = {.quaternion_q30 = {1 << 30, 0, 0, 0}},
        .capture_time_us = (uint64_t)(bus_time_of(b, TRACKER) - ago_us),
        .quality = CAN_POSE_TRACKED,
        .counter = (uint8_t)(number % (fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS)),
    };
    assert_true(fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose));
    for (int i = 0; i < (fd ? 1 : CAN_POSE_PARTS); i++)
        assert_int_equal(hal_can_send(b->node[TRACKER].can, &frame[i]), HAL_OK);
    bench_step(b);
    assert_int_equal(b->node[BOARD].poses.newest.counter, pose.counter);
}

static const can_poses_t *poses(const bench_t *b)
{
    return &b->node[BOARD].poses;
}

static void check_captured(const bench_t *b, int64_t world_us)
{
    const int64_t bus_us = sim_clock_shows_us(b->node[TRACKER].clock, world_us);
    assert_true(poses(b)->captured);
    if (llabs(poses(b)->capture_bus_us - bus_us) > 51)
        fail_msg("seed %llu: captured in bus time at %lld, found %lld", (unsigned long long)b->seed, (long long)bus_us,
                 (long long)poses(b)->capture_bus_us);
}

static void open_locked(bench_t *b, uint64_t seed)
{
    static const uint8_t numbers[] = {BUS_MASTER_TRACKER, 1};
    bench_open(b, seed, numbers, 2);
    bench_run(b, LOCK_S * 1000);
    assert_int_equal(state_of(b, BOARD), CAN_TIME_LOCKED);
}

/* Over more than the 6.6 s after which a set's capture time wraps. */
static void test_capture_times_come_back(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        bench_t b;
        open_locked(&b, seed);
        for (int n = 0; n < 1000; n++) {
            const int64_t world_us = b.now_us - AGO_US;
            send_pose(&b, n >= 500, n, AGO_US);
            check_captured(&b, world_us);
        }
        bench_close(&b);
    }
}

static void test_a_capture_time_out_of_reach_is_not_believed(void **state)
{
    (void)state;
    static const struct {
        int64_t ago_us;
        bool captured;
    } CASE[] = {{990000, true}, {1010000, false}, {-4000, true}, {-7000, false}, {5000000, false}};
    bench_t b;
    open_locked(&b, 1);
    for (int n = 0; n < 10; n++) {
        send_pose(&b, n >= 5, n, CASE[n % 5].ago_us);
        assert_int_equal(poses(&b)->captured, CASE[n % 5].captured);
        if (!CASE[n % 5].captured)
            assert_int_equal(poses(&b)->capture_bus_us, 0);
    }
    send_pose(&b, true, 10, (int64_t)CAN_POSE_SET_WRAP_US + AGO_US); /* only in a set this would be 20 ms ago */
    assert_false(poses(&b)->captured);
    bench_close(&b);
}

static void test_without_a_trackers_bus_time_none_is_known(void **state)
{
    (void)state;
    static const uint8_t numbers[] = {BUS_MASTER_TRACKER, 1};
    bench_t b;
    bench_open(&b, 1, numbers, 2);
    bench_run(&b, 500);
    send_pose(&b, true, 0, AGO_US); /* still finding it */
    assert_false(poses(&b)->captured);
    bench_close(&b);

    static const uint8_t boards[] = {2, 1}; /* the pose's sender gives no time */
    bench_open(&b, 1, boards, 2);
    bench_run(&b, LOCK_S * 1000);
    assert_int_equal(state_of(&b, BOARD), CAN_TIME_OWN);
    send_pose(&b, true, 0, AGO_US);
    assert_false(poses(&b)->captured);
    bench_close(&b);
}

static void test_the_time_of_a_tracker_that_is_gone_is_held(void **state)
{
    (void)state;
    bench_t b;
    open_locked(&b, 1);
    b.node[TRACKER].absent = true; /* gives no more time, and still sends poses */
    bench_run(&b, 700);
    assert_int_equal(state_of(&b, BOARD), CAN_TIME_HOLDOVER);
    const int64_t held_us = b.now_us - AGO_US;
    send_pose(&b, false, 0, AGO_US);
    check_captured(&b, held_us);
    bench_run(&b, 5000);
    assert_int_equal(state_of(&b, BOARD), CAN_TIME_OWN);
    const int64_t own_us = b.now_us - AGO_US;
    send_pose(&b, true, 1, AGO_US);
    check_captured(&b, own_us);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_capture_times_come_back),
        cmocka_unit_test(test_a_capture_time_out_of_reach_is_not_believed),
        cmocka_unit_test(test_without_a_trackers_bus_time_none_is_known),
        cmocka_unit_test(test_the_time_of_a_tracker_that_is_gone_is_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
