// SPDX-License-Identifier: Apache-2.0
// The reason on the safe picture, for every state and for a bus that is off.
#include "firmware/safe_reason.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "firmware/projector.h"
#include "sim/bus/sim_bus.h"

typedef struct {
    projector_t *projector;
    sim_bus_t *bus;
} board_t;

static board_t board;

static int set_up(void **state)
{
    (void)state;
    board.projector = calloc(1, sizeof *board.projector);
    board.bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 2000000, .fd = true});
    if (board.projector == NULL || board.bus == NULL)
        return -1;
    board.projector->board.can = sim_bus_attach(board.bus);
    return board.projector->board.can == NULL;
}

static int tear_down(void **state)
{
    (void)state;
    sim_bus_destroy(board.bus);
    free(board.projector);
    return 0;
}

static void expect(can_board_state_t state, bool any_pose, const char *reason)
{
    board.projector->report.state = state;
    board.projector->poses.any = any_pose;
    assert_string_equal(safe_reason(board.projector), reason);
}

static void every_state_has_its_reason(void **state)
{
    (void)state;
    expect(CAN_BOARD_WAITING, false, "no pose yet");
    expect(CAN_BOARD_WAITING, true, "no video yet");
    expect(CAN_BOARD_SAFE, true, "no pose");
    expect(CAN_BOARD_FAULT, true, "no video");
    expect(CAN_BOARD_RUNNING, true, "this pose can't be shown here");
    expect(CAN_BOARD_HOLDING, true, "this pose can't be shown here");
}

static void a_bus_that_is_off_explains_missing_poses_only(void **state)
{
    (void)state;
    sim_bus_fail_bus_off(board.projector->board.can);
    expect(CAN_BOARD_WAITING, false, "bus off");
    expect(CAN_BOARD_SAFE, true, "bus off");
    expect(CAN_BOARD_FAULT, true, "no video");
    expect(CAN_BOARD_RUNNING, true, "this pose can't be shown here");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_state_has_its_reason, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_bus_that_is_off_explains_missing_poses_only, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
