// SPDX-License-Identifier: Apache-2.0
// With a key no step of the loop touches the heap either: sessions, poses, strangers, signing as master and leader.
#include "tests/firmware/key_bench.h"
#include "tests/support/heap_trap.h"

static projector_t projector;

static void run(int milliseconds)
{
    for (int i = 0; i < milliseconds * ROOM_BENCH_HZ / 1000; i++) {
        if (k.sending)
            pose_sender_advance(&k.tracker, room_bench_now_us(&k.room));
        room_bench_advance(&k.room);
        heap_trap_set = true;
        projector_step(&projector);
        heap_trap_set = false;
        k.room.step++;
    }
}

static void test_no_key_allocates(void **state)
{
    (void)state;
    const room_board_t *board = &k.room.room.board[0];
    projector_init(&projector, &k.room.room, board, sim_world_devices(k.room.world, 0), &warp_kernels_scalar);
    projector_use_key(&projector, k.key, 5);
    heap_trap_calls = 0;
    key_track(k.key, 1);
    k.room.tracking = true; /* the bench's own tracker has no key */
    run(4000);
    assert_true(projector.report.corrected);
    assert_true(can_faults_refused(&projector.can_faults) > 10);
    k.sending = false;
    run(3000);
    assert_int_equal(bus_master_state(&projector.time, room_bench_now_us(&k.room)), CAN_TIME_OWN);
    assert_true(projector.choice.clock.leading);
    assert_true(projector.auth.own_time.time_us > 6000000 && projector.auth.own_clock.time_us > 6000000);
    assert_int_equal(heap_trap_calls, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heap_trap_works),
        cmocka_unit_test_setup_teardown(test_no_key_allocates, key_open_fd, key_teardown),
        cmocka_unit_test_setup_teardown(test_no_key_allocates, key_open_classic, key_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
