// SPDX-License-Identifier: Apache-2.0
// Whole projectors agree: of one refresh all that say they are in step show the same picture for the same pose, through
// losses, bus-off and a lost leader; and they are in step nearly always. agreement_hour.c does it for an hour.
#include "tests/firmware/agreement_bench.h"

enum { SCATTER_US = 600 /* of bus time, and what the epoch may be off before it is changed */ };

static void test_boards_agree_through_faults(void **state)
{
    (void)state;
    static bench_t b;
    bench_open(&b, START_S + 60);
    run(&b, START_S * HZ);
    b.shown = b.in_step = 0;
    run(&b, 10 * HZ);
    check_share(&b, "a good bus", 0, 0.999);
    for (int i = 0; i < BOARDS; i++) {
        lose_one_percent(&b, can_of(&b, i));
        run(&b, HZ);
    }
    check_share(&b, "losses at one board", 12, 0.98);
    for (int i = 0; i < BOARDS; i++) {
        const int64_t refreshes = go_bus_off(&b, i);
        if (refreshes > 6)
            fail_msg("seed %d: board %d was back in step %lld refreshes after bus-off", SEED, i + 1,
                     (long long)refreshes);
        run(&b, HZ / 2);
    }
    lose_one_percent(&b, NULL);
    run(&b, 5 * HZ);
    sim_bus_fail(sim_world_bus(b.world), SIM_BUS_LOSE, (sim_bus_fail_t){.next = 0});
    b.shown = b.in_step = 0;
    run(&b, 10 * HZ);
    check_share(&b, "a good bus again", 0, 0.99);
    bench_close(&b);
}

/*
 * Every pose that was captured pose_delay (2 ms) before a refresh, or earlier, is in the picture that is drawn then. So
 * from a pose's arrival to its pixels it takes a period, less than 2 ms, and the drawing.
 */
static void test_a_pose_is_in_the_next_picture(void **state)
{
    (void)state;
    static bench_t b;
    bench_open(&b, START_S + 10);
    run(&b, START_S * HZ);
    for (int i = 0; i < 5 * HZ; i++) {
        run(&b, 1);
        const int64_t now_us = sim_rate_time_us(&REFRESH, b.step - 1);
        const can_step_t *step = &sim_world_projector(b.world, 3)->report.agreement;
        assert_true(step->in_step);
        const int64_t unused_us = (int64_t)step->pose_us + 1000000 / POSES_HZ; /* the first pose that is not in it */
        if (unused_us <= now_us - b.room.pose_delay_us - SCATTER_US)
            fail_msg("seed %d, step %lld: the pose of %lld us is not in the picture of %lld us", SEED,
                     (long long)b.step, (long long)unused_us, (long long)now_us);
    }
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boards_agree_through_faults),
        cmocka_unit_test(test_a_pose_is_in_the_next_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
