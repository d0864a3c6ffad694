// SPDX-License-Identifier: Apache-2.0
// Tests of what `wallwarp-pose check --room` says of boards and viewers that a room has, and a bus has not.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/bus_check_room.h"

static bus_watch_t watch;

static void send_heartbeat(uint8_t node)
{
    hal_can_frame_t frame;
    const can_heartbeat_t heartbeat = {.node = node, .state = CAN_BOARD_RUNNING, .uptime_s = 100};
    assert_true(can_heartbeat_encode(&frame, &heartbeat));
    bus_watch_take(&watch, &frame);
}

/* A room of boards 1 and 7: the second follows viewer 2. */
static void expect(int bad, const char *expected)
{
    static room_t room;
    room.board_count = 2;
    room.board[0] = (room_board_t){.name = "front", .node = 1};
    room.board[1] = (room_board_t){.name = "left", .node = 7, .viewer = 2};
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    const int found = bus_check_room(file, &watch, &room);
    assert_int_equal(fclose(file), 0);
    if (found != bad || strcmp(text, expected) != 0)
        fail_msg("%d bad, expected %d; said:\n%sexpected:\n%s", found, bad, text, expected);
    free(text);
}

static int begin(void **state)
{
    (void)state;
    bus_watch_init(&watch, 500000, 2000000);
    return 0;
}

static void test_a_bus_that_fits_its_room_gets_no_line(void **state)
{
    (void)state;
    expect(0, "");
    send_heartbeat(1);
    send_heartbeat(7);
    expect(0, "");
    watch.viewer[0].set = watch.viewer[2].fd = true;
    expect(0, "");
}

static void test_wrong_nodes_are_said(void **state)
{
    (void)state;
    send_heartbeat(1);
    send_heartbeat(2);
    expect(2, "BAD  board 7: \"left\" of the room is silent; power, cable, another node number?\n"
              "BAD  board 2: is not of the room, whose nodes are 1, 7; a wrong number?\n");
}

static void test_wrong_viewers_are_said(void **state)
{
    (void)state;
    send_heartbeat(1);
    send_heartbeat(7);
    watch.viewer[0].set = watch.viewer[3].set = true;
    expect(1, "BAD  viewer 2: no poses, but boards follow it: 1 of 2; see `viewer` of the room\n"
              "ok   viewer 3: no board follows it\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_bus_that_fits_its_room_gets_no_line, begin),
        cmocka_unit_test_setup(test_wrong_nodes_are_said, begin),
        cmocka_unit_test_setup(test_wrong_viewers_are_said, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
