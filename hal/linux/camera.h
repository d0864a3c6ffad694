// SPDX-License-Identifier: Apache-2.0
// The camera of a Linux board (hal/hal_camera.h): by its name a V4L2 device, or one of libcamera's.
#ifndef HAL_LINUX_CAMERA_H
#define HAL_LINUX_CAMERA_H

#include <stdint.h>

#include "hal/hal_board.h"
#include "hal/hal_camera.h"

/** What is wanted of it. */
typedef struct {
    /**
     * SOURCE:WHICH, or FORMAT:SOURCE:WHICH to take that format and no other (xrgb8888, rgb888, bgr888, yuyv, uyvy,
     * nv12).
     *
     * v4l2:WHICH       camera_v4l2.h: HDMI receivers, USB capture devices and cameras;
     * libcamera:WHICH  camera_libcamera_source.h: camera sensors, USB cameras.
     */
    const char *name;
    int32_t width, height;             /**< of its pictures, as the room file states */
    int32_t rate_frames, rate_seconds; /**< pictures a second to ask for, as a fraction; what comes may differ */
    int32_t priority;                  /**< real-time, of the thread that takes pictures from the driver: 1 to 99, best
                                            one above the workers', as it works for microseconds; 0: none */
} camera_settings_t;

/**
 * Open it, and start a thread that holds it open from then on: it takes every picture from the driver at once, opens
 * the device anew each CAMERA_RETRY_MS after it was lost, and says so on stderr, once for each change. Opening a device
 * can block for seconds (USB transfers that time out, I2C), so it must not be done in the firmware's loop; and a thread
 * that takes pictures as they come spares the loop the driver's cache maintenance, milliseconds for a large picture.
 *
 * hal_camera_take() and hal_camera_release() make no system call but for a lock held for a few instructions, and one to
 * wake the thread.
 *
 * @param[out] camera  Written only when HAL_OK is returned.
 * @param[out] error   On failure: one line, what is wrong with which device, what was expected, and how to mend it.
 * @return HAL_OK, of an HDMI receiver also without a signal: pictures come when it does, and HAL_IO until then;
 *         HAL_BAD_CALL for a wrong name or setting; HAL_IO when the device is missing, used by another program, or
 *         offers no picture of that size and format: it is closed again.
 */
MUST_CHECK hal_status_t camera_open(hal_camera_t **camera, const camera_settings_t *settings,
                                    char error[HAL_BOARD_ERROR_LENGTH]);

/** End the thread and close the device. Lent pictures die with the camera. NULL is allowed. May block for a second. */
void camera_close(hal_camera_t *camera);

#endif
