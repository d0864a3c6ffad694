// SPDX-License-Identifier: Apache-2.0
// Tests of the tracker on the simulated bus: poses at their times, and bus time when asked for.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sim/pose/pose_sender.h"

enum { POSES = 100, PERIOD_US = 20000, START_US = 5000000, FIRST_US = 700000 };

typedef struct {
    int poses, syncs, follow_ups;
    int64_t sync_us; /* end of the newest Sync */
} heard_t;

static void listen(void *context, int sender, const hal_can_frame_t *frame)
{
    heard_t *heard = context;
    can_sync_t sync;
    can_follow_up_t follow_up;
    can_pose_t pose;
    (void)sender;
    if (can_pose_fd_decode(&pose, frame, 0) == CAN_CHECK_OK) {
        const int64_t due_us = START_US + heard->poses * INT64_C(20000);
        assert_int_equal(pose.capture_time_us, due_us);
        assert_in_range(frame->time_us, due_us, due_us + 1000);
        heard->poses++;
    } else if (can_sync_decode(&sync, frame) == CAN_CHECK_OK) {
        assert_true(sync.number == 0 && sync.origin == 0);
        assert_true(heard->syncs == 0 || frame->time_us - heard->sync_us <= 131000);
        heard->sync_us = frame->time_us;
        heard->syncs++;
    } else if (can_follow_up_decode(&follow_up, frame) == CAN_CHECK_OK) {
        assert_int_equal(follow_up.time_us, heard->sync_us); /* the simulation's time is bus time */
        assert_true(frame->time_us - heard->sync_us <= 10000);
        heard->follow_ups++;
    }
}

static heard_t play(bool sync)
{
    pose_list_entry_t entry[POSES];
    for (int n = 0; n < POSES; n++)
        entry[n] = (pose_list_entry_t){FIRST_US + n * PERIOD_US, {.quaternion_q30 = {1 << 30, 0, 0, 0}}};
    const pose_list_t list = {entry, POSES};
    const sim_bus_config_t config = {.bitrate = 500000, .data_bitrate = 2000000, .fd = true};
    sim_bus_t *bus = sim_bus_create(&config);
    heard_t heard = {.poses = 0};
    sim_bus_set_log(bus, listen, &heard);
    const pose_sender_config_t tracker = {.bus = bus, .list = &list, .fd = true, .start_us = START_US, .sync = sync};
    pose_sender_t sender;
    assert_true(pose_sender_open(&sender, &tracker));
    for (int64_t now_us = 0; now_us <= START_US + POSES * PERIOD_US; now_us += 16667)
        pose_sender_advance(&sender, now_us);
    assert_int_equal(sender.sent, POSES);
    assert_int_equal(sender.unsent, 0);
    sim_bus_destroy(bus);
    return heard;
}

static void test_poses_at_their_times(void **state)
{
    (void)state;
    const heard_t heard = play(false);
    assert_int_equal(heard.poses, POSES);
    assert_int_equal(heard.syncs + heard.follow_ups, 0);
}

static void test_bus_time_is_the_simulations(void **state)
{
    (void)state;
    const heard_t heard = play(true);
    assert_int_equal(heard.poses, POSES);
    assert_in_range(heard.syncs, 55, 57); /* in 7 s */
    assert_in_range(heard.follow_ups, heard.syncs - 1, heard.syncs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_poses_at_their_times),
        cmocka_unit_test(test_bus_time_is_the_simulations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
