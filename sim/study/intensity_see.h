// SPDX-License-Identifier: Apache-2.0
// One picture on one wall from one angle, with every method, seen through each model of pixels and wall.
#ifndef SIM_STUDY_INTENSITY_SEE_H
#define SIM_STUDY_INTENSITY_SEE_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/study/study_scene.h"

enum { INTENSITY_MODELS = 6, INTENSITY_FACTOR = 8, INTENSITY_ROWS = WARP_METHODS + 1 };

/** A pixel's fill and falloff, and a wall's diffuse light and lobe: see pixel_model.h. The first is the paper's. */
typedef struct {
    const char *name;
    double fill, falloff, diffuse, lobe;
} intensity_model_t;

extern const intensity_model_t intensity_models[INTENSITY_MODELS];

/** Of every wall's lobe, and where the projector is, world. */
extern const double intensity_exponent, intensity_projector_m[3];

/** PSNR in dB in the three ways of pixel_psnr_t: a row for each method, then one for the paper's limit. */
typedef struct {
    double eye_db[INTENSITY_ROWS], fine_db[INTENSITY_ROWS], uneven_db[INTENSITY_ROWS];
    double gain; /**< of the wall, mean over the view */
} intensity_seen_t;

typedef struct {
    const study_scene_t *scene;
    const image_t *picture;
    double angle_deg;
    const warp_method_t *const *method;
    int32_t methods;
} intensity_place_t;

/** @param[out] seen  INTENSITY_MODELS places. @return false when memory is out. */
bool intensity_see(intensity_seen_t *seen, const intensity_place_t *place);

#endif
