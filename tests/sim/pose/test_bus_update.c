// SPDX-License-Identifier: Apache-2.0
// Tests of what `wallwarp-pose monitor` and `check` say of updates.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/bus_check.h"
#include "sim/pose/bus_table.h"

static bus_watch_t watch;
static int64_t now_us;

static int begin(void **state)
{
    (void)state;
    bus_watch_init(&watch, 500000, 2000000);
    now_us = 0;
    return 0;
}

static void take(bool encoded, hal_can_frame_t *frame)
{
    assert_true(encoded);
    frame->time_us = now_us += 1000;
    bus_watch_take(&watch, frame);
}

static void send_update(can_update_t update)
{
    hal_can_frame_t frame;
    const can_heartbeat_t heartbeat = {.node = update.node, .state = CAN_BOARD_RUNNING, .uptime_s = 100};
    take(can_heartbeat_encode(&frame, &heartbeat), &frame);
    take(can_update_encode(&frame, &update), &frame);
}

static void expect(bool table, const char *expected, bool there)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    if (table)
        bus_table_print(file, "can0", &watch);
    else
        (void)bus_check_print(file, &watch, BUS_CHECK_NO_DELAY);
    assert_int_equal(fclose(file), 0);
    if ((strstr(text, expected) != NULL) != there)
        fail_msg("\"%s\" is %s:\n%s", expected, there ? "not in" : "in", text);
    free(text);
}

static void test_table(void **state)
{
    (void)state;
    send_update((can_update_t){.node = 3, .state = CAN_UPDATE_NO_AGENT});
    expect(true, "update", false);
    send_update((can_update_t){.node = 1,
                               .state = CAN_UPDATE_READY,
                               .progress = 100,
                               .slot = 2,
                               .trial = true,
                               .plan = UPDATE_CONFIRMED,
                               .running = 0xA6A3,
                               .waiting = 0x0FF3});
    send_update((can_update_t){.node = 2, .state = CAN_UPDATE_INSTALLING, .progress = 7, .slot = 1, .running = 0xA6A3});
    expect(true, "\n board  update     progress  slot  runs  it is  waiting  switch\n", true);
    expect(true, "\n     1  ready          100%  B     A6A3  trial     0FF3  confirmed\n", true);
    expect(true, "\n     2  installing       7%  A     A6A3  good         -  no\n", true);
    assert_int_equal(watch.unknown + watch.damaged, 0);
}

static void test_check(void **state)
{
    (void)state;
    send_update((can_update_t){.node = 1, .state = CAN_UPDATE_IDLE, .running = 5});
    send_update((can_update_t){.node = 2, .state = CAN_UPDATE_IDLE, .running = 5, .trial = true});
    send_update((can_update_t){.node = 3, .state = CAN_UPDATE_NO_AGENT});
    expect(false, "version than", false);
    expect(false, "ok   board 2: its version is on trial", true);
    send_update((can_update_t){.node = 2, .state = CAN_UPDATE_FAILED, .running = 6});
    expect(false, "BAD  board 2: another version than board 1 runs", true);
    expect(false, "BAD  board 2: an update has failed", true);
    expect(false, "on trial", false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_table, begin),
        cmocka_unit_test_setup(test_check, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
