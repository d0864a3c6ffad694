// SPDX-License-Identifier: Apache-2.0
// An hour of eight projectors: 1 % of frames lost, bursts, each board bus-off once, the master of bus time lost twice.
// No two boards in step may differ at any refresh, and every board must be back within 100 ms of its fault's end.
#include "tests/firmware/agreement_bench.h"

enum { HOUR_S = 3600, MINUTE = 60 * HZ, BACK_REFRESHES = 6, BURST_FRAMES = 100 };

static void run_minutes(bench_t *b, int minutes)
{
    for (int i = 0; i < minutes; i++) {
        run(b, MINUTE / 2);
        sim_bus_fail(sim_world_bus(b->world), SIM_BUS_CORRUPT, (sim_bus_fail_t){.next = BURST_FRAMES}); /* a burst */
        run(b, MINUTE / 2);
    }
}

static void test_an_hour(void **state)
{
    (void)state;
    static bench_t b;
    int64_t worst = 0;
    bench_open(&b, HOUR_S + START_S);
    run(&b, START_S * HZ);
    b.shown = b.in_step = 0;
    for (int i = 0; i < BOARDS; i++) {
        lose_one_percent(&b, i % 2 == 0 ? can_of(&b, i) : NULL);
        run_minutes(&b, 5);
        const int64_t refreshes = go_bus_off(&b, i);
        worst = refreshes > worst ? refreshes : worst;
        if (i == 2 || i == 5) { /* the tracker stops giving bus time for a while */
            b.sender.config.sync = false;
            run_minutes(&b, 1);
            b.sender.config.sync = true;
        }
        run_minutes(&b, 2);
    }
    run(&b, (int)(HOUR_S * HZ - (b.step - START_S * HZ)));
    printf("back in step after bus-off within %lld refreshes\n", (long long)worst);
    check_share(&b, "an hour", 12, 0.95);
    assert_true(worst <= BACK_REFRESHES);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_hour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
