// SPDX-License-Identifier: Apache-2.0
// Whole projectors agree: of one refresh all that say they are in step show the same picture for the same pose, through
// losses, bus-off and a lost leader; and they are in step nearly always. agreement_hour.c does it for an hour.
#include "tests/firmware/agreement_bench.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boards_agree_through_faults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
