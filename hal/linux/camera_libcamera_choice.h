// SPDX-License-Identifier: Apache-2.0
// Which of libcamera's cameras is meant, and which of its formats fits picture.h.
#ifndef HAL_LINUX_CAMERA_LIBCAMERA_CHOICE_H
#define HAL_LINUX_CAMERA_LIBCAMERA_CHOICE_H

#include "hal/linux/camera_libcamera.h"
#include "hal/linux/camera_source.h"

/**
 * libcamera_open(). What the library says below errors is kept off stderr, unless LIBCAMERA_LOG_LEVELS is set.
 *
 * @return false, with the reason in error.
 */
bool camera_libcamera_start(libcamera_session_t **session, char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Find a camera.
 *
 * @param which  Its number, its whole id, or the model of its sensor.
 * @return Its number; or -1, with the reason in error.
 */
int camera_libcamera_find(const libcamera_session_t *session, const char *which, char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Find the first format in which a camera has pictures of the wanted size: full colour first, then the fewest bytes.
 * The last libcamera_try() was with it then.
 *
 * @param[out] picture  What it gives, without data and stride; written only when true is returned.
 * @return false, with the reason in error.
 */
bool camera_libcamera_fit(libcamera_session_t *session, int camera, const camera_wanted_t *wanted, picture_t *picture,
                          char error[HAL_BOARD_ERROR_LENGTH]);

#endif
