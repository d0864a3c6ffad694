// SPDX-License-Identifier: Apache-2.0
// Which of libcamera's cameras is meant, and the format of its pictures. May throw what the library throws.
#ifndef HAL_LINUX_CAMERA_LIBCAMERA_CHOICE_HPP
#define HAL_LINUX_CAMERA_LIBCAMERA_CHOICE_HPP

#include <memory>
#include <string>

#include <libcamera/camera.h>
#include <libcamera/camera_manager.h>

extern "C" {
#include "hal/linux/camera_source.h"
}

/**
 * Find a camera, and take it for this program.
 *
 * @param which  Its number, its whole name, or the model of its sensor.
 * @return The camera, to be released by the caller; or none, with the reason in error.
 */
std::shared_ptr<libcamera::Camera> libcamera_choose(const libcamera::CameraManager &manager, const std::string &which,
                                                    char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Configure one stream of the wanted size, in the first format that fits picture.h: full colour first, then the fewest
 * bytes.
 *
 * @param[out] picture  What it gives, without data; written only when a configuration is returned.
 * @return The configuration in use; or none, with the reason in error.
 */
std::unique_ptr<libcamera::CameraConfiguration> libcamera_configure(libcamera::Camera &camera,
                                                                    const camera_wanted_t &wanted, picture_t &picture,
                                                                    char error[HAL_BOARD_ERROR_LENGTH]);

#endif
