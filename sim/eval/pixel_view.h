// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation with uneven pixels and walls: how well the seen light matches the true picture.
#ifndef SIM_EVAL_PIXEL_VIEW_H
#define SIM_EVAL_PIXEL_VIEW_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "sim/eval/pixel_model.h"
#include "warp_fixed/image.h"

enum { PIXEL_VIEW_MAX_FACTOR = 64, PIXEL_VIEW_NO_WALL = UINT16_MAX };

/** What one sample sees. */
typedef struct {
    uint16_t x, y; /**< its projector pixel; x is PIXEL_VIEW_NO_WALL off the wall */
    float profile; /**< light there against the pixel's mean */
    float gain;    /**< light that the wall throws to the eye from there */
} pixel_sample_t;

/** Factor x factor samples of each picture pixel. */
typedef struct {
    int32_t width, height, factor; /**< of the picture, and samples along each side of its pixels */
    pixel_sample_t *sample;        /**< row by row */
    int64_t covered;
    double mean_gain; /**< over the covered samples; 0 when there is none */
    double *field;    /**< scratch of pixel_view_psnr() */
} pixel_view_t;

/**
 * Trace the samples. 12 bytes and some 50 ns for each.
 *
 * @param[out] view    Written only when true is returned; to be given to pixel_view_free().
 * @param      wall    The one that the homography was made with.
 * @param      eye_m   Where the eye is, world, metres.
 * @param      factor  2 to PIXEL_VIEW_MAX_FACTOR, even.
 * @return false when memory is out.
 */
bool pixel_view(pixel_view_t *view, const double_homography_t *homography, const wall_t *wall, const double eye_m[3],
                const pixel_model_t *model, int32_t factor);

void pixel_view_free(pixel_view_t *view);

/**
 * PSNR in dB, peak 255. Light is in gray levels, not rounded, divided by the wall's mean gain: the eye adapts. Infinity
 * where nothing differs, or nothing is covered.
 */
typedef struct {
    double fine;   /**< sample by sample, against the true picture on the same wall: sees the pixels' own shape */
    double eye;    /**< the same after the eye's blur, which hides single pixels: 1 4 6 4 1 along each axis on means of
                        half a picture pixel, where all of this is covered */
    double uneven; /**< as eye, but against the true picture on an even wall */
} pixel_psnr_t;

/**
 * @param view   One thread at a time.
 * @param panel  GRAY8, of the panel's size: what the projector shows.
 * @param truth  GRAY8: the picture.
 */
pixel_psnr_t pixel_view_psnr(const pixel_view_t *view, const image_t *panel, const image_t *truth);

#endif
