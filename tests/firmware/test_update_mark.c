// SPDX-License-Identifier: Apache-2.0
// Tests of the mark of a version on trial by itself: which frames count for it, and when the agent is told.
#include "tests/firmware/alone_bench.h"

static void test_which_frames_are_healthy(void **state)
{
    (void)state;
    assert_int_equal(healthy_after(10, CAN_BOARD_RUNNING, true, false), 10);
    assert_int_equal(healthy_after(10, CAN_BOARD_RUNNING, true, true), 10);
    assert_int_equal(healthy_after(10, CAN_BOARD_FROZEN, false, false), 10);
    assert_int_equal(healthy_after(10, CAN_BOARD_SAFE, true, false), 20);
    assert_int_equal(healthy_after(10, CAN_BOARD_PATTERN, true, false), 30);
    assert_int_equal(healthy_after(1, CAN_BOARD_FAULT, true, false), 0);
    assert_int_equal(healthy_after(UPDATE_GOOD_FRAMES + 1, CAN_BOARD_HOLDING, true, false), UPDATE_GOOD_FRAMES);
    uint32_t *const faults[] = {&projector.faults.camera, &projector.faults.picture_size, &projector.faults.gpio,
                                &projector.faults.watchdog};
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        ++*faults[i];
        assert_int_equal(healthy_after(1, CAN_BOARD_RUNNING, true, false), 0);
        assert_int_equal(healthy_after(3, CAN_BOARD_RUNNING, true, false), 3);
    }
}

/* The board in its other slot. @return When. */
static int64_t start_in_the_other_slot(void)
{
    int64_t now_us = install() + SIM_UPDATE_TAKE_US;
    assert_int_equal(hal_update_switch(agent), HAL_OK);
    assert_int_equal(sim_update_advance(agent, now_us), SIM_UPDATE_DOWN);
    now_us += 1000000;
    assert_int_equal(sim_update_advance(agent, now_us), SIM_UPDATE_STARTS);
    update_init(&projector.update, now_us);
    update_step(&projector, now_us);
    assert_true(projector.update.said.trial);
    assert_int_equal(healthy_after(UPDATE_GOOD_FRAMES, CAN_BOARD_RUNNING, true, false), UPDATE_GOOD_FRAMES);
    assert_false(projector.update.told_good);
    return now_us;
}

/* An agent that fails at it is not asked every second. */
static void test_good_is_told_once(void **state)
{
    (void)state;
    int64_t now_us = start_in_the_other_slot();
    sim_update_faults(agent)->good = true;
    run_s(&now_us, 3);
    assert_true(projector.update.told_good);
    assert_true(projector.update.said.trial);
    sim_update_faults(agent)->good = false;
    run_s(&now_us, 3);
    assert_true(projector.update.said.trial);
}

/* It would make that slot the first again. */
static void test_good_is_not_told_once_the_board_switches(void **state)
{
    (void)state;
    int64_t now_us = start_in_the_other_slot() + SIM_UPDATE_TAKE_US;
    assert_int_equal(hal_update_switch(agent), HAL_OK);
    assert_int_equal(sim_update_advance(agent, now_us), SIM_UPDATE_DOWN);
    update_step(&projector, now_us + 1000000);
    assert_int_equal(projector.update.said.doing, HAL_UPDATE_SWITCHING);
    assert_false(projector.update.told_good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_which_frames_are_healthy, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_good_is_told_once, open_board, close_board),
        cmocka_unit_test_setup_teardown(test_good_is_not_told_once_the_board_switches, open_board, close_board),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
