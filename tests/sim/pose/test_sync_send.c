// SPDX-License-Identifier: Apache-2.0
// Tests of the bus time that a sender of poses gives: pairs of Sync and FollowUp on this machine's clock.
#include <linux/can.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

#include "firmware/bus_master.h"
#include "sim/devices/sim_clock.h"
#include "sim/pose/pose_send.h"
#include "sim/pose/sync_send.h"

enum { LIST_US = 300000 };

/* A link as to a SocketCAN interface, and its other end. */
typedef struct {
    pose_link_t link;
    int heard;
} wire_t;

static wire_t open_wire(void)
{
    int ends[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
    return (wire_t){.link = {.socket = ends[0], .name = "wire"}, .heard = ends[1]};
}

static void close_wire(wire_t *wire)
{
    pose_link_close(&wire->link);
    close(wire->heard);
}

static bool hear(const wire_t *wire, hal_can_frame_t *frame)
{
    struct can_frame raw;
    if (recv(wire->heard, &raw, sizeof raw, MSG_DONTWAIT) != (ssize_t)sizeof raw)
        return false;
    *frame = (hal_can_frame_t){.id = raw.can_id, .length = raw.can_dlc};
    memcpy(frame->data, raw.data, sizeof raw.data);
    return true;
}

/* The next two frames are a pair with this counter, of a tracker. @return Its time. */
static int64_t hear_pair(const wire_t *wire, int counter)
{
    hal_can_frame_t frame;
    can_sync_t sync;
    can_follow_up_t follow_up;
    assert_true(hear(wire, &frame));
    assert_int_equal(can_sync_decode(&sync, &frame), CAN_CHECK_OK);
    assert_true(hear(wire, &frame));
    assert_int_equal(can_follow_up_decode(&follow_up, &frame), CAN_CHECK_OK);
    assert_true(sync.number == BUS_MASTER_TRACKER && sync.origin == BUS_MASTER_TRACKER);
    assert_true(follow_up.number == BUS_MASTER_TRACKER);
    assert_int_equal(sync.counter, counter);
    assert_int_equal(follow_up.counter, counter);
    return (int64_t)follow_up.time_us;
}

static void test_pairs_are_sent_when_due(void **state)
{
    (void)state;
    wire_t wire = open_wire();
    hal_can_frame_t frame;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    sync_send_t sync = {.due_us = 0};
    for (int n = 0; n < 32; n++) {
        const int64_t before_us = sim_clock_monotonic_us();
        assert_true(sync_send(&sync, &wire.link, error));
        const int64_t time_us = hear_pair(&wire, n % CAN_E2E_P01_COUNTERS);
        assert_in_range(time_us, before_us, sim_clock_monotonic_us());
        assert_in_range(sync.due_us, before_us + 125000, time_us + 125000);
        sync.due_us = INT64_MAX;
        assert_true(sync_send(&sync, &wire.link, error));
        assert_false(hear(&wire, &frame));
        sync.due_us = sim_clock_monotonic_us();
    }
    close_wire(&wire);
}

static void test_a_broken_link_is_told(void **state)
{
    (void)state;
    wire_t wire = open_wire();
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    sync_send_t sync = {.due_us = 0};
    signal(SIGPIPE, SIG_IGN);
    close(wire.heard);
    assert_false(sync_send(&sync, &wire.link, error));
    assert_non_null(strstr(error, "wire"));
    pose_link_close(&wire.link);
}

/* @return Pairs among what was heard; poses must be whole. */
static int count_pairs(const wire_t *wire, int *poses)
{
    hal_can_frame_t frame;
    can_sync_t sync;
    can_follow_up_t follow_up;
    int pairs = 0, parts = 0;
    while (hear(wire, &frame)) {
        if (can_sync_decode(&sync, &frame) == CAN_CHECK_OK) {
            assert_true(hear(wire, &frame));
            assert_int_equal(can_follow_up_decode(&follow_up, &frame), CAN_CHECK_OK);
            pairs++;
        } else {
            parts++;
        }
    }
    *poses = parts / CAN_POSE_PARTS;
    return pairs;
}

static void test_a_list_is_sent_with_time_when_asked_for(void **state)
{
    (void)state;
    const pose_t pose = {.quaternion_q30 = {1 << 30, 0, 0, 0}};
    pose_list_entry_t entry[2] = {{0, pose}, {LIST_US, pose}};
    const pose_list_t list = {entry, 2};
    const volatile sig_atomic_t going_on = 0;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    for (int with_time = 0; with_time < 2; with_time++) {
        wire_t wire = open_wire();
        size_t sent = 0;
        int poses = 0;
        const pose_send_t send = {.list = &list, .stop = &going_on, .sync = with_time == 1};
        assert_true(pose_send_list(&wire.link, &send, &sent, error));
        const int pairs = count_pairs(&wire, &poses);
        assert_int_equal(poses, 2);
        assert_true(with_time == 1 ? pairs >= 2 && pairs <= 3 : pairs == 0);
        close_wire(&wire);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs_are_sent_when_due),
        cmocka_unit_test(test_a_broken_link_is_told),
        cmocka_unit_test(test_a_list_is_sent_with_time_when_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
