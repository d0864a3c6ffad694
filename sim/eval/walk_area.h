// SPDX-License-Identifier: Apache-2.0
// Where a viewer walks in a room: which way is up, how high the eye is, and a grid of places.
#ifndef SIM_EVAL_WALK_AREA_H
#define SIM_EVAL_WALK_AREA_H

#include <stdint.h>

#include "sim/eval/wall_place.h"

enum {
    WALK_SIDE = 7, /**< places along each side of an area */
    WALK_PLACES = WALK_SIDE * WALK_SIDE,
    WALK_DEFAULT_HEIGHT_MM = 1700
};

/** One of the world's six axis directions. */
typedef struct {
    int axis; /**< 0, 1, 2: x, y, z */
    int sign; /**< 1 or -1 */
} walk_up_t;

/** A rectangle that is level with the floor; its sides are along the two other axes, in the order x, y, z. */
typedef struct {
    double low_mm[2], high_mm[2];
} walk_area_t;

/** @return "x", "-y", ... */
const char *walk_up_name(walk_up_t up);

/** @return The direction in which most walls have the tops of their pictures. Of equal ones y comes first, then z. */
walk_up_t walk_up(const wall_place_t *wall, int32_t walls);

/** @return Place of the eye along up's axis, mm: so high above the lowest corner of all walls. */
double walk_eye_mm(const wall_place_t *wall, int32_t walls, walk_up_t up, double height_mm);

/**
 * The rectangle around all walls, 0.5 m inside of it on every side (its middle where it is narrower than 1 m). Where
 * the walls lie within less than 2 m of each other (a single wall), it first grows to their fronts: by its other side,
 * at least by 3 m.
 */
walk_area_t walk_area(const wall_place_t *wall, int32_t walls, walk_up_t up);

/**
 * The eye at one place of the grid that covers an area up to its edges.
 *
 * @param place  0 to WALK_PLACES - 1.
 */
void walk_place(double eye_mm[3], const walk_area_t *area, walk_up_t up, double at_eye_mm, int32_t place);

#endif
