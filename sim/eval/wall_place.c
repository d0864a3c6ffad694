// SPDX-License-Identifier: Apache-2.0
// Where a wall is in the room, in millimetres: for choosing places to look at it from.
#include "sim/eval/wall_place.h"

#include <math.h>
#include <string.h>

#include "sim/eval/double_view.h"

/* A view closer than this to straight up or down, as the length of up's part across it, has no up. */
static const double least_up = 0.01;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* from - to, of length 1. */
static void direction(double out[3], const double from[3], const double to[3])
{
    for (int a = 0; a < 3; a++)
        out[a] = to[a] - from[a];
    const double length = sqrt(dot(out, out));
    for (int a = 0; a < 3; a++)
        out[a] /= length;
}

static void point_of(double out_mm[3], const double_wall_t *wall, double u, double v)
{
    double_wall_point(wall, (const double[2]){u, v}, out_mm);
    for (int a = 0; a < 3; a++)
        out_mm[a] *= 1000.0;
}

void wall_place(wall_place_t *place, const wall_t *wall)
{
    const double width = wall->panel_width, height = wall->panel_height;
    double_wall_t exact;
    double_wall(&exact, wall);
    const double uv[4][2] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    for (int c = 0; c < 4; c++)
        point_of(place->corner_mm[c], &exact, uv[c][0], uv[c][1]);
    point_of(place->centre_mm, &exact, width / 2, height / 2);
    double top_edge[3], bottom_edge[3], right[3], across[3];
    for (int a = 0; a < 3; a++) {
        top_edge[a] = (place->corner_mm[0][a] + place->corner_mm[1][a]) / 2;
        bottom_edge[a] = (place->corner_mm[2][a] + place->corner_mm[3][a]) / 2;
    }
    direction(place->top, bottom_edge, top_edge);
    direction(right, place->corner_mm[0], place->corner_mm[1]);
    cross(across, right, place->top);
    direction(place->front, (const double[3]){0, 0, 0}, across);
}

double wall_place_distance_mm(const wall_place_t *place, const double at_mm[3])
{
    double from_centre[3];
    for (int a = 0; a < 3; a++)
        from_centre[a] = at_mm[a] - place->centre_mm[a];
    return dot(place->front, from_centre);
}

/* The quaternion of a rotation whose columns are the axes; the largest component is found first, so none divides by 0.
 */
static void quaternion_of(int32_t q30[4], const double axis[3][3])
{
    const double xx = axis[0][0], yy = axis[1][1], zz = axis[2][2];
    const double squares[4] = {1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz}; /* times 4 */
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (squares[i] > squares[largest])
            largest = i;
    const double wx = axis[1][2] - axis[2][1], wy = axis[2][0] - axis[0][2], wz = axis[0][1] - axis[1][0];
    const double xy = axis[0][1] + axis[1][0], xz = axis[0][2] + axis[2][0], yz = axis[1][2] + axis[2][1];
    const double products[4][4] = {{squares[0], wx, wy, wz}, /* times 4 */
                                   {wx, squares[1], xy, xz},
                                   {wy, xy, squares[2], yz},
                                   {wz, xz, yz, squares[3]}};
    const double scale = 2.0 * sqrt(squares[largest]); /* 4 times the largest component */
    for (int i = 0; i < 4; i++)
        q30[i] = (int32_t)lround(products[largest][i] / scale * (1 << 30));
}

pose_t wall_place_look(const wall_place_t *place, const double eye_mm[3], const double up[3])
{
    double axis[3][3], across[3]; /* right, down, forward */
    direction(axis[2], eye_mm, place->centre_mm);
    cross(across, axis[2], up);
    if (dot(across, across) < least_up * least_up)
        cross(across, axis[2], place->top);
    direction(axis[0], (const double[3]){0, 0, 0}, across);
    cross(axis[1], axis[2], axis[0]);
    pose_t pose;
    for (int a = 0; a < 3; a++)
        pose.eye_nm[a] = llround(eye_mm[a] * 1e6);
    quaternion_of(pose.quaternion_q30, (const double(*)[3])axis);
    return pose;
}
