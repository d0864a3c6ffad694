// SPDX-License-Identifier: Apache-2.0
// A picture as cameras deliver it and displays take it: the formats, by DRM's names, and the planes they are made of.
#ifndef WARP_FIXED_PICTURE_H
#define WARP_FIXED_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

enum { PICTURE_MAX_PLANES = 2 };

/**
 * Bytes in memory, from the left. Y, U (Cb), V (Cr) are of limited range: Y 16 to 235, U and V 16 to 240.
 *
 * A pair of U and V stands for a rectangle of pixels, and belongs to its centre: that is where V4L2 has it. (Video that
 * puts it a quarter of a chroma pixel further left is shown with its colours that much to the right.)
 */
typedef enum {
    PICTURE_XRGB8888, /**< B, G, R, X; V4L2 XBGR32 */
    PICTURE_GRAY8,    /**< Y (full range); DRM R8, V4L2 GREY */
    PICTURE_RGB888,   /**< B, G, R; V4L2 BGR24 */
    PICTURE_BGR888,   /**< R, G, B; V4L2 RGB24 */
    PICTURE_YUYV,     /**< Y, U, Y, V of two pixels in a row; even width */
    PICTURE_UYVY,     /**< U, Y, V, Y likewise */
    PICTURE_NV12,     /**< a plane of Y, and one of U, V for each two by two pixels; even width and height */
    PICTURE_FORMATS
} picture_format_t;

/** Which R, G and B are meant by Y, U and V. */
typedef enum { PICTURE_BT709, PICTURE_BT601 } picture_matrix_t;

/** Never owns the memory. */
typedef struct {
    picture_format_t format;
    picture_matrix_t matrix; /**< of YUYV, UYVY and NV12 */
    int32_t width, height;   /**< pixels, 1 to IMAGE_MAX_WIDTH and IMAGE_MAX_HEIGHT */
    uint8_t *data[PICTURE_MAX_PLANES];
    int32_t stride[PICTURE_MAX_PLANES]; /**< bytes from row to row; any alignment */
} picture_t;

/** @return The same pixels as a picture. The format must be IMAGE_GRAY8 or IMAGE_XRGB8888. */
picture_t picture_from_image(const image_t *image);

/** @return Are width and height in range, and even where the format asks for it, and are rows apart? */
bool picture_is_valid(const picture_t *picture);

/** @return Is it made of luma and chroma? */
bool picture_is_yuv(picture_format_t format);

/** @return log2 of how many rows share a row of chroma: 1 for NV12, else 0. Columns are always shared by two. */
int picture_chroma_rows_log2(picture_format_t format);

/**
 * A plane as it is warped: luma, chroma, or all that a pixel has.
 *
 * @return data and stride are those of the picture's memory, which for YUYV, UYVY, RGB888 and BGR888 hold something
 * else.
 */
image_t picture_plane(const picture_t *picture, int plane);

#endif
