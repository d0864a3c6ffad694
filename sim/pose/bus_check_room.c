// SPDX-License-Identifier: Apache-2.0
// Are a room's boards, and poses for them, on this bus?
#include "sim/pose/bus_check_room.h"

#include <math.h>

#include "sim/pose/bus_judge.h"
#include "warp_fixed/homography_from_pose.h"

enum { NM_PER_MM = 1000000, NEAREST_MM = 20 };

static void check_boards(bus_judge_t *judge, const bus_watch_t *watch, const room_t *room)
{
    for (int32_t b = 0; b < room->board_count; b++) {
        const room_board_t *board = &room->board[b];
        if (!bus_watch_heard(&watch->board[board->node]))
            bus_judge_say(judge, false, "board %d: \"%s\" of the room is silent; power, cable, another node number?",
                          board->node, board->name);
    }
    char nodes[ROOM_NODES_LENGTH];
    room_nodes(room, nodes);
    for (int node = 1; node <= CAN_MAX_NODE; node++)
        if (bus_watch_heard(&watch->board[node]) && room_board_with_node(room, node) == NULL)
            bus_judge_say(judge, false, "board %d: is not of the room, whose nodes are %s; a wrong number?", node,
                          nodes);
}

static void check_viewers(bus_judge_t *judge, const bus_watch_t *watch, const room_t *room)
{
    int followers[CAN_VIEWERS] = {0}, viewers = 0;
    for (int32_t b = 0; b < room->board_count; b++)
        followers[room->board[b].viewer]++;
    for (int v = 0; v < CAN_VIEWERS; v++)
        viewers += watch->viewer[v].fd || watch->viewer[v].set;
    for (int v = 0; viewers > 0 && v < CAN_VIEWERS; v++) {
        const bool sent = watch->viewer[v].fd || watch->viewer[v].set;
        if (followers[v] > 0 && !sent)
            bus_judge_say(judge, false, "viewer %d: no poses, but boards follow it: %d of %d; see `viewer` of the room",
                          v, followers[v], room->board_count);
        if (followers[v] == 0 && sent)
            bus_judge_say(judge, true, "viewer %d: no board follows it", v);
    }
}

/* Nobody's eye stays so near to the origin, which is at a wall or on the floor. */
static void check_unit(bus_judge_t *judge, int number, const double eye_mm[3])
{
    if (fabs(eye_mm[0]) < NEAREST_MM && fabs(eye_mm[1]) < NEAREST_MM && fabs(eye_mm[2]) < NEAREST_MM)
        bus_judge_say(judge, false, "viewer %d: is at %.1f %.1f %.1f mm; are its poses in metres?", number, eye_mm[0],
                      eye_mm[1], eye_mm[2]);
}

/* Where the newest poses are, as the boards that follow them see it. */
static void check_places(bus_judge_t *judge, const bus_watch_t *watch, const room_t *room)
{
    for (int v = 0; v < CAN_VIEWERS; v++) {
        const can_poses_t *poses = &watch->viewer[v].receiver;
        const pose_t *pose = &poses->newest.pose;
        if (!poses->any)
            continue;
        double eye_mm[3];
        for (int axis = 0; axis < 3; axis++)
            eye_mm[axis] = (double)pose->eye_nm[axis] / NM_PER_MM;
        check_unit(judge, v, eye_mm);
        for (int32_t b = 0; b < room->board_count; b++) {
            const room_board_t *board = &room->board[b];
            homography_t homography;
            if (board->viewer == v && homography_from_pose(&homography, &room->camera, &board->wall, pose) &&
                homography_is_mirrored(&homography))
                bus_judge_say(judge, false,
                              "viewer %d: at %.0f %.0f %.0f mm is behind the wall of board %d, \"%s\"; axes, origin, "
                              "unit of its poses? Or a rear projection?",
                              v, eye_mm[0], eye_mm[1], eye_mm[2], board->node, board->name);
        }
    }
}

int bus_check_room(FILE *file, const bus_watch_t *watch, const room_t *room)
{
    bus_judge_t judge = {.file = file};
    if (watch->frames == 0)
        return 0;
    check_boards(&judge, watch, room);
    check_viewers(&judge, watch, room);
    check_places(&judge, watch, room);
    return judge.bad;
}
