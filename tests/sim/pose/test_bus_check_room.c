// SPDX-License-Identifier: Apache-2.0
// Tests of what `wallwarp-pose check --room` says of boards and viewers that a room has, and a bus has not.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/bus_check_room.h"

static const int64_t nm_per_mm = 1000000;

static bus_watch_t watch;

static void send_heartbeat(uint8_t node)
{
    hal_can_frame_t frame;
    const can_heartbeat_t heartbeat = {.node = node, .state = CAN_BOARD_RUNNING, .uptime_s = 100};
    assert_true(can_heartbeat_encode(&frame, &heartbeat));
    bus_watch_take(&watch, &frame);
}

/* Walls in front of the origin and to its left, on boards 1 and 7: the second follows viewer 2. */
static void load_room(room_t *room)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (!room_load(room, "sim/demo/room.yaml", NULL, NULL, error))
        fail_msg("%s", error);
    room->board_count = 2;
    room->board[1].node = 7;
    room->board[1].viewer = 2;
}

static void place(int viewer, int x_mm, int y_mm, int z_mm)
{
    can_poses_t *poses = &watch.viewer[viewer].receiver;
    poses->any = true;
    poses->newest.pose = (pose_t){.eye_nm = {x_mm * nm_per_mm, y_mm * nm_per_mm, z_mm * nm_per_mm},
                                  .quaternion_q30 = {1 << 30, 0, 0, 0}};
}

static void expect(int bad, const char *expected)
{
    static room_t room;
    load_room(&room);
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

static void test_places_that_cannot_be_are_said(void **state)
{
    (void)state;
    send_heartbeat(1);
    send_heartbeat(7);
    watch.viewer[0].set = watch.viewer[2].set = true;
    place(0, 0, -1700, 0);
    place(2, 0, -1700, 0);
    expect(0, "");
    place(0, 2, -2, 19);
    expect(1, "BAD  viewer 0: is at 2.0 -2.0 19.0 mm; are its poses in metres?\n");
    place(0, 2, -2, 20);
    expect(0, "");
    place(0, -9000, -1700, 0); /* behind the left wall, which follows the other viewer */
    expect(0, "");
    place(2, -9000, -1700, 0);
    expect(1, "BAD  viewer 2: at -9000 -1700 0 mm is behind the wall of board 7, \"left\"; axes, origin, unit of its "
              "poses? Or a rear projection?\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_bus_that_fits_its_room_gets_no_line, begin),
        cmocka_unit_test_setup(test_wrong_nodes_are_said, begin),
        cmocka_unit_test_setup(test_wrong_viewers_are_said, begin),
        cmocka_unit_test_setup(test_places_that_cannot_be_are_said, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
