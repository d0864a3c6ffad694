// SPDX-License-Identifier: Apache-2.0
// How good a shown wall is: PSNR seen from the viewer's eye, against the truth and against the limit of any method.
#ifndef SIM_RUN_RUN_JUDGE_H
#define SIM_RUN_RUN_JUDGE_H

#include "sim/files/file_io.h"
#include "sim/run/run_record.h"
#include "warp_fixed/image.h"

/** What a wall is judged by. */
typedef struct {
    const homography_t *homography; /**< from the panel to the viewer's picture */
    const image_t *shown;           /**< XRGB8888: what the projector shows; its luma is judged */
    const image_t *picture;         /**< XRGB8888: the camera's picture */
    const image_t *original;        /**< GRAY8: a finer original, q times as wide and as high; NULL for none */
} run_judge_t;

/**
 * Judge a wall by the mesh evaluation (sim/eval/mesh_psnr.h).
 *
 * Samples per picture pixel along each axis: 4 where the panel has no more pixels than the picture, 16 where it has 3
 * times as many or more, else 8 (along the axis with most); rounded up to a multiple of q. Uses the heap.
 *
 * @param[in,out] psnr   On success everything but frame and board is written.
 * @param[out]    error  On failure: one line.
 */
bool run_judge(run_psnr_t *psnr, const run_judge_t *wall, char error[FILE_ERROR_LENGTH]);

#endif
