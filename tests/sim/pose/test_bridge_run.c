// SPDX-License-Identifier: Apache-2.0
// End to end: a tracker's UDP packet, the bridge, the simulator's bus over socketcand, and the pose that a board
// decodes.
#include "sim/pose/bridge_run.h"

#include <arpa/inet.h>
#include <math.h>
#include <netinet/in.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"
#include "sim/pose/udp_listen.h"
#include "tests/support/socketcand_bench.h"
#include "tests/support/tracker_packets.h"

enum { PATIENCE_US = 20000000 };

/* The bridge in a thread, between a socket of its own and the bench's bus. */
typedef struct {
    bridge_t bridge;
    bridge_run_t run;
    pose_link_t link;
    char bus[32], error[POSE_LINK_MESSAGE_LENGTH];
    int port;
    volatile sig_atomic_t stop;
    bool good;
    pthread_t thread;
} rig_t;

static rig_t rig;

static void *run_rig(void *context)
{
    (void)context;
    if (!pose_link_open(&rig.link, rig.bus, false, rig.error))
        return NULL;
    rig.good = bridge_run(&rig.run, rig.error);
    pose_link_close(&rig.link);
    return NULL;
}

static void start(const socketcand_bench_t *bench, const char *protocol, const char *transform_path, bool sync)
{
    tracker_transform_t transform;
    char error[ROOM_MESSAGE_LENGTH];
    memset(&rig, 0, sizeof rig);
    assert_true(tracker_transform_load(&transform, transform_path, error));
    bridge_init(&rig.bridge, tracker_protocol_named(protocol), &transform);
    const int listener = udp_listen_open("127.0.0.1:0", NULL, &rig.port, rig.error);
    assert_true(listener >= 0);
    rig.run =
        (bridge_run_t){.bridge = &rig.bridge, .link = &rig.link, .listener = listener, .sync = sync, .stop = &rig.stop};
    snprintf(rig.bus, sizeof rig.bus, "127.0.0.1:%d", socketcand_server_port(bench->server));
    assert_int_equal(pthread_create(&rig.thread, NULL, run_rig, NULL), 0);
}

static void stop(const socketcand_bench_t *bench)
{
    rig.stop = 1;
    /* the link waits until the server has read everything */
    while (pthread_tryjoin_np(rig.thread, NULL) != 0)
        socketcand_bench_turn(bench, 1);
    close(rig.run.listener);
    if (!rig.good)
        fail_msg("%s", rig.error);
}

static void send_packet(const tracker_bytes_t *packet)
{
    const int sender = socket(AF_INET, SOCK_DGRAM, 0);
    const struct sockaddr_in to = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)rig.port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(sendto(sender, packet->bytes, packet->size, 0, (const struct sockaddr *)&to, sizeof to),
                     packet->size);
    close(sender);
}

/* The next set of a viewer that the bench's board hears. */
static can_pose_t hear_pose(const socketcand_bench_t *bench, uint8_t viewer)
{
    hal_can_frame_t part[CAN_POSE_PARTS];
    const int64_t end_us = sim_clock_monotonic_us() + PATIENCE_US;
    for (int heard = 0; heard < CAN_POSE_PARTS;) {
        if (sim_clock_monotonic_us() > end_us)
            fail_msg("no pose has come: %s", rig.error);
        socketcand_bench_turn(bench, 1);
        if (hal_can_receive(bench->board, &part[heard]) == HAL_OK)
            heard++;
    }
    can_pose_t pose;
    assert_int_equal(can_pose_set_decode(&pose, part, viewer), CAN_CHECK_OK);
    return pose;
}

static void test_a_packet_becomes_a_pose_on_the_bus(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    const uint64_t before_us = (uint64_t)sim_clock_monotonic_us();
    start(&bench, "freed", "sim/trackers/examples/freed.yaml", false);
    uint8_t counter = 0;
    for (int n = 0; n < 20; n++) {
        const tracker_bytes_t packet =
            tracker_bytes_freed(1, (const double[3]){90, 0, 0}, (const double[3]){1000 + n, 2000, 1700});
        send_packet(&packet);
        const can_pose_t pose = hear_pose(&bench, 0);
        assert_int_equal(pose.pose.eye_nm[0], (1080 + n) * INT64_C(1000000));
        assert_int_equal(pose.pose.eye_nm[1], -1580000000);
        assert_int_equal(pose.pose.eye_nm[2], 1500000000);
        for (int i = 0; i < 4; i++)
            assert_true(fabs(pose.pose.quaternion_q30[i] / 1073741824.0 - (i % 2 == 0 ? 0.7071068 : 0)) < 1e-4);
        assert_int_equal(pose.quality, CAN_POSE_TRACKED);
        if (n > 0)
            assert_int_equal(pose.counter, (counter + 1) % CAN_E2E_P01_COUNTERS);
        counter = pose.counter;
        const uint64_t now_us = (uint64_t)sim_clock_monotonic_us();
        const uint64_t since_us =
            (pose.capture_time_us + CAN_POSE_SET_WRAP_US - before_us % CAN_POSE_SET_WRAP_US) % CAN_POSE_SET_WRAP_US;
        assert_true(since_us <= now_us - before_us + 100);
    }
    stop(&bench);
    assert_int_equal(rig.run.sent, 20);
    assert_int_equal(rig.bridge.counts.packets, 20);
    socketcand_bench_end(&bench);
}

/* Sync and FollowUp, when nothing comes from the tracker: of one counter, and on this machine's clock. */
static void test_bus_time_is_given(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    start(&bench, "freed", "sim/trackers/examples/freed.yaml", true);
    const int64_t end_us = sim_clock_monotonic_us() + PATIENCE_US;
    int pairs = 0, counter = -1;
    while (pairs < 3) {
        hal_can_frame_t frame;
        can_sync_t sync;
        can_follow_up_t follow_up;
        if (sim_clock_monotonic_us() > end_us)
            fail_msg("no bus time has come: %s", rig.error);
        socketcand_bench_turn(&bench, 1);
        if (hal_can_receive(bench.board, &frame) != HAL_OK)
            continue;
        if (can_sync_decode(&sync, &frame) == CAN_CHECK_OK) {
            assert_true(counter < 0 || sync.counter == (counter + 1) % CAN_E2E_P01_COUNTERS);
            counter = sync.counter;
            continue;
        }
        assert_int_equal(can_follow_up_decode(&follow_up, &frame), CAN_CHECK_OK);
        assert_int_equal(follow_up.counter, counter);
        assert_true(follow_up.time_us <= (uint64_t)sim_clock_monotonic_us());
        pairs++;
    }
    stop(&bench);
    socketcand_bench_end(&bench);
}

static void test_two_viewers_have_counters_of_their_own(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    start(&bench, "dtrack", "sim/trackers/examples/dtrack.yaml", false);
    uint8_t counter[2] = {0, 0};
    for (int n = 0; n < 3; n++) {
        char text[256];
        tracker_bytes_t packet = {.size = 0};
        snprintf(text, sizeof text,
                 "fr %d\nts %d.5\n6d 2 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1][3 1][4 5 6 0 0 0]"
                 "[1 0 0 0 1 0 0 0 1]\n",
                 n, n);
        tracker_bytes_add(&packet, text, strlen(text));
        send_packet(&packet);
        for (uint8_t viewer = 0; viewer < 2; viewer++) {
            const can_pose_t pose = hear_pose(&bench, viewer);
            if (n > 0)
                assert_int_equal(pose.counter, (counter[viewer] + 1) % CAN_E2E_P01_COUNTERS);
            counter[viewer] = pose.counter;
        }
    }
    stop(&bench);
    assert_int_equal(rig.run.sent, 6);
    socketcand_bench_end(&bench);
}

/* A set reaches 83.886 m; a wrong packet in between harms nothing. */
static void test_what_cannot_be_sent_is_counted(void **state)
{
    (void)state;
    const socketcand_bench_t bench = socketcand_bench_begin();
    start(&bench, "freed", "sim/trackers/examples/freed.yaml", false);
    tracker_bytes_t packet = tracker_bytes_freed(1, (const double[3]){0, 0, 0}, (const double[3]){90000, 0, 0});
    send_packet(&packet);
    packet.bytes[2] ^= 1;
    send_packet(&packet);
    packet.size = 0;
    send_packet(&packet);
    packet = tracker_bytes_freed(1, (const double[3]){0, 0, 0}, (const double[3]){5, 0, 0});
    send_packet(&packet);
    assert_int_equal(hear_pose(&bench, 0).pose.eye_nm[0], 5000000);
    stop(&bench);
    assert_int_equal(rig.run.sent, 1);
    assert_int_equal(rig.bridge.counts.too_far, 1);
    assert_int_equal(rig.bridge.counts.refused[TRACKER_CHECKSUM], 1);
    assert_int_equal(rig.bridge.counts.refused[TRACKER_LENGTH], 1);
    socketcand_bench_end(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_packet_becomes_a_pose_on_the_bus),
        cmocka_unit_test(test_bus_time_is_given),
        cmocka_unit_test(test_two_viewers_have_counters_of_their_own),
        cmocka_unit_test(test_what_cannot_be_sent_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
