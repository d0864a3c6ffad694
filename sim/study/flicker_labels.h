// SPDX-License-Identifier: Apache-2.0
// A plot whose points all have names: axes around them, and a free place for each name.
#ifndef SIM_STUDY_FLICKER_LABELS_H
#define SIM_STUDY_FLICKER_LABELS_H

#include "sim/study/flicker_points.h"

enum { FLICKER_SETUP_LENGTH = 16384 };

/** What a plot shows, and its size: labels are placed in pixels. */
typedef struct {
    double sharpness[2], flicker[2]; /**< from, to */
    int32_t width, height;           /**< pixels */
} flicker_axes_t;

/** @return Axes around the points, with room for their labels. */
flicker_axes_t flicker_axes(const flicker_case_t *of);

/**
 * Write gnuplot commands that fix the axes and name every point, no name upon another or upon a point.
 *
 * Points in one place share a label: "mean+cubic and 3 more". The family's members are named first.
 *
 * @param[out] setup  Always a complete string.
 */
void flicker_labels(char setup[FLICKER_SETUP_LENGTH], const flicker_axes_t *axes, const flicker_case_t *of);

#endif
