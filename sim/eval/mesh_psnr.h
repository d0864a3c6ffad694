// SPDX-License-Identifier: Apache-2.0
// The paper's mesh evaluation: how well what a wall shows, seen from the viewer's eye, matches the true picture.
//
// Every projector pixel is a polygon of one gray level in the viewer's picture. The true picture, and these polygons,
// are sampled S x S times per picture pixel; PSNR is taken over the samples that hit the lit panel. A sample's place
// does not depend on the method under test, so the samples of each projector pixel are summed up once, and each method
// then costs one pass over the panel.
#ifndef SIM_EVAL_MESH_PSNR_H
#define SIM_EVAL_MESH_PSNR_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "sim/files/file_io.h"
#include "warp_fixed/image.h"

enum { MESH_MAX_FACTOR = 64 };

/** The true picture's samples within one projector pixel. */
typedef struct {
    int64_t count;
    int64_t sum;
} mesh_cell_t;

typedef struct {
    int32_t panel_width, panel_height;
    int64_t samples;        /**< of the whole picture */
    int64_t covered;        /**< of them on the panel, in front of the viewer */
    int64_t sum_of_squares; /**< of the covered ones */
    mesh_cell_t *cell;      /**< panel_width * panel_height, row by row */
} mesh_t;

/**
 * Sample the true picture and sum up by projector pixel. About 5 ns per sample; 16 bytes per projector pixel.
 *
 * @param[out] mesh        Written only when true is returned; to be given to mesh_free().
 * @param      homography  From the panel under test to the viewer's picture.
 * @param      truth       GRAY8: the picture itself, or a finer original: q times as wide and as high, q >= 1.
 * @param      factor      S: samples per picture pixel along each axis, 1 to MESH_MAX_FACTOR, a multiple of q.
 * @param[out] error       On failure: which of these conditions is broken, in one line.
 */
bool mesh_sample(mesh_t *mesh, const double_homography_t *homography, const image_t *truth, int32_t factor,
                 char error[FILE_ERROR_LENGTH]);

/** Give back its memory. */
void mesh_free(mesh_t *mesh);

/**
 * @param panel  GRAY8, of the panel's size: what the projector shows.
 * @return PSNR over the covered samples, dB, peak 255; infinity when none differs (also when none is covered).
 */
double mesh_psnr_db(const mesh_t *mesh, const image_t *panel);

/**
 * Fill a panel with what no method can beat: the mean of the true picture within each projector pixel, rounded half up.
 *
 * @param panel  GRAY8, of the panel's size. Pixels without a sample become 0.
 */
void mesh_limit(const mesh_t *mesh, const image_t *panel);

/** @return Covered samples over all samples, 0 to 1. */
double mesh_coverage(const mesh_t *mesh);

#endif
