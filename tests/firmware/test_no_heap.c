// SPDX-License-Identifier: Apache-2.0
// Tests that no step of the loop touches the heap, whatever the method, and whatever goes wrong.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "sim/devices/sim_camera.h"
#include "sim/devices/sim_display.h"
#include "tests/support/heap_trap.h"
#include "tests/support/room_bench.h"

static room_bench_t bench;
static projector_t projector;

static void step(void)
{
    room_bench_advance(&bench);
    heap_trap_set = true;
    projector_step(&projector);
    heap_trap_set = false;
    bench.step++;
}

static void run(int milliseconds)
{
    for (int i = 0; i < milliseconds * ROOM_BENCH_HZ / 1000; i++)
        step();
}

static void open_projector(const warp_method_t *method, bool fd)
{
    room_bench_open(&bench, fd);
    bench.tracking = true;
    room_board_t board = bench.room.board[0];
    board.method = method;
    projector_init(&projector, &bench.room, &board, sim_world_devices(bench.world, 0), &warp_kernels_scalar);
    heap_trap_calls = 0;
}

static void test_no_method_allocates(void **state)
{
    (void)state;
    for (int i = 0; i < WARP_METHODS; i++) {
        open_projector(&warp_methods[i], i % 2 == 0);
        run(200);
        const bool drawn = projector.report.corrected;
        const int calls = heap_trap_calls;
        room_bench_close(&bench);
        if (!drawn || calls != 0)
            printf("method %s\n", warp_methods[i].name);
        assert_true(drawn);
        assert_int_equal(calls, 0);
    }
}

static void test_no_fault_allocates(void **state)
{
    (void)state;
    open_projector(warp_method_default(), true);
    const hal_board_t *devices = sim_world_devices(bench.world, 0);
    sim_bus_t *bus = sim_world_bus(bench.world);
    const hal_can_frame_t flood = {.id = 0, .length = 8};
    run(200);
    sim_bus_fail(bus, SIM_BUS_CORRUPT, (sim_bus_fail_t){.next = 20});
    run(400);
    sim_bus_fail_bus_off(devices->can);
    run(400);
    assert_int_equal(sim_bus_fail_flood(bus, &flood), HAL_OK);
    run(1500);
    assert_int_equal(projector.report.state, CAN_BOARD_SAFE);
    assert_int_equal(sim_bus_fail_flood(bus, NULL), HAL_OK);
    sim_bus_fail_driver(devices->can, true);
    run(100);
    sim_bus_fail_driver(devices->can, false);
    sim_display_faults(devices->display)->refuse_next = 3;
    run(100);
    sim_camera_faults(devices->camera)->unplugged_until_us = INT64_MAX;
    run(1200);
    assert_int_equal(projector.report.state, CAN_BOARD_FAULT);
    sim_camera_faults(devices->camera)->unplugged_until_us = 0;
    run(600);
    assert_int_equal(projector.report.state, CAN_BOARD_RUNNING);
    const int calls = heap_trap_calls;
    room_bench_close(&bench);
    assert_int_equal(calls, 0);
}

static void ask(const command_t *command)
{
    hal_can_frame_t frame;
    uint8_t bytes[COMMAND_MAX_BYTES];
    isotp_t link;
    isotp_init(&link, CAN_ID_REPLY + 5, CAN_ID_COMMAND + 5);
    assert_true(isotp_send(&link, bytes, command_encode(bytes, command), room_bench_now_us(&bench)));
    for (int i = 0; i < 30; i++) {
        while (hal_can_receive(bench.tracker, &frame) == HAL_OK)
            (void)isotp_take(&link, &frame, room_bench_now_us(&bench));
        while (isotp_next(&link, &frame, room_bench_now_us(&bench)))
            assert_int_equal(hal_can_send(bench.tracker, &frame), HAL_OK);
        step();
    }
}

static void test_no_command_allocates(void **state)
{
    (void)state;
    static const command_t commands[] = {
        {.kind = COMMAND_HELLO},
        {.kind = COMMAND_FREEZE, .freeze = true},
        {.kind = COMMAND_FREEZE},
        {.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_GRID},
        {.kind = COMMAND_PATTERN},
        {.kind = COMMAND_METHOD},
        {.kind = COMMAND_LATENCY, .latency_us = 1000},
        {.kind = COMMAND_LOG},
        {.kind = COMMAND_UPDATE},
        {.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_INSTALL, .text = "/wallwarp-host-0.6.raucb"},
        {.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_SWITCH, .bus_time_us = 5, .text = "0.6"},
        {.kind = COMMAND_UPDATE, .update = COMMAND_UPDATE_CANCEL},
        {.kind = COMMAND_REBOOT},
    };
    open_projector(warp_method_default(), true);
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        ask(&commands[i]);
    for (int m = 0; m < WARP_METHODS; m++)
        ask(&(command_t){.kind = COMMAND_METHOD, .method = &warp_methods[m]});
    const int calls = heap_trap_calls;
    const bool rebooting = projector.commands.reboot;
    room_bench_close(&bench);
    assert_true(rebooting);
    assert_int_equal(calls, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heap_trap_works),
        cmocka_unit_test(test_no_method_allocates),
        cmocka_unit_test(test_no_fault_allocates),
        cmocka_unit_test(test_no_command_allocates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
