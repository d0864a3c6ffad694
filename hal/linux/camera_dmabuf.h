// SPDX-License-Identifier: Apache-2.0
// Pictures in DMABUFs: mapped for the CPU, and made to agree with its caches.
#ifndef HAL_LINUX_CAMERA_DMABUF_H
#define HAL_LINUX_CAMERA_DMABUF_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/linux/camera_exchange.h"
#include "hal/linux/camera_text.h"

/** A piece of a picture: its Y, its U and V, or all of it. */
typedef struct {
    int file;
    size_t offset, length; /**< bytes, in the file */
} camera_dmabuf_t;

/**
 * Map the pieces of one buffer for reading, and give them to the exchange.
 *
 * @param pieces   Two for NV12 with its chroma apart, which may be in the same file; else one.
 * @param picture  With its stride; data is not looked at.
 * @return false with the reason when the pieces are not those of such a picture, or can't be mapped: nothing is then.
 */
bool camera_dmabuf_map(camera_exchange_t *exchange, int buffer, const camera_dmabuf_t *pieces, size_t count,
                       const picture_t *picture, char error[HAL_BOARD_ERROR_LENGTH]);

/** Set the picture's data to the pieces as they were mapped. */
void camera_dmabuf_place(picture_t *picture, const camera_exchange_t *exchange, int buffer,
                         const camera_dmabuf_t *pieces, size_t count);

/** The CPU begins to read, or has ended; without it, it may see what its caches held before. */
void camera_dmabuf_begin_read(int file);
void camera_dmabuf_end_read(int file);

#endif
