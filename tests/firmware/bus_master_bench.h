// SPDX-License-Identifier: Apache-2.0
// Nodes that agree on bus time, on a simulated bus: each with a clock of its own and late stamps, stepping at 60 Hz.
#ifndef TESTS_FIRMWARE_BUS_MASTER_BENCH_H
#define TESTS_FIRMWARE_BUS_MASTER_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "firmware/bus_receive.h"
#include "sim/bus/sim_bus.h"
#include "sim/devices/sim_clock.h"
#include "tests/support/rng.h"

enum { STEP_US = 16667, JITTER_US = 200, DRIFT_PPB = 50000, MAX_NODES = 9, START_US = 1000000, LOCK_S = 25 };

typedef struct {
    hal_can_t *can;
    hal_time_t *clock;
    can_poses_t poses;
    bus_master_t time;
    can_faults_t faults;
    bool absent; /* takes no steps */
} node_t;

typedef struct {
    uint64_t seed;
    sim_bus_t *bus;
    int count;
    node_t node[MAX_NODES];
    int64_t now_us;    /* of the world */
    int64_t worst_us;  /* largest disagreement since it was set to 0, of nodes that know bus time */
    bool was_any;      /* somebody knew bus time in the step before: */
    int64_t before_us; /* what it was then, of the world's time */
    int64_t jump_us;   /* largest change of that in a step since it was set to 0 */
} bench_t;

static inline int64_t bench_stamp(void *context, int64_t time_us)
{
    return sim_clock_shows_us(context, time_us);
}

static inline node_t *bench_add(bench_t *b, uint8_t number, rng_t *rng)
{
    char error[FILE_ERROR_LENGTH] = "";
    node_t *node = &b->node[b->count++];
    const sim_clock_settings_t clock = {.epoch_us = START_US,
                                        .offset_us = (int64_t)(rng_next(rng) % 1000000000),
                                        .drift_ppb = (int32_t)(rng_next(rng) % (2 * DRIFT_PPB + 1)) - DRIFT_PPB};
    node->can = sim_bus_attach(b->bus);
    node->clock = sim_clock_create(&clock, error);
    assert_string_equal(error, "");
    sim_clock_set_us(node->clock, b->now_us);
    sim_can_set_stamps(node->can, bench_stamp, node->clock, JITTER_US);
    bus_master_init(&node->time, number, hal_time_now_us(node->clock));
    return node;
}

static inline void bench_open(bench_t *b, uint64_t seed, const uint8_t *numbers, int count)
{
    const sim_bus_config_t config = {
        .bitrate = 500000, .data_bitrate = 2000000, .fd = true, .seed = seed, .start_us = START_US};
    rng_t rng = {seed};
    *b = (bench_t){.seed = seed, .bus = sim_bus_create(&config), .now_us = START_US};
    for (int i = 0; i < count; i++)
        bench_add(b, numbers[i], &rng);
}

static inline void bench_close(bench_t *b)
{
    for (int i = 0; i < b->count; i++)
        sim_clock_destroy(b->node[i].clock);
    sim_bus_destroy(b->bus);
}

static inline int64_t local_now(const bench_t *b, int i)
{
    return hal_time_now_us(b->node[i].clock);
}

static inline can_time_state_t state_of(const bench_t *b, int i)
{
    return bus_master_state(&b->node[i].time, local_now(b, i));
}

static inline int64_t bus_time_of(const bench_t *b, int i)
{
    return bus_time_from_local(&b->node[i].time.time, local_now(b, i));
}

/* How far apart are the nodes that know bus time, and did it go on smoothly? */
static inline void bench_compare(bench_t *b)
{
    int64_t least = INT64_MAX, most = INT64_MIN;
    for (int i = 0; i < b->count; i++) {
        if (b->node[i].absent || state_of(b, i) == CAN_TIME_NONE)
            continue;
        const int64_t time_us = bus_time_of(b, i);
        least = time_us < least ? time_us : least;
        most = time_us > most ? time_us : most;
    }
    const bool any = least <= most;
    if (any && most - least > b->worst_us)
        b->worst_us = most - least;
    const int64_t ahead_us = any ? least - b->now_us : 0;
    if (any && b->was_any && llabs(ahead_us - b->before_us) > b->jump_us)
        b->jump_us = llabs(ahead_us - b->before_us);
    b->was_any = any;
    b->before_us = ahead_us;
}

/* All nodes step once. */
static inline void bench_step(bench_t *b)
{
    b->now_us += STEP_US;
    sim_bus_advance(b->bus, b->now_us);
    for (int i = 0; i < b->count; i++) {
        node_t *node = &b->node[i];
        sim_clock_set_us(node->clock, b->now_us);
        if (node->absent)
            continue;
        bus_receive(&(bus_receivers_t){.poses = &node->poses, .time = &node->time, .faults = &node->faults}, node->can);
        bus_master_step(&node->time, node->can, local_now(b, i));
    }
    bench_compare(b);
}

static inline void bench_run(bench_t *b, int64_t milliseconds)
{
    for (const int64_t until_us = b->now_us + milliseconds * 1000; b->now_us < until_us;)
        bench_step(b);
}

static inline void bench_measure_anew(bench_t *b)
{
    b->worst_us = b->jump_us = 0;
}

/* Everybody who steps follows this node, which is the master; and they have agreed since bench_measure_anew(). */
static inline void check_master(const bench_t *b, int master)
{
    for (int i = 0; i < b->count; i++) {
        const can_time_state_t expected = i == master ? CAN_TIME_OWN : CAN_TIME_LOCKED;
        if (b->node[i].absent)
            continue;
        if (state_of(b, i) != expected || b->node[i].time.master != b->node[master].time.number)
            fail_msg("seed %llu: node %d is in state %d and has master %d, expected state %d and master %d",
                     (unsigned long long)b->seed, b->node[i].time.number, (int)state_of(b, i), b->node[i].time.master,
                     (int)expected, b->node[master].time.number);
    }
    if (b->worst_us > 100)
        fail_msg("seed %llu: bus times are %lld us apart", (unsigned long long)b->seed, (long long)b->worst_us);
}

#endif
