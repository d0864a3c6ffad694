// SPDX-License-Identifier: Apache-2.0
// Where a viewer walks in a room: which way is up, how high the eye is, and a grid of places.
#include "sim/eval/walk_area.h"

#include <math.h>

static const double margin_mm = 500.0, narrow_mm = 2000.0, least_reach_mm = 3000.0;

const char *walk_up_name(walk_up_t up)
{
    static const char *const names[2][3] = {{"-x", "-y", "-z"}, {"x", "y", "z"}};
    return names[up.sign > 0][up.axis];
}

walk_up_t walk_up(const wall_place_t *wall, int32_t walls)
{
    static const int order[3] = {1, 2, 0};
    static const double same = 1e-6;
    double sum[3] = {0};
    for (int32_t n = 0; n < walls; n++)
        for (int a = 0; a < 3; a++)
            sum[a] += wall[n].top[a];
    int best = order[0];
    for (int i = 1; i < 3; i++)
        if (fabs(sum[order[i]]) > fabs(sum[best]) + same)
            best = order[i];
    return (walk_up_t){best, sum[best] < 0.0 ? -1 : 1};
}

/* The lowest and the highest corner along an axis. */
static void span(const wall_place_t *wall, int32_t walls, int axis, double *low_mm, double *high_mm)
{
    *low_mm = *high_mm = wall[0].corner_mm[0][axis];
    for (int32_t n = 0; n < walls; n++)
        for (int c = 0; c < 4; c++) {
            *low_mm = fmin(*low_mm, wall[n].corner_mm[c][axis]);
            *high_mm = fmax(*high_mm, wall[n].corner_mm[c][axis]);
        }
}

double walk_eye_mm(const wall_place_t *wall, int32_t walls, walk_up_t up, double height_mm)
{
    double low_mm, high_mm;
    span(wall, walls, up.axis, &low_mm, &high_mm);
    return up.sign > 0 ? low_mm + height_mm : high_mm - height_mm;
}

/* The area's side s is along this axis. */
static int axis_of(walk_up_t up, int s)
{
    return s < up.axis ? s : s + 1;
}

/* Which way the walls face along an axis: -1, 1, or 0 where most are across it. */
static int facing(const wall_place_t *wall, int32_t walls, int axis)
{
    double sum = 0.0;
    for (int32_t n = 0; n < walls; n++)
        sum += wall[n].front[axis];
    return fabs(sum) < 0.5 * walls ? 0 : sum < 0.0 ? -1 : 1;
}

walk_area_t walk_area(const wall_place_t *wall, int32_t walls, walk_up_t up)
{
    walk_area_t area;
    for (int s = 0; s < 2; s++)
        span(wall, walls, axis_of(up, s), &area.low_mm[s], &area.high_mm[s]);
    const double size_mm[2] = {area.high_mm[0] - area.low_mm[0], area.high_mm[1] - area.low_mm[1]};
    for (int s = 0; s < 2; s++) {
        const double reach_mm = fmax(size_mm[1 - s], least_reach_mm);
        const int front = size_mm[s] < narrow_mm ? facing(wall, walls, axis_of(up, s)) : 0;
        area.low_mm[s] -= front < 0 ? reach_mm : 0.0;
        area.high_mm[s] += front > 0 ? reach_mm : 0.0;
        const double inside_mm = fmin(margin_mm, (area.high_mm[s] - area.low_mm[s]) / 2);
        area.low_mm[s] += inside_mm;
        area.high_mm[s] -= inside_mm;
    }
    return area;
}

void walk_place(double eye_mm[3], const walk_area_t *area, walk_up_t up, double at_eye_mm, int32_t place)
{
    const int32_t step[2] = {place % WALK_SIDE, place / WALK_SIDE};
    eye_mm[up.axis] = at_eye_mm;
    for (int s = 0; s < 2; s++)
        eye_mm[axis_of(up, s)] = area->low_mm[s] + (area->high_mm[s] - area->low_mm[s]) * step[s] / (WALK_SIDE - 1);
}
