// SPDX-License-Identifier: Apache-2.0
// Everything that was measured during a run, frame by frame: for the tables, the plots and the page.
#ifndef SIM_RUN_RUN_RECORD_H
#define SIM_RUN_RUN_RECORD_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/projector.h"
#include "firmware/room.h"

/** One board in one frame. */
typedef struct {
    projector_report_t report;
    int64_t step_time_us; /**< of this machine, real time */
} run_wall_t;

/** One frame: one step of every board. */
typedef struct {
    int64_t time_us;      /**< since the start of the run */
    int32_t bus_load_ppm; /**< since the frame before, or since the start */
    bool seen;            /**< a board has drawn for a pose: eye is that pose, and there are viewer pictures */
    pose_t eye;
    uint8_t leader;       /**< node of the board that leads; 0: none */
    bool housed;          /**< it has the house's genlock signal */
    int32_t house_off_us; /**< the newest edge, less the begin of the refresh nearest to it; 0 without */
} run_frame_t;

/** What is measured in dB. The limit is what no method can beat. */
typedef enum {
    RUN_DB_PSNR, /**< against the camera's picture, its pixels as squares */
    RUN_DB_LIMIT,
    RUN_DB_ORIGINAL_PSNR, /**< against the finer original */
    RUN_DB_ORIGINAL_LIMIT,
    RUN_DBS
} run_db_t;

/** One judged wall. */
typedef struct {
    int32_t frame, board;
    double coverage;    /**< share of the viewer's picture on this wall, 0 to 1 */
    double db[RUN_DBS]; /**< INFINITY where nothing differs; NAN where there is no original */
} run_psnr_t;

typedef struct {
    int32_t boards;
    int32_t frames, frame_capacity;
    run_frame_t *frame;
    run_wall_t *wall; /**< wall[frame * boards + board] */
    int32_t psnrs, psnr_capacity;
    run_psnr_t *psnr; /**< by frame, then by board, once the run is over */
} run_record_t;

/** One board over the whole run. */
typedef struct {
    bool drawn;             /**< it has shown corrected pictures: k and lit mean something */
    double k_least, k_most; /**< step k over pixels in the picture */
    double lit_share;       /**< mean share of the panel that shows picture */
    double step_ms_mean, step_ms_most;
    double latency_ms;  /**< mean pose to photon of the frames in step; NAN where there is none */
    int32_t judged;     /**< frames */
    double db[RUN_DBS]; /**< means over the judged frames with a finite value; NAN where there is none */
} run_board_sum_t;

/** The house's genlock signal over the whole run. */
typedef struct {
    uint8_t leader; /**< of the last frame; 0: none */
    int32_t frames; /**< in which the board that led had the signal */
    double off_us_mean;
    int32_t off_us_most; /**< sizes, from the edges to the begins of refreshes */
} run_house_t;

/** Add an empty frame and its walls. @return false when memory is out; nothing is added then. */
bool run_record_add_frame(run_record_t *record);

/** Add a judged wall. @return false when memory is out. */
bool run_record_add_psnr(run_record_t *record, const run_psnr_t *psnr);

/** Put the judged walls in order. */
void run_record_sort(run_record_t *record);

/** Give the memory back. */
void run_record_free(run_record_t *record);

/** How the boards agreed. */
typedef struct {
    int64_t refreshes, in_step; /**< of all boards; of them in step */
    int64_t differing;          /**< frames in which boards in step did not show the same picture for the same pose */
    double latency_ms_mean, latency_ms_most; /**< pose to photon, of those in step; 0 when none was */
} run_agreement_t;

run_agreement_t run_record_agreement(const run_record_t *record);

/** @return Who leads, and how far the house's genlock signal was. */
run_house_t run_record_house(const run_record_t *record);

/** @return The figures of one board, taken over all frames. */
run_board_sum_t run_record_board(const run_record_t *record, int32_t board, const wall_t *wall);

enum { RUN_POSE_TEXT_LENGTH = 160 };

/** Write a pose so that pose_from_text() reads it back: "x_mm y_mm z_mm qw qx qy qz". */
void run_pose_text(char text[RUN_POSE_TEXT_LENGTH], const pose_t *pose);

#endif
