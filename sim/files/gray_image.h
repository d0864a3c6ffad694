// SPDX-License-Identifier: Apache-2.0
// GRAY8 pictures in memory of their own, and the means that make a picture of a finer one.
#ifndef SIM_FILES_GRAY_IMAGE_H
#define SIM_FILES_GRAY_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

/**
 * Make a GRAY8 picture, all 0.
 *
 * @param[out] image  The caller frees image->data, which is NULL when false is returned.
 * @return false when memory is out.
 */
bool gray_image(image_t *image, int32_t width, int32_t height);

/**
 * Fill a picture with the middle of a finer one, each pixel the mean of factor x factor, rounded half up.
 *
 * @param finer   At least factor times as wide and as high.
 * @param factor  1 or more.
 */
void gray_image_means(const image_t *image, const image_t *finer, int32_t factor);

#endif
