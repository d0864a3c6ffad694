// SPDX-License-Identifier: Apache-2.0
// The pictures of one frame of a run: what the walls show, what the viewer sees, and how good it is.
#ifndef SIM_RUN_RUN_DRAW_H
#define SIM_RUN_RUN_DRAW_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/files/file_io.h"
#include "sim/run/run_record.h"
#include "warp_fixed/image.h"

/** The same for all frames. */
typedef struct {
    const room_t *room;
    const char *folder;      /**< where the files go; it exists */
    const image_t *original; /**< GRAY8: a finer original of the camera's picture; NULL for none */
} run_draw_config_t;

/** One frame, with copies of its pictures. */
typedef struct {
    int32_t frame;
    bool seen;  /**< eye means something */
    bool judge; /**< measure PSNR */
    pose_t eye;
    bool corrected[ROOM_MAX_BOARDS]; /**< the wall shows this picture, made for the eye; not one that is held back */
    image_t shown[ROOM_MAX_BOARDS];  /**< XRGB8888, of the panels' sizes */
    image_t picture;                 /**< XRGB8888: what the camera delivered */
} run_job_t;

/** Size of the viewer's pictures: the camera's, or half of it while that is wider than this. */
enum { RUN_DRAW_VIEWER_WIDTH = 1280 };

/**
 * Make a picture of the viewer's size.
 *
 * @param[out] viewer  Written only on success; the caller frees viewer->data.
 * @return false when memory is out.
 */
bool run_draw_viewer(image_t *viewer, const camera_t *camera);

enum { RUN_DRAW_PATH_LENGTH = 4096 };

/**
 * The path of a numbered picture: FOLDER/NAME_NNNNN.png.
 *
 * @param[out] error  On failure: the path is too long.
 */
bool run_draw_path(char path[RUN_DRAW_PATH_LENGTH], const char *folder, const char *name, int32_t frame,
                   char error[FILE_ERROR_LENGTH]);

/**
 * Write FOLDER/BOARD_NNNNN.png for each board and, when there is an eye, viewer_NNNNN.png: what it sees, and
 * uncompensated_NNNNN.png: what it would see if the camera's picture went straight to every projector.
 *
 * @param      viewer  Scratch from run_draw_viewer().
 * @param[out] psnr    ROOM_MAX_BOARDS places for what was judged: each wall that covers part of the view.
 * @param[out] psnrs   How many; 0 when the job was not to be judged.
 * @param[out] error   On failure: one line.
 * @return false when a file could not be written, or memory is out.
 */
bool run_draw(const run_draw_config_t *config, const run_job_t *job, const image_t *viewer, run_psnr_t *psnr,
              int32_t *psnrs, char error[FILE_ERROR_LENGTH]);

#endif
