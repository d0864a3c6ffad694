// SPDX-License-Identifier: Apache-2.0
// Which device file of V4L2 is meant by a name.
#ifndef HAL_LINUX_CAMERA_V4L2_FIND_H
#define HAL_LINUX_CAMERA_V4L2_FIND_H

#include <stdbool.h>

#include "hal/linux/camera_name.h"
#include "hal/linux/camera_text.h"

enum { CAMERA_V4L2_PATH_LENGTH = CAMERA_WHICH_LENGTH };

/** Device files: of the pictures, and of the HDMI receiver, if it has one of its own, else "". */
typedef struct {
    char video[CAMERA_V4L2_PATH_LENGTH];
    char receiver[CAMERA_V4L2_PATH_LENGTH];
} camera_v4l2_names_t;

/** Split VIDEO or VIDEO+RECEIVER. @return false when a part is empty. */
bool camera_v4l2_split(camera_v4l2_names_t *names, const char *which);

/**
 * The file of a device that is there now: a number may be another one after it was unplugged.
 *
 * @param[out] path   Written only when true is returned.
 * @param      name   A path, given back as it is; or the name in /sys/class/video4linux/KIND<N>/name; or for video also
 *                    the driver's name for the card or the bus place, as VIDIOC_QUERYCAP has them, or "auto" for any.
 *                    Of several the one with the lowest number that can capture.
 * @param      kind   "video" or "v4l-subdev".
 * @param[out] error  Else: that none is here.
 */
bool camera_v4l2_find(char path[CAMERA_V4L2_PATH_LENGTH], const char *name, const char *kind,
                      char error[HAL_BOARD_ERROR_LENGTH]);

#endif
