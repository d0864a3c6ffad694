// SPDX-License-Identifier: Apache-2.0
// Tests of the pose receiver: order, duplicates, losses, restarts, and whose frames are taken.
#include "tests/firmware/pose_bench.h"

static void test_nothing_received_is_no_pose_and_no_fault(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    receive(&bench);
    assert_false(bench.poses.any);
    check_faults(&bench);
}

static void test_a_set_counts_in_any_order_with_its_last_frame(void **state)
{
    (void)state;
    static const int ORDER[6][CAN_POSE_PARTS] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    bench_t bench = new_bench();
    for (int i = 0; i < 6; i++) {
        hal_can_frame_t part[CAN_POSE_PARTS];
        can_pose_t pose = pose_number(&bench, 9 + i); /* the first counter ever may be any */
        make_set(part, &pose);
        const can_pose_t before = bench.poses.newest;
        queue(&bench, &part[ORDER[i][0]]);
        queue(&bench, &part[ORDER[i][1]]);
        receive(&bench);
        assert_memory_equal(&bench.poses.newest, &before, sizeof before);
        queue(&bench, &part[ORDER[i][2]]);
        receive(&bench);
        assert_newest(&bench, &pose);
        assert_true(bench.poses.received_us == bench.time_us);
    }
    check_faults(&bench);
}

static void test_fd_poses_count_at_once_and_the_newest_wins(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    can_pose_t pose = {0};
    for (int i = 250; i < 270; i++)
        pose = send_fd(&bench, i % CAN_E2E_P05_COUNTERS);
    receive(&bench);
    assert_newest(&bench, &pose);
    assert_true(bench.poses.received_us == bench.time_us);
    check_faults(&bench);
}

static void test_other_messages_are_ignored(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    hal_can_frame_t frame = {0};
    for (uint32_t id = 0; id < 0x800; id++) {
        frame.id = id;
        const bool is_pose = id == CAN_ID_POSE_FD || (id >= CAN_ID_POSE_SET && id < CAN_ID_POSE_SET + CAN_POSE_PARTS);
        if (!is_pose)
            queue(&bench, &frame);
        if (bench.can.count == 200)
            receive(&bench);
    }
    frame.id = CAN_ID_POSE_FD;
    frame.extended = true;
    queue(&bench, &frame);
    can_pose_t pose = pose_number(&bench, 0);
    hal_can_frame_t part[CAN_POSE_PARTS];
    pose.viewer = 3;
    make_set(part, &pose);
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        queue(&bench, &part[i]);
    receive(&bench);
    assert_false(bench.poses.any);
    check_faults(&bench);

    bench.poses.viewer = 3;
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        queue(&bench, &part[i]);
    receive(&bench);
    assert_newest(&bench, &pose);
    check_faults(&bench);
}

static void test_duplicates_are_dropped_and_counted(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    hal_can_frame_t part[CAN_POSE_PARTS];
    can_pose_t pose = pose_number(&bench, 6);
    make_set(part, &pose);
    for (int i = 0; i < 9; i++)
        queue(&bench, &part[i / 2 % CAN_POSE_PARTS]); /* A A B B C C A A B */
    receive(&bench);
    assert_newest(&bench, &pose);
    assert_true(bench.poses.received_us == bench.time_us - 4 * 250);
    bench.expected.duplicate = 6;
    check_faults(&bench);

    const can_pose_t fd = send_fd(&bench, 77);
    send_fd(&bench, 77);
    receive(&bench);
    assert_newest(&bench, &fd);
    bench.expected.duplicate = 7;
    check_faults(&bench);
}

static void test_a_sender_that_is_stuck_gives_one_pose_only(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    const can_pose_t first = send_set(&bench, 3);
    for (int i = 0; i < 100; i++) {
        bench.time_us += POSE_PERIOD_US;
        send_set(&bench, 3);
        receive(&bench);
    }
    assert_newest(&bench, &first);
    bench.expected.duplicate = 300;
    check_faults(&bench);
}

static void test_lost_poses_are_counted(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    send_set(&bench, 13);
    const can_pose_t set = send_set(&bench, 2); /* 14, 0, 1 are missing */
    receive(&bench);
    assert_newest(&bench, &set);
    bench.expected.counter_lost = 3;
    check_faults(&bench);
    send_fd(&bench, 255);
    const can_pose_t fd = send_fd(&bench, 100);
    receive(&bench);
    assert_newest(&bench, &fd);
    bench.expected.counter_lost = 103;
    check_faults(&bench);
}

static void test_stale_frames_neither_count_nor_disturb(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    hal_can_frame_t late[CAN_POSE_PARTS];
    hal_can_frame_t part[CAN_POSE_PARTS];
    can_pose_t old = pose_number(&bench, 4);
    can_pose_t pose = pose_number(&bench, 5);
    make_set(late, &old);
    make_set(part, &pose);
    queue(&bench, &late[0]);
    queue(&bench, &late[1]);
    queue(&bench, &part[0]);
    queue(&bench, &late[2]);
    queue(&bench, &part[1]);
    queue(&bench, &late[2]);
    queue(&bench, &part[2]);
    receive(&bench);
    assert_newest(&bench, &pose);
    bench.expected.incomplete_set = 1;
    bench.expected.stale = 2;
    check_faults(&bench);
}

static void test_a_restarted_sender_is_followed(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    send_set(&bench, 6);
    send_fd(&bench, 100);
    can_pose_t pose = send_set(&bench, 0);
    receive(&bench);
    assert_newest(&bench, &pose);
    pose = send_fd(&bench, 0);
    receive(&bench);
    assert_newest(&bench, &pose);
    bench.expected.sender_restart = 2;
    check_faults(&bench);

    bench.time_us += POSE_FROM_CAN_SILENCE_US + 1000; /* long enough for the same counter to be new */
    pose = send_set(&bench, 0);
    receive(&bench);
    assert_newest(&bench, &pose);
    bench.expected.sender_restart = 3;
    check_faults(&bench);
}

static void test_frames_15_sets_apart_are_not_joined(void **state)
{
    (void)state;
    for (int first = 1; first < CAN_POSE_PARTS; first++) { /* how many frames of the older set come */
        bench_t bench = new_bench();
        hal_can_frame_t one[CAN_POSE_PARTS];
        hal_can_frame_t two[CAN_POSE_PARTS];
        can_pose_t old = pose_number(&bench, 8);
        can_pose_t pose = pose_number(&bench, 8);
        make_set(one, &old);
        make_set(two, &pose);
        for (int i = 0; i < first; i++)
            queue(&bench, &one[i]);
        bench.time_us += 15 * POSE_PERIOD_US;
        for (int i = first; i < CAN_POSE_PARTS; i++)
            queue(&bench, &two[i]);
        receive(&bench);
        assert_false(bench.poses.any);
        assert_int_equal(bench.faults.incomplete_set, 1);
        pose = send_set(&bench, 9);
        receive(&bench);
        assert_newest(&bench, &pose);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_received_is_no_pose_and_no_fault),
        cmocka_unit_test(test_a_set_counts_in_any_order_with_its_last_frame),
        cmocka_unit_test(test_fd_poses_count_at_once_and_the_newest_wins),
        cmocka_unit_test(test_other_messages_are_ignored),
        cmocka_unit_test(test_duplicates_are_dropped_and_counted),
        cmocka_unit_test(test_a_sender_that_is_stuck_gives_one_pose_only),
        cmocka_unit_test(test_lost_poses_are_counted),
        cmocka_unit_test(test_stale_frames_neither_count_nor_disturb),
        cmocka_unit_test(test_a_restarted_sender_is_followed),
        cmocka_unit_test(test_frames_15_sets_apart_are_not_joined),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
