// SPDX-License-Identifier: Apache-2.0
// The parts of a camera's name: FORMAT:SOURCE:WHICH.
#ifndef HAL_LINUX_CAMERA_NAME_H
#define HAL_LINUX_CAMERA_NAME_H

#include <stdbool.h>

#include "warp_fixed/picture.h"

enum { CAMERA_WHICH_LENGTH = 128 };

typedef enum { CAMERA_V4L2, CAMERA_LIBCAMERA, CAMERA_SOURCES } camera_kind_t;

typedef struct {
    camera_kind_t kind;
    bool any_format;         /**< no format is named */
    picture_format_t format; /**< the one named */
    char which[CAMERA_WHICH_LENGTH];
} camera_name_t;

/** @return Its name in lower case, as "nv12". */
const char *camera_format_name(picture_format_t format);

/**
 * @param[out] parsed  Written only when true is returned.
 * @param      name    As in camera_settings_t.
 * @return false when the source is missing or unknown, or the rest is empty or too long.
 */
bool camera_name_parse(camera_name_t *parsed, const char *name);

#endif
