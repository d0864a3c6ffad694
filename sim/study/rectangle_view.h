// SPDX-License-Identifier: Apache-2.0
// A white rectangle on the study's wall, and how rectangular the viewer sees it.
#ifndef SIM_STUDY_RECTANGLE_VIEW_H
#define SIM_STUDY_RECTANGLE_VIEW_H

#include "sim/study/rectangle.h"
#include "sim/study/study_scene.h"

/** What is looked at. The rectangle is 28 % of the picture's width and height, in its middle; its edges may be gray. */
typedef struct {
    int32_t width, height; /**< of picture, projector and viewer's view, pixels */
    int32_t samples;       /**< of the viewer's view per pixel and axis, as viewer_picture() has it */
    pose_t eye;            /**< where the viewer is */
    pose_t tracked;        /**< where the tracker says the viewer is */
    bool compensated;      /**< corrected by the product's warp, or else shown straight on the wall */
} rectangle_view_t;

typedef struct {
    rectangle_shape_t geometry; /**< from the corners' way through the fixed-point grid and the eye's homography */
    rectangle_shape_t seen;     /**< from the corners found in the rendered view */
} rectangle_views_t;

/** Measure both. @return false when memory is out, or when no rectangle is found in the view. */
bool rectangle_view(rectangle_views_t *views, const rectangle_view_t *view);

#endif
