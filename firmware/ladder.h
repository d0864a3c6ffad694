// SPDX-License-Identifier: Apache-2.0
// The cheaper methods that stand in for a method when a board is too slow for it, and what each costs.
#ifndef FIRMWARE_LADDER_H
#define FIRMWARE_LADDER_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/method.h"

enum { LADDER_STEPS = 5 };

/** A method, and then what stands in for it, best first. */
typedef struct {
    int32_t steps; /**< 1 to LADDER_STEPS */
    const warp_method_t *method[LADDER_STEPS];
} ladder_t;

/**
 * The steps down from a method. Each is the best of those that cost less:
 *
 *   mean+spline, auto, ls -> mean+cubic -> area -> none+linear -> none+nearest
 *   filter+any            ->               area -> none+linear -> none+nearest
 *   filter+nearest        ->                       none+linear -> none+nearest
 *   none+spline           -> none+cubic         -> none+linear -> none+nearest
 *
 * and the rest from where they stand in these rows. `area` takes the place of every filter: it does for each pixel
 * what the filter does for the worst one.
 *
 * @param method  Of warp_methods.
 */
ladder_t ladder_of(const warp_method_t *method);

/** @return Does the cost of any of its methods depend on a frame's step? */
bool ladder_needs_step(const ladder_t *ladder);

/** What the work of a frame depends on. */
typedef struct {
    int32_t lit_pixels, picture_pixels;
    int32_t k_q16; /**< step of the wall; 0 when none is known */
} ladder_frame_t;

/**
 * What a frame costs with a method, as the model in the .c file has it: counted on AArch64, XRGB, NEON. Good for
 * ratios between methods, to some 30 %, of frames that are lit for the most part.
 *
 * @return Thousands of instructions, at least 1; at most 2^28 for frames up to IMAGE_MAX_WIDTH x IMAGE_MAX_HEIGHT.
 */
uint32_t ladder_cost(const warp_method_t *method, const ladder_frame_t *frame);

#endif
