// SPDX-License-Identifier: Apache-2.0
// The pictures of the study: photographs kept in the program, and made ones.
#ifndef SIM_STUDY_STUDY_IMAGE_H
#define SIM_STUDY_STUDY_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

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

#endif
