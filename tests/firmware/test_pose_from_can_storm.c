// SPDX-License-Identifier: Apache-2.0
// Property test of the pose receiver: sets lost, repeated, delayed and mixed never yield a pose that was not sent.
#include "tests/firmware/pose_bench.h"

/* Every frame is lost, sent twice, delayed or let through at random; sometimes the bus is dead for a while. */
typedef struct {
    int lose, repeat, delay; /* per cent of the frames */
    int dead;                /* per cent of the sets that begin a dead time of up to 20 sets */
} weather_t;

enum { SETS = 400, DELAYED = 16 };

typedef struct {
    hal_can_frame_t frame[DELAYED];
    int due_set[DELAYED];
    int count;
} delayed_t;

static int percent(bench_t *bench)
{
    return (int)rng_int(&bench->rng, 0, 99);
}

static void send_delayed(bench_t *bench, delayed_t *delayed, int set)
{
    int kept = 0;
    for (int i = 0; i < delayed->count; i++) {
        if (delayed->due_set[i] <= set) {
            queue(bench, &delayed->frame[i]);
        } else {
            delayed->frame[kept] = delayed->frame[i];
            delayed->due_set[kept++] = delayed->due_set[i];
        }
    }
    delayed->count = kept;
}

static void send_through(bench_t *bench, const weather_t *weather, delayed_t *delayed, const hal_can_frame_t *frame,
                         int set)
{
    const int copies = percent(bench) < weather->repeat ? 2 : 1;
    for (int i = 0; i < copies; i++) {
        if (percent(bench) < weather->lose)
            continue;
        if (percent(bench) < weather->delay && delayed->count < DELAYED) {
            delayed->frame[delayed->count] = *frame;
            delayed->due_set[delayed->count++] = set + (int)rng_int(&bench->rng, 0, 2);
        } else {
            queue(bench, frame);
        }
    }
}

/* Every bit of the pose must be that of one sent set, and sets must never come again or go back. */
static int which_was_sent(const bench_t *bench, const can_pose_t *sent, int from, int to)
{
    for (int i = from; i < to; i++)
        if (memcmp(&bench->poses.newest.pose, &sent[i].pose, sizeof sent[i].pose) == 0 &&
            bench->poses.newest.capture_time_us == sent[i].capture_time_us &&
            bench->poses.newest.counter == sent[i].counter)
            return i;
    return -1;
}

static int run_storm(const weather_t *weather, uint64_t seed)
{
    static can_pose_t sent[SETS];
    bench_t bench = new_bench();
    bench.rng.state = seed;
    delayed_t delayed = {.count = 0};
    int newest = -1;
    int used = 0;
    int dead_until = 0;
    for (int set = 0; set < SETS; set++) {
        hal_can_frame_t part[CAN_POSE_PARTS];
        sent[set] = pose_number(&bench, set % CAN_E2E_P01_COUNTERS);
        make_set(part, &sent[set]);
        if (percent(&bench) < weather->dead)
            dead_until = set + (int)rng_int(&bench.rng, 0, 19);
        const int first = (int)rng_int(&bench.rng, 0, CAN_POSE_PARTS - 1);
        for (int i = 0; i < CAN_POSE_PARTS; i++) {
            if (i == 1)
                send_delayed(&bench, &delayed, set);
            if (set >= dead_until || i < first)
                send_through(&bench, weather, &delayed, &part[i], set);
        }
        bench.time_us = 1000000 + (set + 1) * POSE_PERIOD_US;
        const int64_t received_us = bench.poses.received_us;
        receive(&bench);
        if (bench.poses.received_us == received_us)
            continue;
        newest = which_was_sent(&bench, sent, newest + 1, set + 1);
        if (newest < 0)
            fail_msg("seed %llu, set %d: a pose that was not sent, or one again, or an older one",
                     (unsigned long long)seed, set);
        used++;
    }
    return used;
}

static void test_no_weather_ever_yields_a_mixed_pose(void **state)
{
    (void)state;
    static const weather_t WEATHER[] = {
        {0, 0, 0, 0},  {20, 0, 0, 0},    {0, 50, 0, 0},   {0, 0, 30, 0},   {30, 30, 30, 0},
        {0, 0, 0, 10}, {10, 10, 10, 10}, {60, 60, 60, 5}, {50, 0, 50, 20},
    };
    for (size_t i = 0; i < sizeof WEATHER / sizeof WEATHER[0]; i++)
        for (uint64_t seed = 1; seed <= 10; seed++) {
            const int used = run_storm(&WEATHER[i], 1000 * i + seed);
            if (i == 0)
                assert_int_equal(used, SETS);
            assert_true(used > 0);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_weather_ever_yields_a_mixed_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
