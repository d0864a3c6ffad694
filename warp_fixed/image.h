// SPDX-License-Identifier: Apache-2.0
// A view of a picture in memory: the one picture type of camera, warp and display.
#ifndef WARP_FIXED_IMAGE_H
#define WARP_FIXED_IMAGE_H

#include <stddef.h>
#include <stdint.h>

enum { IMAGE_MAX_WIDTH = 4096, IMAGE_MAX_HEIGHT = 2160 };

/** The value of each format is its number of bytes, and of 8-bit channels, per pixel. */
typedef enum {
    IMAGE_GRAY8 = 1,   /**< one luma byte per pixel */
    IMAGE_UV88 = 2,    /**< bytes U, V: the chroma of a picture, with pixels of its own size */
    IMAGE_XRGB8888 = 4 /**< bytes B, G, R, X in memory (DRM's XRGB8888, little endian); X is carried, not shown */
} image_format_t;

/**
 * A rectangle of pixels somewhere in memory. Never owns the memory.
 *
 * Pixel (x, y) starts at data + y * stride + x * format; x right, y down. The rows need no alignment.
 */
typedef struct {
    uint8_t *data;
    int32_t width;         /**< pixels, 1 to IMAGE_MAX_WIDTH */
    int32_t height;        /**< pixels, 1 to IMAGE_MAX_HEIGHT */
    int32_t stride;        /**< bytes from row to row, at least width * format */
    image_format_t format; /**< bytes per pixel */
} image_t;

/** A filtered picture, or spline coefficients (fixed.h), in the order of a picture's channels. Never owns the memory.
 */
typedef struct {
    int16_t *data;
    int32_t width;    /**< pixels */
    int32_t height;   /**< pixels */
    int32_t channels; /**< coefficients per pixel; rows follow one another without gap */
} coefficients_t;

/** @return Row y of the picture; 0 <= y < height. */
static inline uint8_t *image_row(const image_t *image, int32_t y)
{
    return image->data + (ptrdiff_t)y * image->stride;
}

#endif
