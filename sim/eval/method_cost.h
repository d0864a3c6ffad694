// SPDX-License-Identifier: Apache-2.0
// A simple model of what a method costs: how many numbers it multiplies, from its definition.
#ifndef SIM_EVAL_METHOD_COST_H
#define SIM_EVAL_METHOD_COST_H

/** What the work depends on. */
typedef struct {
    double k;                 /**< step of the wall (eq 4) */
    double side_px;           /**< mean side of a projector pixel's footprint, picture pixels */
    double picture_per_panel; /**< pixels of the picture per pixel of the projector */
} method_cost_place_t;

/**
 * Texels read per lit projector pixel, plus filter taps per picture pixel times the picture pixels per projector pixel.
 * none+nearest costs 1. With s = side_px, and n for the filter's half length (0 where k <= 1: no filter):
 *
 *   nearest 1, linear 4, cubic, spline and ls 16; area (s + 1)^2; mean+cubic, mean+spline (sqrt(s^2 - 1) + 4)^2
 *   gauss n = ceil(4 sigma), sigma = k sqrt(ln 2) / pi; kaiser n = ceil(6 k); butter n = ceil(8 k): 2 (2 n + 1) taps
 *   spline, mean+spline: 4 taps (one recursion up, one down, both axes)
 *   ls: 2 (16 + 4 / k) taps (both axes: four rotations of each pixel into the right side, 4 for each coefficient)
 *
 * It ranks methods on one wall; it does not count cycles.
 *
 * @return The cost, or NAN for another name (auto, say: it costs what it chooses).
 */
double method_cost(const char *name, const method_cost_place_t *place);

#endif
