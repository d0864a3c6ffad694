// SPDX-License-Identifier: Apache-2.0
// Tests of bus time in whole projectors: eight boards with clocks of their own, whose master is lost, twice.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"
#include "sim/run/sim_world.h"
#include "tests/support/small_room.h"

enum { BOARDS = 8, HZ = 60, LOCK_S = 25, SEED = 5 };

static const sim_rate_t REFRESH = {8333, HZ, 1};

typedef struct {
    room_t room;
    video_t *video;
    sim_world_t *world;
    int64_t step;
    int64_t worst_us;        /* largest disagreement of boards that know bus time */
    int unplugged;           /* boards 0 to this one less are */
    can_time_t said[BOARDS]; /* the newest message of each */
    int messages[BOARDS];
} bench_t;

static void listen(void *context, int sender, const hal_can_frame_t *frame)
{
    bench_t *b = context;
    can_time_t time;
    if (can_time_decode(&time, frame) != CAN_CHECK_OK)
        return;
    assert_int_equal(time.node, sender + 1);
    assert_true(b->messages[sender] == 0 || time.counter != b->said[sender].counter);
    b->said[sender] = time;
    b->messages[sender]++;
}

static void bench_open(bench_t *b, const sim_world_clocks_t *clocks)
{
    char error[FILE_ERROR_LENGTH] = "";
    memset(b, 0, sizeof *b);
    small_room_load(&b->room, &(small_room_t){.boards = BOARDS, .nodes_apart = 1, .viewers = true});
    b->video = video_open("pattern", 96, 54, error);
    assert_string_equal(error, "");
    const sim_world_config_t config = {
        .room = &b->room, .video = b->video, .refresh = REFRESH, .seed = SEED, .clocks = *clocks};
    b->world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    sim_bus_set_log(sim_world_bus(b->world), listen, b);
}

static void bench_close(bench_t *b)
{
    sim_world_destroy(b->world);
    video_close(b->video);
}

static int64_t local_now(const bench_t *b, int board)
{
    return hal_time_now_us(sim_world_devices(b->world, board)->clock);
}

static const bus_master_t *time_of(const bench_t *b, int board)
{
    return &sim_world_projector(b->world, board)->time;
}

static can_time_state_t state_of(const bench_t *b, int board)
{
    return bus_master_state(time_of(b, board), local_now(b, board));
}

static void run(bench_t *b, int seconds)
{
    char error[FILE_ERROR_LENGTH];
    for (const int64_t until = b->step + seconds * HZ; b->step < until; b->step++) {
        int64_t least = INT64_MAX, most = INT64_MIN;
        assert_true(sim_world_step(b->world, sim_rate_time_us(&REFRESH, b->step), error));
        for (int i = b->unplugged; i < BOARDS; i++) {
            if (state_of(b, i) == CAN_TIME_NONE)
                continue;
            const int64_t now_us = bus_time_from_local(&time_of(b, i)->time, local_now(b, i));
            least = now_us < least ? now_us : least;
            most = now_us > most ? now_us : most;
        }
        if (least <= most && most - least > b->worst_us)
            b->worst_us = most - least;
    }
}

/* All boards but the lost ones follow this one, and say so. */
static void check_agreement(const bench_t *b, int master)
{
    for (int i = master; i < BOARDS; i++) {
        const can_time_t *said = &b->said[i];
        const can_time_state_t expected = i == master ? CAN_TIME_OWN : CAN_TIME_LOCKED;
        if (state_of(b, i) != expected || said->state != expected || said->master != master + 1 ||
            said->error_us > 105 || said->changes != (uint32_t)master || said->relocks != 0)
            fail_msg("seed %d, board %d: state %d, said %d, master %d, error %u us, %u changes, %u relocks", SEED,
                     i + 1, (int)state_of(b, i), (int)said->state, said->master, said->error_us, said->changes,
                     said->relocks);
    }
    if (b->worst_us > 100)
        fail_msg("seed %d: bus times are %lld us apart", SEED, (long long)b->worst_us);
}

static void test_eight_boards_agree_through_two_losses_of_the_master(void **state)
{
    (void)state;
    static bench_t b;
    const sim_world_clocks_t clocks = {.offset_us = 3600000000, .drift_ppb = 50000, .jitter_us = 200};
    bench_open(&b, &clocks);
    run(&b, LOCK_S);
    check_agreement(&b, 0);
    for (int lost = 0; lost < 2; lost++) {
        sim_bus_fail_unplug(sim_world_devices(b.world, lost)->can);
        b.unplugged = lost + 1;
        run(&b, 3);
        check_agreement(&b, lost + 1);
        run(&b, 27);
        check_agreement(&b, lost + 1);
    }
    for (int lost = 0; lost < 2; lost++)
        sim_bus_replug(sim_world_devices(b.world, lost)->can);
    run(&b, 10); /* 30 s and 60 s away they are off by more, and come back slowly */
    check_agreement(&b, 2);
    for (int i = 0; i < 2; i++)
        assert_true(state_of(&b, i) == CAN_TIME_LOCKED && b.said[i].master == 3);
    for (int i = 2; i < BOARDS; i++)
        assert_in_range(b.messages[i], 94, 97);
    bench_close(&b);
}

/* Each board says by how much its clock is fast against the master's. */
static void test_the_drift_that_is_said_is_the_clocks(void **state)
{
    (void)state;
    static bench_t b;
    const sim_world_clocks_t clocks = {.drift_ppb = 50000};
    bench_open(&b, &clocks);
    const int64_t begin_us = sim_rate_time_us(&REFRESH, 0), end_us = begin_us + 1000000000;
    run(&b, 30);
    const int64_t master_us = sim_clock_shows_us(sim_world_devices(b.world, 0)->clock, end_us) -
                              sim_clock_shows_us(sim_world_devices(b.world, 0)->clock, begin_us);
    bool differ = false;
    for (int i = 0; i < BOARDS; i++) {
        const hal_time_t *clock = sim_world_devices(b.world, i)->clock;
        const int64_t own_us = sim_clock_shows_us(clock, end_us) - sim_clock_shows_us(clock, begin_us);
        const int64_t drift_ppb = own_us - master_us; /* over 1000 s: us are ppb */
        if (llabs(drift_ppb - b.said[i].drift_ppb) > 400)
            fail_msg("board %d: drift %lld ppb, said %d", i + 1, (long long)drift_ppb, b.said[i].drift_ppb);
        differ |= llabs(drift_ppb) > 20000;
    }
    assert_true(differ);
    bench_close(&b);
}

/* Without a wish for it, all clocks show the world's time. And each board follows the room's viewer. */
static void test_clocks_are_alike_unless_asked_for(void **state)
{
    (void)state;
    static bench_t b;
    const sim_world_clocks_t clocks = {.offset_us = 0};
    bench_open(&b, &clocks);
    run(&b, 10);
    for (int i = 0; i < BOARDS; i++)
        assert_int_equal(local_now(&b, i), sim_rate_time_us(&REFRESH, b.step - 1));
    check_agreement(&b, 0);
    assert_int_equal(b.worst_us, 0);
    for (int i = 0; i < BOARDS; i++)
        assert_int_equal(sim_world_projector(b.world, i)->poses.viewer, (i + 1) % CAN_VIEWERS);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_eight_boards_agree_through_two_losses_of_the_master),
        cmocka_unit_test(test_the_drift_that_is_said_is_the_clocks),
        cmocka_unit_test(test_clocks_are_alike_unless_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
