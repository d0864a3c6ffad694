// SPDX-License-Identifier: Apache-2.0
// Tests of a board's update by itself: without an agent, without bus time, too late, and with an agent that is busy.
#include "tests/firmware/alone_bench.h"
#include "tests/support/rng.h"

enum { PROPERTY_SEED = 22110, PROPERTY_CASES = 20000 };

static void test_no_agent(void **state)
{
    (void)state;
    int64_t now_us = install();
    projector.board.update = NULL;
    now_us += 1000000;
    update_step(&projector, now_us);
    assert_false(projector.update.agent);
    assert_string_equal(projector.update.said.waiting, "");
    assert_int_equal(ask(COMMAND_UPDATE_INSTALL, 0, "usb", now_us), UPDATE_NO_AGENT);
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, now_us + 1000000, "0.6", now_us), UPDATE_NO_AGENT);
    assert_int_equal(ask(COMMAND_UPDATE_CONFIRM, now_us + 1000000, "", now_us), UPDATE_NO_AGENT);
    assert_int_equal(ask(COMMAND_UPDATE_CANCEL, 0, "", now_us), UPDATE_NO_AGENT);
    assert_int_equal(ask(COMMAND_UPDATE_STATUS, 0, "", now_us), UPDATE_DONE);
    const int32_t healthy = healthy_after(10, CAN_BOARD_RUNNING, true, false);
    update_step(&projector, now_us + 1000000); /* it may come later than the first pictures */
    assert_int_equal(projector.update.healthy, healthy + 1);
}

static void test_no_bus_time(void **state)
{
    (void)state;
    const int64_t now_us = install();
    projector.time = (bus_master_t){.own = false};
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, now_us + 1000000, "0.6", now_us), UPDATE_NO_TIME);
    bus_time_begin(&projector.time.time, now_us, now_us + OFF_US);
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, now_us + 1000000, "0.6", now_us), UPDATE_DONE);
}

static void test_agent_that_is_busy_is_not_told(void **state)
{
    (void)state;
    int64_t now_us = install();
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, now_us + 900000, "0.6", now_us), UPDATE_DONE);
    assert_int_equal(ask(COMMAND_UPDATE_CONFIRM, now_us + 900000, "", now_us), UPDATE_DONE);
    assert_int_equal(hal_update_good(agent), HAL_OK);
    update_step(&projector, now_us + 900000);
    assert_int_equal(projector.update.plan, UPDATE_NO_PLAN);
    run_s(&now_us, 5);
    assert_true(sim_update_switched_us(agent) == INT64_MIN);
    assert_int_equal(hal_update_good(agent), HAL_OK);
    assert_int_equal(ask(COMMAND_UPDATE_INSTALL, 0, "usb", now_us), UPDATE_NOT_TOLD);
    assert_int_equal(projector.update.said.doing, HAL_UPDATE_READY);
}

/* A switch is told to the agent in the first step after its moment, but none that comes late to it. */
static void check_step_at(int64_t late_us, bool switches)
{
    const int64_t at_us = install() + 500000;
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, at_us, "0.6", at_us - 400000), UPDATE_DONE);
    assert_int_equal(ask(COMMAND_UPDATE_CONFIRM, at_us, "", at_us - 1), UPDATE_DONE);
    update_step(&projector, at_us - 1);
    assert_true(sim_update_switched_us(agent) == INT64_MIN);
    update_step(&projector, at_us + late_us);
    assert_int_equal(sim_update_switched_us(agent) != INT64_MIN, switches);
    assert_int_equal(projector.update.said.doing, switches ? HAL_UPDATE_SWITCHING : HAL_UPDATE_READY);
    assert_int_equal(ask(COMMAND_UPDATE_CONFIRM, at_us, "", at_us + late_us), UPDATE_NO_PROMISE);
    assert_int_equal(ask(COMMAND_UPDATE_CANCEL, 0, "", at_us + late_us), switches ? UPDATE_BUSY : UPDATE_DONE);
}

static void test_switch_in_time(void **state)
{
    (void)state;
    check_step_at(UPDATE_LATE_US, true);
}

static void test_switch_too_late(void **state)
{
    (void)state;
    check_step_at(UPDATE_LATE_US + 1, false);
}

static void test_confirmation_too_late(void **state)
{
    (void)state;
    const int64_t at_us = install() + 500000;
    assert_int_equal(ask(COMMAND_UPDATE_SWITCH, at_us, "0.6", at_us - 400000), UPDATE_DONE);
    assert_int_equal(ask(COMMAND_UPDATE_CONFIRM, at_us, "", at_us), UPDATE_BAD_TIME);
    update_step(&projector, at_us);
    assert_true(sim_update_switched_us(agent) == INT64_MIN);
}

/* What the agent has not taken yet is not read as its state. */
static void test_state_from_before_a_request_is_not_believed(void **state)
{
    (void)state;
    int64_t now_us = install();
    assert_int_equal(ask(COMMAND_UPDATE_INSTALL, 0, "/wallwarp-host-0.7.raucb", now_us), UPDATE_DONE);
    assert_int_equal(projector.update.read_due_us, now_us + UPDATE_TOLD_US);
    update_step(&projector, now_us + UPDATE_TOLD_US - 1);
    assert_int_equal(projector.update.said.doing, HAL_UPDATE_INSTALLING);
    assert_string_equal(projector.update.said.waiting, "");
    update_step(&projector, now_us + UPDATE_TOLD_US); /* the agent has slept all the time */
    assert_int_equal(projector.update.said.doing, HAL_UPDATE_INSTALLING);
    now_us += UPDATE_TOLD_US;
    run_s(&now_us, 4);
    assert_string_equal(projector.update.said.waiting, "0.7");
}

/* Clocks that run apart as far as is followed, and the farthest moment. */
static void test_moment_on_a_clock_that_runs_otherwise(void **state)
{
    (void)state;
    const int64_t now_us = install(), at_us = now_us + 59000000;
    for (int side = -1; side <= 1; side += 2) {
        projector.time.time.rate_q32 = side * (INT64_C(1) << 32) * BUS_TIME_MAX_PPM / 1000000;
        assert_int_equal(ask(COMMAND_UPDATE_SWITCH, at_us, "0.6", now_us), UPDATE_DONE);
        const int64_t off_us = bus_time_from_local(&projector.time.time, projector.update.switch_us) - (at_us + OFF_US);
        assert_in_range(off_us + 60, 0, 120);
        assert_int_equal(ask(COMMAND_UPDATE_CANCEL, 0, "", now_us), UPDATE_DONE);
    }
}

/* Any requests at any time: a switch is asked for once at most, by a step at or after the newest confirmed moment. */
static void test_any_requests(void **state)
{
    rng_t random = {PROPERTY_SEED};
    int switches = 0;
    for (int i = 0; i < PROPERTY_CASES; i++) {
        (void)close_board(state);
        (void)open_board(state);
        int64_t now_us = install(), confirmed_us = INT64_MAX;
        for (int k = 0; k < 8; k++) {
            const command_update_t what = (command_update_t)rng_int(&random, 0, COMMAND_UPDATES - 1);
            const int64_t at_us = T0_US + 5000000 + 100000 * rng_int(&random, 0, 3);
            const char *text = what == COMMAND_UPDATE_INSTALL ? "usb" : rng_int(&random, 0, 9) == 0 ? "0.5" : "0.6";
            if (what != COMMAND_UPDATE_INSTALL || rng_int(&random, 0, 9) == 0)
                if (ask(what, at_us, text, now_us) == UPDATE_DONE && what != COMMAND_UPDATE_STATUS)
                    confirmed_us = what == COMMAND_UPDATE_CONFIRM              ? at_us
                                   : projector.update.plan == UPDATE_CONFIRMED ? confirmed_us
                                                                               : INT64_MAX;
            now_us += rng_int(&random, 1, 300000);
            update_step(&projector, now_us);
            if (sim_update_switched_us(agent) == INT64_MIN)
                continue;
            switches++;
            if (now_us < confirmed_us || now_us - confirmed_us > UPDATE_LATE_US)
                fail_msg("seed %d, case %d: switched at %lld, confirmed for %lld", PROPERTY_SEED, i, (long long)now_us,
                         (long long)confirmed_us);
            break;
        }
    }
    assert_in_range(switches, PROPERTY_CASES / 100, PROPERTY_CASES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_no_agent, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_no_bus_time, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_agent_that_is_busy_is_not_told, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_switch_in_time, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_switch_too_late, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_confirmation_too_late, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_state_from_before_a_request_is_not_believed, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_moment_on_a_clock_that_runs_otherwise, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_any_requests, open_board, close_board),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
