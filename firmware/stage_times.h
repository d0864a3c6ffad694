// SPDX-License-Identifier: Apache-2.0
// What the stages of the loop take: mean and worst of each over the last second.
#ifndef FIRMWARE_STAGE_TIMES_H
#define FIRMWARE_STAGE_TIMES_H

#include <stdbool.h>
#include <stdint.h>

/** The stages of a step, in order; together they are all the time there is. */
typedef enum {
    STAGE_POSE, /**< bus and camera: the newest checked pose and picture */
    STAGE_WARP, /**< pose and picture -> panel: homography, grid, prefilter, resample; or the safe picture */
    STAGE_SHOW, /**< the picture is handed to the display */
    STAGE_WAIT, /**< telemetry, and then the wait for the vertical blank, up to the next step */
    STAGES
} stage_t;

/** What one step took. */
typedef struct {
    int64_t us[STAGES];
    bool shown; /**< a picture was handed to the display */
    bool late;  /**< after the vertical blank that it was made for */
} stage_step_t;

/** Figures over some time. */
typedef struct {
    uint32_t mean_us[STAGES], worst_us[STAGES]; /**< means are rounded down; 0 when there was no step */
    uint32_t shown, late;                       /**< pictures; of them late */
} stage_figures_t;

/** Of the steps since the last stage_times_close(). */
typedef struct {
    int64_t sum_us[STAGES], worst_us[STAGES];
    uint32_t steps, shown, late;
} stage_times_t;

/** Begin to count. */
void stage_times_init(stage_times_t *times);

/** Count a step. Times from 0 up to an hour; a negative one counts as 0, a longer one as an hour. */
void stage_times_add(stage_times_t *times, const stage_step_t *step);

/** @return The figures of all steps since the last call, or since the start; they begin anew. */
stage_figures_t stage_times_close(stage_times_t *times);

#endif
