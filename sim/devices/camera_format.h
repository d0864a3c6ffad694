// SPDX-License-Identifier: Apache-2.0
// What a camera of another format makes of a picture.
#ifndef SIM_DEVICES_CAMERA_FORMAT_H
#define SIM_DEVICES_CAMERA_FORMAT_H

#include "warp_fixed/image.h"
#include "warp_fixed/picture.h"

/**
 * Convert. Chroma is that of the mean colour of the pixels that share it.
 *
 * @param to    Of the picture's size, and of any format but GRAY8.
 * @param from  XRGB8888.
 */
void camera_format_convert(const picture_t *to, const image_t *from);

/** Names, in lower case, by picture_format_t. */
extern const char *const camera_format_names[PICTURE_FORMATS];

#endif
