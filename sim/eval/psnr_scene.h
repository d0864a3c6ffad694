// SPDX-License-Identifier: Apache-2.0
// What wallwarp-eval psnr measures on: the walls that one viewer sees, the picture, the truth, and its samples.
#ifndef SIM_EVAL_PSNR_SCENE_H
#define SIM_EVAL_PSNR_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/eval/psnr_options.h"
#include "sim/eval/psnr_row.h"
#include "sim/eval/warp_once.h"

enum {
    PSNR_FORMATS = 2, /**< GRAY8, and for R, G and B XRGB8888 */
    PSNR_CHANNELS = 4 /**< Y, R, G, B; without --channels only the first */
};

typedef struct {
    warp_once_t wall[ROOM_MAX_BOARDS];
    int32_t walls, channels;
    image_t picture[PSNR_FORMATS], truth[PSNR_FORMATS]; /**< the same memory without --original */
    mesh_t mesh[PSNR_CHANNELS][ROOM_MAX_BOARDS];
    int64_t limit_square_error[PSNR_CHANNELS][ROOM_MAX_BOARDS];
    uint8_t *shown; /**< the panel of the wall at work */
} psnr_scene_t;

/**
 * Open walls, read pictures, sample the truth.
 *
 * @param[out] scene    To be given to psnr_scene_close(), whatever is returned.
 * @param      command  As it begins error messages; what fails is said on stderr.
 * @return An exit status.
 */
warp_once_status_t psnr_scene_open(psnr_scene_t *scene, const psnr_options_t *options, const char *command);

void psnr_scene_close(psnr_scene_t *scene);

/**
 * Correct the picture for every wall and measure it in every channel.
 *
 * @param      method  NULL for the limit.
 * @param[out] row     Without the names of board and channel. What lies beyond walls and channels stays.
 * @return false when a frame could not be made.
 */
bool psnr_scene_measure(psnr_scene_t *scene, const warp_method_t *method,
                        psnr_row_t row[ROOM_MAX_BOARDS][PSNR_CHANNELS]);

/** @return "Y", "R", "G" or "B". */
const char *psnr_channel_name(int32_t channel);

#endif
