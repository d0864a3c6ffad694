// SPDX-License-Identifier: Apache-2.0
// Tests of the bus time that a sender of poses gives: pairs of Sync and FollowUp on this machine's clock.
#include <arpa/inet.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cmocka.h>

#include "firmware/bus_master.h"
#include "sim/devices/sim_clock.h"
#include "sim/pose/pose_send.h"
#include "sim/pose/sync_send.h"

enum { LIST_US = 300000, WAIT_US = 30000 };

/* A link as to a SocketCAN interface, and its other end: two UDP sockets, which the kernel stamps likewise. */
typedef struct {
    pose_link_t link;
    int heard;
} wire_t;

/* What of SocketCAN such sockets lack. */
static struct {
    bool recv_own;
    struct can_filter filter;
    bool confirms; /* what comes is the interface's own */
} can;

int setsockopt(int socket, int level, int option, const void *value, socklen_t size)
{
    if (level != SOL_CAN_RAW)
        return (int)syscall(SYS_setsockopt, socket, level, option, value, size);
    if (option == CAN_RAW_RECV_OWN_MSGS)
        can.recv_own = true;
    if (option == CAN_RAW_FILTER)
        memcpy(&can.filter, value, sizeof can.filter);
    return 0;
}

ssize_t recvmsg(int socket, struct msghdr *message, int flags)
{
    const ssize_t got = syscall(SYS_recvmsg, socket, message, flags);
    if (got > 0 && can.confirms)
        message->msg_flags |= MSG_CONFIRM;
    return got;
}

static wire_t open_wire(void)
{
    int end[2];
    struct sockaddr_in address[2];
    for (int i = 0; i < 2; i++) {
        socklen_t size = sizeof address[i];
        address[i] = (struct sockaddr_in){.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
        end[i] = socket(AF_INET, SOCK_DGRAM, 0);
        assert_int_equal(bind(end[i], (const struct sockaddr *)&address[i], size), 0);
        assert_int_equal(getsockname(end[i], (struct sockaddr *)&address[i], &size), 0);
    }
    for (int i = 0; i < 2; i++)
        assert_int_equal(connect(end[i], (const struct sockaddr *)&address[1 - i], sizeof address[i]), 0);
    can.recv_own = false;
    can.confirms = true;
    return (wire_t){.link = {.socket = end[0], .name = "wire"}, .heard = end[1]};
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

/* What the interface hands back once a Sync is sent; here even before that. */
static void echo(const wire_t *wire, int counter)
{
    hal_can_frame_t frame;
    const can_sync_t sync = {.number = BUS_MASTER_TRACKER, .counter = (uint8_t)counter, .origin = BUS_MASTER_TRACKER};
    assert_true(can_sync_encode(&frame, &sync));
    struct can_frame raw = {.can_id = frame.id, .can_dlc = frame.length};
    memcpy(raw.data, frame.data, frame.length);
    assert_int_equal(send(wire->heard, &raw, sizeof raw, 0), sizeof raw);
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
    sync_send_t sync = {.auth = NULL};
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

static void test_an_interface_tells_when_a_sync_was_out(void **state)
{
    (void)state;
    wire_t wire = open_wire();
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    sync_send_t sync = {.auth = NULL};
    assert_true(sync_send_begin(&sync, &wire.link, error));
    assert_true(can.recv_own && can.filter.can_id == CAN_ID_SYNC && (can.filter.can_mask & 0x7FF) == 0x7FF);
    bool stamped = false;
    /* The kernel begins to stamp a moment after it is asked to: until then the time of taking is all there is. */
    for (int n = 0; n < 50 && !stamped; n++) {
        const int64_t before_us = sim_clock_monotonic_us();
        echo(&wire, n % CAN_E2E_P01_COUNTERS);
        usleep(WAIT_US); /* which must not show */
        sync.due_us = 0;
        assert_true(sync_send(&sync, &wire.link, error));
        const int64_t time_us = hear_pair(&wire, n % CAN_E2E_P01_COUNTERS);
        assert_true(time_us >= before_us - 1000);
        stamped = time_us <= sim_clock_monotonic_us() - WAIT_US + 1000;
    }
    assert_true(stamped);
    close_wire(&wire);
}

/* Sync n alone, and then the next is due. */
static void hear_alone(const wire_t *wire, sync_send_t *sync, int counter)
{
    hal_can_frame_t frame;
    can_sync_t heard;
    assert_true(hear(wire, &frame));
    assert_int_equal(can_sync_decode(&heard, &frame), CAN_CHECK_OK);
    assert_int_equal(heard.counter, counter);
    assert_false(hear(wire, &frame));
    assert_true(sync->due_us > 0);
    sync->due_us = 0;
}

static void test_a_sync_that_is_not_out_has_no_follow_up(void **state)
{
    (void)state;
    wire_t wire = open_wire();
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    sync_send_t sync = {.auth = NULL};
    assert_true(sync_send_begin(&sync, &wire.link, error));
    assert_true(sync_send(&sync, &wire.link, error));
    hear_alone(&wire, &sync, 0); /* the bus is taken */
    can.confirms = false;
    echo(&wire, 1);
    assert_true(sync_send(&sync, &wire.link, error));
    hear_alone(&wire, &sync, 1); /* that was another's Sync */
    can.confirms = true;
    echo(&wire, 0);
    assert_true(sync_send(&sync, &wire.link, error));
    hear_alone(&wire, &sync, 2); /* an old one */
    echo(&wire, 1);
    echo(&wire, 3);
    assert_true(sync_send(&sync, &wire.link, error));
    (void)hear_pair(&wire, 3);
    close_wire(&wire);
}

static void test_a_broken_link_is_told(void **state)
{
    (void)state;
    wire_t wire = open_wire();
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    sync_send_t sync = {.auth = NULL};
    close(wire.link.socket);
    assert_false(sync_send(&sync, &wire.link, error));
    assert_non_null(strstr(error, "wire"));
    assert_false(sync_send_begin(&sync, &wire.link, error));
    close(wire.heard);
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
        for (int n = 0; n < 4; n++)
            echo(&wire, n);
        int poses = 0;
        const pose_send_t send = {.list = &list, .stop = &going_on, .sync = with_time == 1};
        assert_true(pose_send_list(&wire.link, &send, &sent, error));
        const int pairs = count_pairs(&wire, &poses);
        assert_int_equal(poses, 2);
        assert_int_equal(can.recv_own, with_time);
        assert_true(with_time == 1 ? pairs >= 2 && pairs <= 3 : pairs == 0);
        close_wire(&wire);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs_are_sent_when_due),
        cmocka_unit_test(test_an_interface_tells_when_a_sync_was_out),
        cmocka_unit_test(test_a_sync_that_is_not_out_has_no_follow_up),
        cmocka_unit_test(test_a_broken_link_is_told),
        cmocka_unit_test(test_a_list_is_sent_with_time_when_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
