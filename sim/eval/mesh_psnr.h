// SPDX-License-Identifier: Apache-2.0
// The paper's mesh evaluation: how well what a wall shows, seen from the viewer's eye, matches the true picture.
//
// Every projector pixel is a polygon of one gray level in the viewer's picture. The true picture, and these polygons,
// are sampled S x S times per picture pixel; PSNR is taken over the samples that hit the lit panel. A sample's place
// does not depend on the method under test, so the samples of each projector pixel are summed up once, and each method
// then costs one pass over the panel.
//
// Pictures and panels: the first byte of each pixel counts, so GRAY8, or one channel of XRGB8888 (mesh_channel()).
#ifndef SIM_EVAL_MESH_PSNR_H
#define SIM_EVAL_MESH_PSNR_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "sim/files/file_io.h"
#include "warp_fixed/image.h"

enum { MESH_MAX_FACTOR = 64, MESH_MAX_WALLS = 32 };

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

/** @return The same picture, seen from byte `byte` of each pixel on. */
image_t mesh_channel(const image_t *image, int byte);

/**
 * Sample the true picture and sum up by projector pixel. About 5 ns per sample; 16 bytes per projector pixel.
 *
 * @param[out] mesh        Written only when true is returned; to be given to mesh_free().
 * @param      homography  From the panel under test to the viewer's picture.
 * @param      truth       The picture itself, or a finer original: q times as wide and as high, q >= 1.
 * @param      factor      S: samples per picture pixel along each axis, 1 to MESH_MAX_FACTOR, a multiple of q.
 * @param[out] error       On failure: which of these conditions is broken, in one line.
 */
bool mesh_sample(mesh_t *mesh, const double_homography_t *homography, const image_t *truth, int32_t factor,
                 char error[FILE_ERROR_LENGTH]);

/**
 * The same for several walls of one viewer's picture (fig 6): a sample belongs to the nearest wall in its way, and to
 * the first of equally near ones, as for the eye of viewer_picture(). About 5 ns per sample and wall.
 *
 * @param[out] mesh        One per wall, 16 bytes per projector pixel of each.
 * @param      homography  One per wall, all with the same picture.
 * @param      walls       1 to MESH_MAX_WALLS.
 */
bool mesh_sample_walls(mesh_t *mesh, const double_homography_t *homography, int32_t walls, const image_t *truth,
                       int32_t factor, char error[FILE_ERROR_LENGTH]);

/** Give back its memory. */
void mesh_free(mesh_t *mesh);

/**
 * @param panel  Of the panel's size: what the projector shows.
 * @return Sum over the covered samples of (true - shown)^2, exact.
 */
int64_t mesh_square_error(const mesh_t *mesh, const image_t *panel);

/** @return PSNR over so many samples, dB, peak 255; infinity when the error is 0 (also without samples). */
double mesh_db(double square_error, int64_t samples);

/** @return mesh_db() of the panel over its covered samples. */
double mesh_psnr_db(const mesh_t *mesh, const image_t *panel);

/**
 * Fill a panel with what no method can beat: the mean of the true picture within each projector pixel, rounded half up.
 *
 * @param panel  Of the panel's size. Pixels without a sample become 0; other bytes of its pixels stay.
 */
void mesh_limit(const mesh_t *mesh, const image_t *panel);

/** @return Covered samples over all samples, 0 to 1. */
double mesh_coverage(const mesh_t *mesh);

#endif
