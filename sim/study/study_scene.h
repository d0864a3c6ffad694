// SPDX-License-Identifier: Apache-2.0
// The study's room: one wall, its viewer's camera, the pictures it shows, and the product's own warp.
#ifndef SIM_STUDY_STUDY_SCENE_H
#define SIM_STUDY_STUDY_SCENE_H

#include <stdbool.h>
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

/** The pictures of the study. */
typedef enum {
    STUDY_STUDIO,
    STUDY_ASTRONAUT,
    STUDY_COFFEE,
    STUDY_CHECKERBOARD,
    STUDY_NOISE,
    STUDY_IMAGES
} study_image_t;

/** @return "studio", ... */
const char *study_image_name(study_image_t image);

/**
 * A GRAY8 picture of any size and, if asked for, its finer original of factor times that size.
 *
 * Photographs are means of their pixels where they must be made smaller (whole factors) and cut to the middle.
 *
 * @param[out] picture   The caller frees its data.
 * @param[out] original  The same, or NULL; the picture is then the original's factor x factor means, rounded half up.
 * @return false when memory is out, or the size can't be had: larger than the photograph allows.
 */
bool study_image(study_image_t image, int32_t width, int32_t height, int32_t factor, image_t *picture,
                 image_t *original);

/** Prepare the product's own warp, one per thread, malloc(sizeof *warp): k over pixels in the picture, border black. */
void study_warp_begin(warp_t *warp, const warp_method_t *method);

/** Warp a picture. @param panel  GRAY8, of the panel's size. */
void study_warp_frame(warp_t *warp, const homography_t *homography, const image_t *picture, const image_t *panel);

#endif
