// SPDX-License-Identifier: Apache-2.0
// The load of a whole room's bus, all messages of 8 boards and a tracker: counted by the bus and by wallwarp-pose's
// watch, against the sum of the frames sent, each built bit by bit by the oracle; and against what BUS.md says of each
// message.
#include <math.h>

#include "firmware/can_counts.h"
#include "sim/pose/bus_watch.h"
#include "tests/firmware/agreement_bench.h"
#include "tests/support/can_bits_oracle.h"

enum { SECONDS = 20, LEAST_BITS = 111, MOST_BITS = 135 };
enum { FD_LEAST_BITS = 29, FD_MOST_BITS = 31, FD_LEAST_DATA_BITS = 294, FD_MOST_DATA_BITS = 359 };

/* The messages, by their identifiers: base + node, viewer or part. */
static const struct {
    const char *name;
    uint32_t first, last;
    double per_s;     /* of all boards */
    bool classic, fd; /* on which bus */
} MESSAGE[] = {
    {"Sync", 0x40, 0x7F, 8, true, true},           {"FollowUp", 0x80, 0xBF, 8, true, true},
    {"Pose", 0x100, 0x103, POSES_HZ, false, true}, {"PoseSet", 0x110, 0x112, 3 * POSES_HZ, true, false},
    {"FrameClock", 0x141, 0x17F, 30, true, true},  {"Status", 0x401, 0x43F, 80, true, true},
    {"Stage", 0x441, 0x47F, 32, true, true},       {"Quality", 0x481, 0x4BF, 8, true, true},
    {"Time", 0x4C1, 0x4FF, 8, true, true},         {"Step", 0x501, 0x53F, 80, true, true},
    {"Latency", 0x541, 0x57F, 8, true, true},      {"Counts", 0x5C1, 0x5FF, 8, true, true},
    {"Update", 0x681, 0x6BF, 8, true, true},       {"Heartbeat", 0x701, 0x73F, 16, true, true},
};

enum { MESSAGES = sizeof MESSAGE / sizeof MESSAGE[0] };

typedef struct {
    const room_t *room;
    bus_watch_t watch;
    double exact_us; /* that the frames take */
    int64_t frames[MESSAGES];
} log_t;

static int message_of(const hal_can_frame_t *frame)
{
    for (int m = 0; m < MESSAGES; m++)
        if (frame->id >= MESSAGE[m].first && frame->id <= MESSAGE[m].last)
            return m;
    fail_msg("a frame that BUS.md does not have: %03X", (unsigned)frame->id);
    return 0;
}

static void note(void *context, int sender, const hal_can_frame_t *frame)
{
    (void)sender;
    log_t *log = context;
    const sim_can_bits_t bits = can_bits_oracle(frame);
    assert_in_range(bits.arbitration, frame->fd ? FD_LEAST_BITS : LEAST_BITS, frame->fd ? FD_MOST_BITS : MOST_BITS);
    assert_in_range(bits.data, frame->fd ? FD_LEAST_DATA_BITS : 0, frame->fd ? FD_MOST_DATA_BITS : 0);
    log->frames[message_of(frame)]++;
    log->exact_us += bits.arbitration * 1e6 / log->room->bitrate + bits.data * 1e6 / log->room->data_bitrate;
    bus_watch_take(&log->watch, frame);
}

static void assert_near(const char *what, bool classic, double found, double exact)
{
    printf("%s, %s: %.3f %%, exactly %.3f %%\n", classic ? "classic" : "FD", what, found * 100, exact * 100);
    if (!(fabs(found - exact) <= exact / 100))
        fail_msg("%s: load %.4f %%, expected %.4f %% within 1 %% of it", what, found * 100, exact * 100);
}

static void check_room(bool classic)
{
    static bench_t b;
    static log_t log;
    log = (log_t){.room = &b.room};
    bench_open_with(&b, START_S + SECONDS + 1, &(bench_settings_t){.classic = classic});
    run(&b, START_S * HZ);
    bus_watch_init(&log.watch, b.room.bitrate, b.room.data_bitrate);
    sim_bus_t *bus = sim_world_bus(b.world);
    const sim_bus_stats_t before = sim_bus_stats(bus);
    sim_bus_set_log(bus, note, &log);
    run(&b, SECONDS * HZ);
    const sim_bus_stats_t after = sim_bus_stats(bus);
    const double elapsed_us = (double)(after.elapsed_ns - before.elapsed_ns) / 1e3, exact = log.exact_us / elapsed_us;
    assert_near("by the bus", classic, (double)(after.busy_ns - before.busy_ns) / 1e3 / elapsed_us, exact);
    assert_near("by the watch", classic, log.watch.busy_us / (double)(log.watch.last_us - log.watch.first_us), exact);
    assert_in_range(log.watch.load_ppm, exact * 0.95e6, exact * 1.05e6); /* of one second */
    assert_int_equal(log.watch.unknown + log.watch.damaged, 0);
    for (int m = 0; m < MESSAGES; m++) {
        const double expected = (classic ? MESSAGE[m].classic : MESSAGE[m].fd) ? MESSAGE[m].per_s * SECONDS : 0;
        const double frames = (double)log.frames[m]; /* some are sent at the first blank after their time */
        if (frames > expected * 1.02 || frames < expected * 0.85)
            fail_msg("%s: %.0f frames in %d s, expected at most %.0f", MESSAGE[m].name, frames, SECONDS, expected);
    }
    bench_close(&b);
}

static void test_load_is_that_of_the_frames_sent(void **state)
{
    (void)state;
    check_room(false);
    check_room(true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_load_is_that_of_the_frames_sent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
