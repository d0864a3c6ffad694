// SPDX-License-Identifier: Apache-2.0
// Methods as points of a plane, sharpness across and flicker up: which are better in both.
#ifndef SIM_STUDY_FLICKER_POINTS_H
#define SIM_STUDY_FLICKER_POINTS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/method.h"

typedef struct {
    const char *name;
    double sharpness; /**< of the ideal */
    double flicker;   /**< gray levels */
} flicker_point_t;

/** All methods with one size, angle and picture. */
typedef struct {
    char text[120]; /**< which: "picture as large as the projector, 50 degrees, studio" */
    int32_t points;
    flicker_point_t point[WARP_METHODS];
} flicker_case_t;

/** Smaller differences are rounding: the eye's picture has whole gray levels. */
extern const double flicker_least_sharper, flicker_least_steadier;

/** @return Is it one of the adaptive family: area, mean+cubic, mean+spline? */
bool flicker_in_family(const char *name);

/** @return Is a both sharper and steadier than b? */
bool flicker_beats(const flicker_point_t *a, const flicker_point_t *b);

/** Pairs of a case and a method from outside the family that is better in both. */
typedef struct {
    int32_t pairs;                 /**< that were compared */
    int32_t defeats;               /**< of them */
    const flicker_case_t *worst;   /**< the defeat by most gray levels; NULL when there is none */
    const flicker_point_t *victor; /**< in it */
    const flicker_point_t *victim; /**< in it */
} flicker_defeats_t;

/**
 * Who is both sharper and steadier than a member of the family, or with NULL than each of them.
 *
 * @return Without pairs where the member is not; of a defeated family the steadiest is the victim.
 */
flicker_defeats_t flicker_defeats(const flicker_case_t *cases, int32_t count, const char *member);

#endif
