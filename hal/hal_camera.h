// SPDX-License-Identifier: Apache-2.0
// Contract of a video source: a camera sensor, an HDMI receiver, or a file in the simulator.
#ifndef HAL_HAL_CAMERA_H
#define HAL_HAL_CAMERA_H

#include <stdint.h>

#include "hal/hal_status.h"
#include "warp_fixed/picture.h"

typedef struct hal_camera hal_camera_t;

enum { HAL_CAMERA_LENT = 4 /**< pictures that the firmware may hold at a time: one is shown, the others wait */ };

/** One captured picture, lent by the driver until it is released. */
typedef struct {
    picture_t picture;       /**< read only; of the size the room file states, and of any format but GRAY8 */
    int64_t capture_time_us; /**< when its first line was captured, on hal_time's clock */
    uint32_t sequence;       /**< the source's own count; a gap means lost pictures */
} hal_camera_frame_t;

/**
 * Take the newest captured picture, without blocking. Older ones that were never taken are dropped.
 *
 * @param      camera  An open camera.
 * @param[out] frame   Written only when HAL_OK is returned. The pixels stay valid and unchanged until
 *                     hal_camera_release(). The caller may hold HAL_CAMERA_LENT pictures at a time.
 * @return HAL_OK      a picture newer than any taken before;
 *         HAL_EMPTY   none since the last call;
 *         HAL_FULL    HAL_CAMERA_LENT pictures are held already, release one first, whether or not there is a newer
 *                     one;
 *         HAL_IO      unplugged or failed; the handle stays good and delivers again when the source is back.
 */
MUST_CHECK hal_status_t hal_camera_take(hal_camera_t *camera, hal_camera_frame_t *frame);

/** Give a taken picture back. The frame's pixels must not be touched afterwards. */
void hal_camera_release(hal_camera_t *camera, const hal_camera_frame_t *frame);

#endif
