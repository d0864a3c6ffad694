// SPDX-License-Identifier: Apache-2.0
// Fits every wall of a room to its corners, and warns of the odd ones.
#include "firmware/room/room_walls.h"

#include <math.h>

enum { MAX_RESIDUAL_UM = 5000, MAX_SKEW_MDEG = 1000, LEAST_DIAGONAL_UM = 50000 };

typedef struct {
    double um[3];
} point_t;

/* Of all four corners; an unknown one completes the parallelogram. */
static point_t corner_of(const wall_corners_t *corners, int c)
{
    const int32_t(*um)[3] = corners->corner_um;
    const int next = (c + 1) % 4, far = (c + 2) % 4, last = (c + 3) % 4;
    point_t point;
    for (int axis = 0; axis < 3; axis++)
        point.um[axis] =
            corners->corner_known[c] ? (double)um[c][axis] : (double)um[next][axis] + um[last][axis] - um[far][axis];
    return point;
}

static point_t centre_of(const wall_corners_t *corners)
{
    point_t centre = {{0}};
    for (int c = 0; c < 4; c++)
        for (int axis = 0; axis < 3; axis++)
            centre.um[axis] += corner_of(corners, c).um[axis] / 4.0;
    return centre;
}

/*
 * Seen from the front, right x down points away from the viewer; the viewer is where the other walls are. Walls that
 * continue each other lie near this wall's plane and tell nothing: hence the tenth.
 */
static bool looks_mirrored(const room_t *room, int32_t b)
{
    const wall_corners_t *corners = &room->board[b].corners;
    const point_t origin = corner_of(corners, 0), right = corner_of(corners, 1), down = corner_of(corners, 3);
    const point_t centre = centre_of(corners);
    double x[3], y[3], to_others[3] = {0};
    for (int axis = 0; axis < 3; axis++) {
        x[axis] = right.um[axis] - origin.um[axis];
        y[axis] = down.um[axis] - origin.um[axis];
        for (int32_t other = 0; other < room->board_count; other++)
            if (other != b)
                to_others[axis] += centre_of(&room->board[other].corners).um[axis] - centre.um[axis];
    }
    const double normal[3] = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    double along = 0.0, normal_length = 0.0, distance = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        along += normal[axis] * to_others[axis];
        normal_length = hypot(normal_length, normal[axis]);
        distance = hypot(distance, to_others[axis]);
    }
    return along > 0.1 * normal_length * distance;
}

/* From the second corner to the fourth. */
static double diagonal_um(const wall_corners_t *corners)
{
    const point_t right = corner_of(corners, 1), down = corner_of(corners, 3);
    double length = 0.0;
    for (int axis = 0; axis < 3; axis++)
        length = hypot(length, right.um[axis] - down.um[axis]);
    return length;
}

static bool all_known(const wall_corners_t *corners)
{
    return corners->corner_known[0] && corners->corner_known[1] && corners->corner_known[2] && corners->corner_known[3];
}

static void warn_of_fit(const room_report_t *report, size_t line, const char *key, const room_board_t *board)
{
    const wall_t *wall = &board->wall;
    const double across_um = diagonal_um(&board->corners);
    if (across_um < LEAST_DIAGONAL_UM)
        room_warn(report, line, key,
                  "the wall is %.3g mm from corner to corner: are these metres?, expected millimetres",
                  across_um / 1000.0);
    if (wall->worst_um > MAX_RESIDUAL_UM)
        room_warn(report, line, key,
                  "a point lies %.1f mm off the plane through all (rms %.1f mm), expected at most %d mm",
                  wall->worst_um / 1000.0, wall->rms_um / 1000.0, MAX_RESIDUAL_UM / 1000);
    if (wall->marker_um > MAX_RESIDUAL_UM)
        room_warn(report, line, key,
                  "a marker lies %.1f mm from where the corners put its pixel, expected at most %d mm",
                  wall->marker_um / 1000.0, MAX_RESIDUAL_UM / 1000);
    if (wall->skew_mdeg > MAX_SKEW_MDEG && !all_known(&board->corners))
        room_warn(report, line, key,
                  "three corners make an angle %.1f degrees off a right one, expected at most %d: "
                  "the fourth is taken to complete a parallelogram",
                  wall->skew_mdeg / 1000.0, MAX_SKEW_MDEG / 1000);
}

bool room_walls_fit(const room_checker_t *checker, room_t *room)
{
    for (int32_t b = 0; b < room->board_count; b++) {
        const room_key_t key = room_key("boards[%d].wall.corners_mm", b);
        const wall_status_t status = wall_from_corners(&room->board[b].wall, &room->board[b].corners);
        if (status != WALL_OK)
            return room_refuse(checker->report, room_places_line(checker->places, key.text), key.text, "%s",
                               wall_status_text(status));
    }
    for (int32_t b = 0; b < room->board_count; b++) {
        const room_key_t key = room_key("boards[%d].wall.corners_mm", b);
        const size_t line = room_places_line(checker->places, key.text);
        warn_of_fit(checker->report, line, key.text, &room->board[b]);
        if (room->board_count >= 2 && looks_mirrored(room, b))
            room_warn(
                checker->report, line, key.text,
                "mirrored as seen from the other walls (a rear projection?), expected corners in the order top-left, "
                "top-right, bottom-right, bottom-left");
    }
    return true;
}
