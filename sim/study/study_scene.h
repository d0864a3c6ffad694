// SPDX-License-Identifier: Apache-2.0
// The study's room: one wall, its viewer's camera, and the product's own warp.
#ifndef SIM_STUDY_STUDY_SCENE_H
#define SIM_STUDY_STUDY_SCENE_H

#include <stdint.h>

#include "sim/study/study_pose.h"
#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/image.h"
#include "warp_fixed/method.h"
#include "warp_fixed/wall_from_corners.h"
#include "warp_fixed/warp.h"

/** Sizes in pixels. */
typedef struct {
    int32_t picture_width, picture_height;
    int32_t panel_width, panel_height;
} study_sizes_t;

/** A wall of 4 m x 2.25 m, its centre the origin, seen by a camera whose picture is the wall at 2.5 m straight on. */
typedef struct {
    camera_t camera;
    wall_t wall;
} study_scene_t;

void study_scene(study_scene_t *scene, const study_sizes_t *sizes);

/** Prepare the product's own warp, one per thread, malloc(sizeof *warp): k over pixels in the picture, border black. */
void study_warp_begin(warp_t *warp, const warp_method_t *method);

/** Warp a picture. @param panel  GRAY8, of the panel's size. */
void study_warp_frame(warp_t *warp, const homography_t *homography, const image_t *picture, const image_t *panel);

#endif
