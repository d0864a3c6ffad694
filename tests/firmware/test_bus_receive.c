// SPDX-License-Identifier: Apache-2.0
// Tests of the one place where a board reads its bus: every frame reaches whom it is for, and nobody else.
#include "firmware/projector.h"
#include "tests/firmware/pose_bench.h"

enum { NODE = 3, PERIOD_US = 16667 };

typedef struct {
    bench_t bus;
    bus_master_t time;
    frame_clock_t clock;
    isotp_t commands;
} ears_t;

static ears_t new_ears(void)
{
    ears_t ears = {.bus = new_bench()};
    const frame_rate_t rate = {60, 1};
    bus_master_init(&ears.time, NODE, ears.bus.time_us);
    const frame_clock_settings_t settings = {.node = NODE, .rate = rate, .pose_delay_us = 2000};
    frame_clock_init(&ears.clock, &settings, ears.bus.time_us);
    isotp_init(&ears.commands, 0x603, 0x643);
    return ears;
}

static void hear(ears_t *ears)
{
    const bus_receivers_t receivers = {
        .poses = &ears->bus.poses,
        .time = &ears->time,
        .clock = &ears->clock,
        .commands = &ears->commands,
        .faults = &ears->bus.faults,
    };
    bus_receive(&receivers, &ears->bus.can);
}

static void queue_sync(ears_t *ears, int n)
{
    hal_can_frame_t frame;
    const can_sync_t sync = {.counter = (uint8_t)(n % CAN_E2E_P01_COUNTERS)};
    assert_true(can_sync_encode(&frame, &sync));
    queue(&ears->bus, &frame);
    const can_follow_up_t follow_up = {.counter = sync.counter, .time_us = (uint64_t)ears->bus.time_us};
    assert_true(can_follow_up_encode(&frame, &follow_up));
    queue(&ears->bus, &frame);
    ears->bus.time_us += 125000;
}

static void queue_clock(ears_t *ears)
{
    hal_can_frame_t frame;
    const int64_t number = ears->bus.time_us / PERIOD_US;
    const can_frame_clock_t told = {.node = 1, .epoch = 4, .sure = true, .from = (uint16_t)number, .lag_us = 8000};
    assert_true(can_frame_clock_encode(&frame, &told));
    queue(&ears->bus, &frame);
}

static void queue_request(ears_t *ears)
{
    const hal_can_frame_t frame = {.id = 0x603, .length = 8, .data = {1, 1}};
    queue(&ears->bus, &frame);
}

static void test_everyone_hears_their_own(void **state)
{
    (void)state;
    static ears_t ears;
    ears = new_ears();
    for (int n = 0; n < 80; n++)
        queue_sync(&ears, n);
    hear(&ears);
    assert_true(bus_master_knows(&ears.time, ears.bus.time_us));
    queue_clock(&ears);
    const can_pose_t pose = send_set(&ears.bus, 0);
    queue_request(&ears);
    hear(&ears);
    assert_int_equal(ears.clock.leader, 1);
    assert_true(ears.clock.now.any);
    assert_newest(&ears.bus, &pose);
    const uint8_t *request = NULL;
    assert_int_equal(isotp_received(&ears.commands, &request), 1);
    assert_int_equal(request[0], 1);
    assert_int_equal(can_faults_total(&ears.bus.faults), 0);
    assert_int_equal(ears.commands.faults.invalid, 0);
}

static void test_damage_is_counted_once(void **state)
{
    (void)state;
    static ears_t ears;
    ears = new_ears();
    for (int n = 0; n < 80; n++)
        queue_sync(&ears, n);
    hear(&ears);
    queue_clock(&ears);
    send_fd(&ears.bus, 0);
    queue_sync(&ears, 80);
    for (int i = 1; i <= 4; i++)
        ears.bus.can.frame[ears.bus.can.count - i].data[3] ^= 1;
    hear(&ears);
    assert_int_equal(ears.bus.faults.crc, 4);
    assert_int_equal(can_faults_total(&ears.bus.faults), 4);
}

static void test_nobody_else_needs_to_be_there(void **state)
{
    (void)state;
    static ears_t ears;
    ears = new_ears();
    queue_sync(&ears, 0);
    queue_clock(&ears);
    queue_request(&ears);
    const can_pose_t pose = send_set(&ears.bus, 0);
    receive(&ears.bus);
    assert_newest(&ears.bus, &pose);
    assert_int_equal(can_faults_total(&ears.bus.faults), 0);
}

/* @return What the next heartbeat says, after reading the bus twice: the same loss is told once. */
static uint32_t flags_after_loss(projector_t *p, hal_can_t *can, uint32_t lost)
{
    can_heartbeat_t heartbeat;
    can->lost = lost;
    for (int i = 0; i < 2; i++) {
        bus_receive(&(bus_receivers_t){.poses = &p->poses, .faults = &p->can_faults}, can);
        assert_int_equal(p->can_faults.lost, lost);
        assert_int_equal(can_faults_total(&p->can_faults), lost + p->can_faults.io);
    }
    p->telemetry.heartbeat_due_us = 0;
    telemetry_send_life(p, 0);
    assert_int_equal(can_heartbeat_decode(&heartbeat, &can->sent), CAN_CHECK_OK);
    return heartbeat.fault_flags;
}

static void test_lost_frames_are_a_fault_of_the_bus(void **state)
{
    (void)state;
    static projector_t projector;
    static hal_can_t can;
    projector.node = NODE;
    projector.board.can = &can;
    assert_int_equal(flags_after_loss(&projector, &can, 0), 0);
    assert_int_equal(flags_after_loss(&projector, &can, 3), CAN_FAULT_BUS);
    assert_int_equal(flags_after_loss(&projector, &can, 3), 0);
    assert_int_equal(flags_after_loss(&projector, &can, UINT32_MAX), CAN_FAULT_BUS);
    assert_int_equal(flags_after_loss(&projector, &can, 1), CAN_FAULT_BUS); /* 2 more */
    assert_int_equal(flags_after_loss(&projector, &can, 1), 0);
    can.broken = true;
    flags_after_loss(&projector, &can, 2); /* counted all the same */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_everyone_hears_their_own),
        cmocka_unit_test(test_damage_is_counted_once),
        cmocka_unit_test(test_nobody_else_needs_to_be_there),
        cmocka_unit_test(test_lost_frames_are_a_fault_of_the_bus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
