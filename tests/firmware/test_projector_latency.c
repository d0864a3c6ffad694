// SPDX-License-Identifier: Apache-2.0
// Whole projectors with cameras and displays of different delay: all show the same pictures, and on request at the same
// time; through losses, a lost leader, and requests that cannot be met.
#include <math.h>

#include "firmware/byte_order.h"
#include "sim/devices/sim_camera.h"
#include "tests/firmware/agreement_bench.h"

enum { PERIOD_US = 16667, SETTLE_S = 5, SCATTER_US = 600, OPERATED = 2, ANSWER_STEPS = 30 };

/* An operator on the bus. */
typedef struct {
    hal_can_t *can;
    isotp_t link;
    uint8_t reply[COMMAND_REPLY_BYTES];
} operator_t;

static void operator_open(operator_t *operator, bench_t * b)
{
    operator->can = sim_bus_attach(sim_world_bus(b->world));
    assert_non_null(operator->can);
    isotp_init(&operator->link, CAN_ID_REPLY + OPERATED, CAN_ID_COMMAND + OPERATED);
}

static int64_t now_us(const bench_t *b)
{
    return sim_rate_time_us(&REFRESH, b->step);
}

/* One refresh of all, with the operator on the bus. */
static void talk(operator_t *operator, bench_t * b)
{
    hal_can_frame_t frame;
    while (isotp_next(&operator->link, &frame, now_us(b)))
        assert_int_equal(hal_can_send(operator->can, &frame), HAL_OK);
    run(b, 1);
    while (hal_can_receive(operator->can, &frame) == HAL_OK)
        (void)isotp_take(&operator->link, &frame, now_us(b));
}

/* @return Bytes of what the board answers behind the result. */
static int want(operator_t *operator, bench_t * b, uint32_t latency_us, command_result_t expected)
{
    uint8_t request[COMMAND_MAX_BYTES];
    const uint8_t *bytes = NULL;
    const command_t command = {.kind = COMMAND_LATENCY, .latency_us = latency_us};
    assert_true(isotp_send(&operator->link, request, command_encode(request, &command), now_us(b)));
    int length = 0;
    for (int i = 0; i < ANSWER_STEPS && length == 0; i++) {
        talk(operator, b);
        length = isotp_received(&operator->link, &bytes);
    }
    assert_true(length >= 2);
    memcpy(operator->reply, bytes, (size_t)length);
    isotp_taken(&operator->link);
    if (operator->reply[1] != expected)
        fail_msg("latency %u us: result %u, expected %d", latency_us, operator->reply[1], expected);
    return length - 2;
}

/* What the walls do, from the moments of the simulation and the displays' true delays. */
typedef struct {
    double apart_us;          /* the most by which walls show one content at different times */
    double least_us, most_us; /* pose to photon */
} figures_t;

/* Watch for a second: all boards are in step; and what they report is so. */
static figures_t watch(bench_t *b, const double display_ms[BOARDS])
{
    static double first_us[CONTENTS], last_us[CONTENTS];
    figures_t found = {.least_us = 1e9};
    for (int i = 0; i < CONTENTS; i++)
        first_us[i] = last_us[i] = -1;
    for (int n = 0; n < HZ; n++) {
        run(b, 1);
        for (int i = 0; i < BOARDS; i++) {
            const projector_t *projector = sim_world_projector(b->world, i);
            const can_step_t *step = &projector->report.agreement;
            if (!step->in_step)
                fail_msg("seed %d, step %lld: board %d is not in step: fault %d", SEED, (long long)b->step, i + 1,
                         (int)projector->report.fault);
            const double seen_us =
                (double)sim_rate_time_us(&REFRESH, b->step - 1) + 1.5 * PERIOD_US + display_ms[i] * 1000;
            const double photon_us = seen_us - (double)step->pose_us;
            if (fabs(photon_us - projector->report.pose_to_photon_us) > SCATTER_US)
                fail_msg("seed %d, step %lld: board %d says %d us from pose to photon, it is %.0f", SEED,
                         (long long)b->step, i + 1, projector->report.pose_to_photon_us, photon_us);
            found.least_us = fmin(found.least_us, photon_us);
            found.most_us = fmax(found.most_us, photon_us);
            const size_t place = (size_t)projector->choice.step.content % CONTENTS;
            if (first_us[place] < 0 || seen_us - first_us[place] > CONTENTS / 2 * PERIOD_US)
                first_us[place] = last_us[place] = seen_us;
            first_us[place] = fmin(first_us[place], seen_us);
            last_us[place] = fmax(last_us[place], seen_us);
            found.apart_us = fmax(found.apart_us, last_us[place] - first_us[place]);
        }
    }
    return found;
}

static void print(const char *what, const figures_t *found)
{
    printf("%s: walls up to %.1f ms apart, pose to photon %.1f to %.1f ms\n", what, found->apart_us / 1e3,
           found->least_us / 1e3, found->most_us / 1e3);
}

static void settle(bench_t *b)
{
    run(b, SETTLE_S * HZ);
}

/* Displays that differ by whole refreshes show the same at the same time; others within a refresh. */
static void test_equal_on_request(void **state)
{
    (void)state;
    static const double display_ms[][BOARDS] = {{0, 16.5, 33.5, 50, 0, 16.5, 33.5, 50},
                                                {8, 2.5, 21, 30, 12, 45.5, 4, 16}};
    static const double apart_us[] = {1100, PERIOD_US + 100};
    for (int n = 0; n < 2; n++) {
        static bench_t b;
        operator_t operator;
        bench_open_with(&b, START_S + 60, &(bench_settings_t){.display_ms = display_ms[n], .video_60 = true});
        operator_open(&operator, & b);
        run(&b, START_S * HZ);
        figures_t found = watch(&b, display_ms[n]);
        print("each as early as it can", &found);
        assert_true(found.apart_us > 42000);

        assert_int_equal(want(&operator, & b, 1, COMMAND_OK), 4);
        const uint32_t will_us = get_u32(operator.reply + 2);
        settle(&b);
        found = watch(&b, display_ms[n]);
        print("all as late as the slowest", &found);
        if (found.apart_us > apart_us[n])
            fail_msg("seed %d, displays %d: walls are %.0f us apart, expected %.0f", SEED, n, found.apart_us,
                     apart_us[n]);
        const int32_t told_us = sim_world_projector(b.world, OPERATED - 1)->report.pose_to_photon_us;
        assert_in_range(told_us + 100000 - (int64_t)will_us, 100000 - SCATTER_US, 100000 + PERIOD_US / 2);

        assert_int_equal(want(&operator, & b, 0, COMMAND_OK), 4);
        settle(&b);
        found = watch(&b, display_ms[n]);
        print("each as early as it can again", &found);
        assert_true(found.apart_us > 42000);
        bench_close(&b);
    }
}

/* Longer than needed, and back; what cannot be is refused, says why, and changes nothing. */
static void test_requests_longer_than_needed(void **state)
{
    (void)state;
    static const double display_ms[BOARDS] = {0, 16.5, 33.5, 0, 0, 16.5, 33.5, 0};
    static bench_t b;
    operator_t operator;
    bench_open_with(&b, START_S + 60, &(bench_settings_t){.display_ms = display_ms});
    operator_open(&operator, & b);
    run(&b, START_S * HZ);
    for (int ms = 61; ms <= 81; ms += 20) { /* the least is 60.5 */
        assert_int_equal(want(&operator, & b, (uint32_t)ms * 1000, COMMAND_OK), 4);
        settle(&b);
        const figures_t found = watch(&b, display_ms);
        print("longer", &found);
        assert_true(found.apart_us < 1100);
        assert_true(found.most_us > ms * 1000.0 - PERIOD_US / 2 && found.least_us < ms * 1000.0 + PERIOD_US / 2);
    }
    const int8_t held = (int8_t)sim_world_projector(b.world, 0)->choice.step.held;
    assert_int_equal(want(&operator, & b, 86000, COMMAND_IMPOSSIBLE), 8);
    assert_int_equal(get_u32(operator.reply + 2), 2000 + PERIOD_US * 3 / 2 + 33500);
    assert_int_equal(get_u32(operator.reply + 6), 2000 + PERIOD_US * 3 / 2 + 3 * PERIOD_US + PERIOD_US / 2);
    settle(&b);
    (void)watch(&b, display_ms);
    assert_int_equal(sim_world_projector(b.world, 0)->choice.step.held, held);
    bench_close(&b);
}

/* A projector that no other can be as late as. */
static void test_too_slow_a_projector(void **state)
{
    (void)state;
    static const double display_ms[BOARDS] = {0, 0, 0, 0, 0, 100, 0, 0};
    static bench_t b;
    operator_t operator;
    bench_open_with(&b, START_S + 20, &(bench_settings_t){.display_ms = display_ms});
    operator_open(&operator, & b);
    run(&b, START_S * HZ);
    assert_int_equal(want(&operator, & b, 1, COMMAND_IMPOSSIBLE), 8);
    assert_true(get_u32(operator.reply + 2) > get_u32(operator.reply + 6));
    settle(&b);
    const figures_t found = watch(&b, display_ms);
    assert_true(found.apart_us > 99000);
    bench_close(&b);
}

/* The others wait for the pictures of the slowest camera; and no more when it is gone, or is quick again. */
static void test_late_camera(void **state)
{
    (void)state;
    static const double none_ms[BOARDS] = {0};
    static bench_t b;
    bench_open_with(&b, START_S + 60, &(bench_settings_t){.video_60 = true});
    run(&b, START_S * HZ);
    const int32_t before_us = sim_world_projector(b.world, 0)->choice.step.epoch.lag_us;
    sim_camera_faults_t *faults = sim_camera_faults(sim_world_devices(b.world, 4)->camera);
    for (int late_us = 20000; late_us <= 40000; late_us += 20000) {
        faults->late_us = late_us;
        settle(&b);
        (void)watch(&b, none_ms);
        const int32_t lag_us = sim_world_projector(b.world, 0)->choice.step.epoch.lag_us;
        printf("a camera late by %d ms: lag %.1f ms, %.1f before\n", late_us / 1000, lag_us / 1e3, before_us / 1e3);
        assert_in_range(lag_us, late_us, late_us + PERIOD_US + SCATTER_US); /* it waits for the next blank */
    }
    faults->unplugged_until_us = INT64_MAX;
    settle(&b);
    settle(&b);
    assert_in_range(sim_world_projector(b.world, 0)->choice.step.epoch.lag_us, before_us - SCATTER_US,
                    before_us + SCATTER_US);
    bench_close(&b);
}

/* Losses while it changes, and a leader that is unplugged for a while: the next one leads, and nothing else changes. */
static void test_faults_while_equal(void **state)
{
    (void)state;
    static const double display_ms[BOARDS] = {33.5, 16.5, 0, 0, 0, 16.5, 33.5, 0};
    static bench_t b;
    operator_t operator;
    bench_open_with(&b, START_S + 90, &(bench_settings_t){.display_ms = display_ms, .video_60 = true});
    operator_open(&operator, & b);
    run(&b, START_S * HZ);
    b.shown = b.in_step = 0;
    lose_one_percent(&b, NULL);
    for (int i = 0; i < 4; i++) {
        (void)want(&operator, & b, i % 2 == 0 ? 1 : 0, COMMAND_OK);
        settle(&b);
    }
    (void)want(&operator, & b, 1, COMMAND_OK);
    settle(&b);
    check_share(&b, "losses, changes", 12, 0.97); /* seeds 1 to 7: 97.7 to 98.1 % */
    sim_bus_fail(sim_world_bus(b.world), SIM_BUS_LOSE, (sim_bus_fail_t){.next = 0});
    for (int i = 0; i < 3; i++) {
        sim_bus_fail_unplug(can_of(&b, 0));
        run(&b, 3 * HZ);
        assert_true(sim_world_projector(b.world, 1)->choice.clock.leading);
        sim_bus_replug(can_of(&b, 0));
        run(&b, 2 * HZ);
        const figures_t found = watch(&b, display_ms);
        print("another leader", &found);
        assert_true(found.apart_us < 1100);
    }
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_on_request),     cmocka_unit_test(test_requests_longer_than_needed),
        cmocka_unit_test(test_too_slow_a_projector), cmocka_unit_test(test_late_camera),
        cmocka_unit_test(test_faults_while_equal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
