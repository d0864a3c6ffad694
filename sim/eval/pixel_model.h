// SPDX-License-Identifier: Apache-2.0
// Beyond the paper's mesh: light that is uneven within a projector pixel, and a wall that does not reflect evenly.
#ifndef SIM_EVAL_PIXEL_MODEL_H
#define SIM_EVAL_PIXEL_MODEL_H

#include <stdint.h>

/** Light within a projector pixel: along each axis (1 + falloff cos(2 pi x / fill)) / fill within fill / 2 of the
 * pixel's middle and 0 outside, x in pixels from there. The mean over the pixel is 1. */
typedef struct {
    double fill;    /**< lit part of the pixel's side, above 0 to 1: less leaves a dark gap */
    double falloff; /**< 0 even, to 1: dark at the lit square's edge */
} pixel_profile_t;

/** Light that a wall throws to the eye, 1 for a matt white one: diffuse + lobe cos(angle)^exponent, the angle being
 * that between the eye and the mirrored ray from the projector; above 90 degrees the lobe is 0. */
typedef struct {
    double diffuse, lobe, exponent;
    double projector_m[3]; /**< where the projector's lens is, world */
} pixel_screen_t;

typedef struct {
    pixel_profile_t profile;
    pixel_screen_t screen;
} pixel_model_t;

/**
 * The mean light from one place to another along one axis; both axes' means multiply.
 *
 * @param from  Panel pixels, pixel i from i to i + 1.
 * @param to    The same; more than from.
 */
double pixel_profile_mean(const pixel_profile_t *profile, double from, double to);

/** @return Light towards the eye from a point of the wall, all in metres. @param normal  Of any length, either side. */
double pixel_screen_gain(const pixel_screen_t *screen, const double point_m[3], const double normal[3],
                         const double eye_m[3]);

#endif
