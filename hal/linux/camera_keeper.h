// SPDX-License-Identifier: Apache-2.0
// The thread that holds a camera open: it opens the device, serves it, and opens it anew when it was lost.
#ifndef HAL_LINUX_CAMERA_KEEPER_H
#define HAL_LINUX_CAMERA_KEEPER_H

#include "hal/linux/camera.h"
#include "hal/linux/camera_source.h"

/** Between two attempts to open a lost device: soon enough for a hand at the plug, and little work. */
enum { CAMERA_RETRY_MS = 500 };

/**
 * camera_open() with a source of the caller's choice.
 *
 * @param parsed  The settings' name.
 * @param source  Must live as long as the camera.
 */
MUST_CHECK hal_status_t camera_keeper_open(hal_camera_t **camera, const camera_settings_t *settings,
                                           const camera_name_t *parsed, const camera_source_t *source,
                                           char error[HAL_BOARD_ERROR_LENGTH]);

/** NULL is allowed. */
void camera_keeper_close(hal_camera_t *camera);

#endif
