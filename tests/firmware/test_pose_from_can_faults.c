// SPDX-License-Identifier: Apache-2.0
// Tests of the pose receiver: damage, bad poses and a failing controller are counted, the last pose is kept.
#include "tests/firmware/pose_bench.h"

static void test_damaged_frames_are_counted_and_their_set_is_not_used(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    const can_pose_t first = send_set(&bench, 0);
    hal_can_frame_t part[CAN_POSE_PARTS];
    can_pose_t pose = pose_number(&bench, 1);
    make_set(part, &pose);
    part[1].data[5] ^= 0x10;
    part[2].length = 7;
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        queue(&bench, &part[i]);
    make_set(part, &pose);
    part[1].data[1] |= 0x0F;
    part[1].data[0] = can_e2e_p01_crc((uint16_t)part[1].id, part[1].data, 8);
    queue(&bench, &part[1]);
    receive(&bench);
    assert_newest(&bench, &first);
    bench.expected.crc = 1;
    bench.expected.length = 1;
    bench.expected.counter_invalid = 1;
    check_faults(&bench);

    hal_can_frame_t frame;
    assert_true(can_pose_fd_encode(&frame, &pose));
    frame.data[31] ^= 1;
    queue(&bench, &frame);
    frame.length = 24;
    queue(&bench, &frame);
    const can_pose_t last = send_set(&bench, 2);
    receive(&bench);
    assert_newest(&bench, &last);
    bench.expected.crc = 2;
    bench.expected.length = 2;
    bench.expected.incomplete_set = 1;
    check_faults(&bench);
    assert_int_equal(can_faults_total(&bench.faults), 6);
}

static void test_bad_poses_are_counted_and_the_last_one_is_kept(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    const can_pose_t good = send_fd(&bench, 0);
    enum { BAD = 5 };
    can_pose_t bad[BAD];
    for (int i = 0; i < BAD; i++)
        bad[i] = pose_number(&bench, 1 + i);
    memset(bad[0].pose.quaternion_q30, 0, sizeof bad[0].pose.quaternion_q30);
    for (int i = 0; i < 4; i++) {
        bad[1].pose.quaternion_q30[i] = bad[1].pose.quaternion_q30[i] / 1000 * 1012;
        bad[2].pose.quaternion_q30[i] = bad[2].pose.quaternion_q30[i] / 1000 * 988;
    }
    bad[3].pose.eye_nm[2] = -INT64_C(1000000001000);
    bad[4].quality = CAN_POSE_LOST;
    for (int i = 0; i < BAD; i++) {
        hal_can_frame_t frame;
        assert_true(can_pose_fd_encode(&frame, &bad[i]));
        queue(&bench, &frame);
    }
    receive(&bench);
    assert_newest(&bench, &good);
    bench.expected.bad_pose = 4;
    bench.expected.tracking_lost = 1;
    check_faults(&bench);
    assert_int_equal(can_faults_total(&bench.faults), 4);

    can_pose_t odd = pose_number(&bench, 6); /* 0.8 % too long is not a fault */
    for (int i = 0; i < 4; i++)
        odd.pose.quaternion_q30[i] = odd.pose.quaternion_q30[i] / 1000 * 1008;
    odd.quality = CAN_POSE_PREDICTED;
    hal_can_frame_t frame;
    assert_true(can_pose_fd_encode(&frame, &odd));
    queue(&bench, &frame);
    receive(&bench);
    assert_int_equal(bench.poses.newest.quality, CAN_POSE_PREDICTED);
    check_faults(&bench);
}

static void test_a_broken_controller_is_counted(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    bench.can.broken = true;
    receive(&bench);
    receive(&bench);
    bench.expected.io = 2;
    check_faults(&bench);

    bench.can.broken = false;
    bench.can.state = HAL_CAN_BUS_OFF;
    receive(&bench);
    assert_int_equal(bench.can.restarts, 1);
    bench.expected.bus_off = 1;
    check_faults(&bench);
    bench.can.restart_refused = true;
    receive(&bench);
    bench.expected.bus_off = 2;
    bench.expected.io = 3;
    check_faults(&bench);
    bench.can.state = HAL_CAN_ERROR_PASSIVE;
    const can_pose_t pose = send_set(&bench, 0);
    receive(&bench);
    assert_int_equal(bench.can.restarts, 2);
    assert_newest(&bench, &pose);
    check_faults(&bench);
}

static void test_the_loop_is_bounded(void **state)
{
    (void)state;
    bench_t bench = new_bench();
    for (int i = 0; i < BUS_RECEIVE_FRAMES + 10; i++)
        send_fd(&bench, i % CAN_E2E_P05_COUNTERS);
    bus_receive(&(bus_receivers_t){.poses = &bench.poses, .faults = &bench.faults}, &bench.can);
    assert_int_equal(bench.can.next, BUS_RECEIVE_FRAMES);
    bench.expected.overrun = 1;
    check_faults(&bench);
    receive(&bench);
    check_faults(&bench);
    assert_int_equal(bench.poses.newest.counter, 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_damaged_frames_are_counted_and_their_set_is_not_used),
        cmocka_unit_test(test_bad_poses_are_counted_and_the_last_one_is_kept),
        cmocka_unit_test(test_a_broken_controller_is_counted),
        cmocka_unit_test(test_the_loop_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
