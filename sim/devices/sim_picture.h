// SPDX-License-Identifier: Apache-2.0
// Pictures of every format in memory: what cameras make of XRGB8888, and displays show as that.
#ifndef SIM_DEVICES_SIM_PICTURE_H
#define SIM_DEVICES_SIM_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "warp_fixed/image.h"
#include "warp_fixed/picture.h"

/** Names, in lower case, by picture_format_t. */
extern const char *const sim_picture_formats[PICTURE_FORMATS];

/**
 * @param[out] format  Written only when true is returned.
 * @param      length  Of the name, which need not end there.
 * @return false when no format but gray8 has that name.
 */
bool sim_picture_format_from_name(picture_format_t *format, const char *name, size_t length);

/**
 * @param bytes  sim_picture_bytes() of them, or NULL where only the layout is asked for.
 * @return A picture of BT.709 in these bytes, its rows and planes without gaps. Sizes are not checked.
 */
picture_t sim_picture(picture_format_t format, int32_t width, int32_t height, uint8_t *bytes);

size_t sim_picture_bytes(const picture_t *picture);

/**
 * Convert. Chroma is that of the mean colour of the pixels that share it.
 *
 * @param to    Of the picture's size, and of any format but GRAY8.
 * @param from  XRGB8888.
 */
void sim_picture_from_xrgb(const picture_t *to, const image_t *from);

/**
 * Convert, by color.h; every pixel has the chroma of its pair.
 *
 * @param to    XRGB8888.
 * @param from  Of the same size, and of any format but GRAY8.
 */
void sim_picture_to_xrgb(const image_t *to, const picture_t *from);

/**
 * Take off what a name begins with: nv12:FILE.
 *
 * @param[in,out] name  The rest of it: FILE. Left alone when it begins with no format.
 * @return That format, or XRGB8888.
 */
picture_format_t sim_picture_take_format(const char **name);

#endif
