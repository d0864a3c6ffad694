// SPDX-License-Identifier: Apache-2.0
// What methods do on one wall for a viewer who walks: range of k, gap to the limit, cost.
#ifndef SIM_EVAL_WALL_ADVICE_H
#define SIM_EVAL_WALL_ADVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/room.h"

/** At which of all places methods are measured: those with the least, the median and the largest k. */
typedef enum { ADVICE_LEAST_K, ADVICE_MEDIAN_K, ADVICE_LARGEST_K, ADVICE_VIEWS } advice_view_t;

/** The error of rounding to 8 bits. A limit or a method above it is as good as exact: such gaps are 0. */
static const double advice_exact_db = 58.92;

/** Where the viewer's eye may be; it looks at the wall's centre from each place. */
typedef struct {
    const camera_t *camera;
    double (*eye_mm)[3];
    int32_t eyes;
    double up[3]; /**< of length 1 */
} advice_walk_t;

typedef struct {
    const room_board_t *board;
    int32_t too_near;    /**< places nearer than 0.3 m to the wall's plane: left out */
    int32_t unseen;      /**< other places from which no two neighbouring pixels are in the picture: left out */
    int32_t from_behind; /**< places among the rest that see a mirrored picture */
    int32_t places;      /**< the rest; everything below is set only if it is not 0 */
    pose_t pose[ADVICE_VIEWS];
    double k[ADVICE_VIEWS]; /**< as the board's `step` takes it */
    /** Means over the three views. */
    double gap_db[WARP_METHODS];          /**< below the limit; the truth is the picture's own pixels */
    double gap_original_db[WARP_METHODS]; /**< below the limit; the truth is an original 4 times as fine */
    double cost[WARP_METHODS];            /**< method_cost(); auto costs what it chooses */
} wall_advice_t;

/** Find the range of k. Gaps and costs are not touched. @return false when memory is out. */
bool wall_advice_survey(wall_advice_t *advice, const room_board_t *board, const advice_walk_t *walk);

/** @return The method that `auto` is at step k, for a viewer who comes from where it is mean+cubic. */
const warp_method_t *wall_advice_auto(double k);

/** Called before each method. */
typedef void advice_progress_fn(void *context, const wall_advice_t *advice, int32_t method);

/**
 * Measure every method at the three views with the product's own code, on leaves_picture(). Picture and projector are
 * both made smaller by one factor, to ADVICE_PIXELS at most: k stays as it is. Some 0.5 s, 60 MB.
 *
 * @param progress  May be NULL.
 * @return false when memory is out.
 */
bool wall_advice_measure(wall_advice_t *advice, const camera_t *camera, advice_progress_fn *progress, void *context);

enum { ADVICE_PIXELS = 480 * 270, ADVICE_FINER = 4 };

#endif
