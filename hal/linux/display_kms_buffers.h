// SPDX-License-Identifier: Apache-2.0
// The display's buffers: dumb ones, mapped once, each of which the display can scan out in several formats.
#ifndef HAL_LINUX_DISPLAY_KMS_BUFFERS_H
#define HAL_LINUX_DISPLAY_KMS_BUFFERS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/picture.h"

/** One is on the wall, one on its way there, one is drawn into. */
enum { KMS_BUFFERS = 3 };

typedef struct {
    uint32_t handle;
    uint32_t framebuffer[PICTURE_FORMATS]; /**< 0: the display does not take the format */
    uint8_t *data;
} kms_buffer_t;

typedef struct {
    int32_t width, height, pitch; /**< of XRGB8888; pitch in bytes */
    int64_t bytes;                /**< of one buffer */
    kms_buffer_t buffer[KMS_BUFFERS];
} kms_buffers_t;

/** @return DRM's name of a format that displays are asked for: XRGB8888, NV12, YUYV; 0 for others. */
uint32_t kms_fourcc(picture_format_t format);

/**
 * Make and map the buffers, black in XRGB8888, every page of them in memory.
 *
 * @param[out] buffers  Written whatever is returned; kms_buffers_close() is needed after either.
 * @return 0, or the errno of what was refused.
 */
int kms_buffers_open(kms_buffers_t *buffers, int card, int32_t width, int32_t height);

/**
 * Let the buffers be shown in one more format, in the same memory.
 *
 * @return 0; the errno of a refusal: the format is then not to be had.
 */
int kms_buffers_add_format(kms_buffers_t *buffers, int card, picture_format_t format);

/** Undo kms_buffers_add_format(). */
void kms_buffers_drop_format(kms_buffers_t *buffers, int card, picture_format_t format);

/** @return A buffer as a picture of one of its formats. */
picture_t kms_buffers_picture(const kms_buffers_t *buffers, int32_t index, picture_format_t format);

void kms_buffers_close(kms_buffers_t *buffers, int card);

#endif
