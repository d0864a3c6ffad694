// SPDX-License-Identifier: Apache-2.0
// The buffers of a V4L2 device: mapped once, filled by the driver, read by the CPU.
#ifndef HAL_LINUX_CAMERA_V4L2_BUFFERS_H
#define HAL_LINUX_CAMERA_V4L2_BUFFERS_H

#include "hal/linux/camera_source.h"
#include "hal/linux/camera_v4l2_format.h"

/**
 * A device that is being set up or runs.
 *
 * The buffers are the driver's own (V4L2_MEMORY_MMAP), so no picture is copied. Handing them on as DMABUF would save
 * nothing: the CPU reads every picture, no other device does. What matters is that the CPU reads them through its
 * caches, as each pixel is read several times: cached buffers are asked for (V4L2_MEMORY_FLAG_NON_COHERENT,
 * Linux 5.16), which drivers grant that allow cache hints. USB's and vivid's are cached anyway. Those of receivers
 * without hints (the Raspberry Pi's unicam) are not: see the board's page.
 */
typedef struct {
    int file;
    uint32_t type; /**< V4L2_BUF_TYPE_VIDEO_CAPTURE or its MPLANE */
    camera_v4l2_layout_t layout;
    camera_exchange_t *exchange;
    int count; /**< buffers that the driver has */
} camera_v4l2_buffers_t;

/** Let the driver make buffers, map them, and give it all of them. @return false with the reason: call _free then. */
bool camera_v4l2_buffers_make(camera_v4l2_buffers_t *buffers, char error[HAL_BOARD_ERROR_LENGTH]);

/** Give the driver's memory up, after camera_exchange_withdraw(). */
void camera_v4l2_buffers_free(camera_v4l2_buffers_t *buffers);

/** Give one buffer, and all that the loop gave back, to the driver. @return false when the device is gone. */
bool camera_v4l2_fill(const camera_v4l2_buffers_t *buffers, int buffer);
bool camera_v4l2_fill_returned(const camera_v4l2_buffers_t *buffers);

typedef enum { CAMERA_V4L2_NONE, CAMERA_V4L2_PICTURE, CAMERA_V4L2_BROKEN, CAMERA_V4L2_LOST } camera_v4l2_got_t;

/**
 * Take one filled buffer from the driver, without blocking, and hand it to the exchange.
 *
 * Its time is the driver's when that is of CLOCK_MONOTONIC and past (vivid's may be a picture ahead), else now. Drivers
 * mean the end of the picture unless they flag it as the start; but those of CSI receivers stamp its start and flag
 * nothing, so none is corrected here.
 *
 * @return NONE: there is none; PICTURE; BROKEN: one with an error, or too short, given back to the driver;
 *         LOST: the device failed.
 */
camera_v4l2_got_t camera_v4l2_get(const camera_v4l2_buffers_t *buffers);

#endif
