// SPDX-License-Identifier: Apache-2.0
// The parts of a camera's name: see the header.
#include "hal/linux/camera_name.h"

#include <string.h>

static const char *const format_names[PICTURE_FORMATS] = {
    [PICTURE_XRGB8888] = "xrgb8888", [PICTURE_GRAY8] = "gray8", [PICTURE_RGB888] = "rgb888",
    [PICTURE_BGR888] = "bgr888",     [PICTURE_YUYV] = "yuyv",   [PICTURE_UYVY] = "uyvy",
    [PICTURE_NV12] = "nv12",
};

static const char *const source_names[CAMERA_SOURCES] = {[CAMERA_V4L2] = "v4l2", [CAMERA_LIBCAMERA] = "libcamera"};

const char *camera_format_name(picture_format_t format)
{
    return format_names[format];
}

/* @return What follows the word and a colon, or NULL when the text does not begin so. */
static const char *behind(const char *text, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(text, word, length) == 0 && text[length] == ':' ? text + length + 1 : NULL;
}

bool camera_name_parse(camera_name_t *parsed, const char *name)
{
    camera_name_t result = {.any_format = true};
    const char *rest = name;
    for (int format = 0; format < PICTURE_FORMATS && result.any_format; format++) {
        const char *after = format == PICTURE_GRAY8 ? NULL : behind(name, format_names[format]);
        if (after != NULL) {
            result.any_format = false;
            result.format = (picture_format_t)format;
            rest = after;
        }
    }
    for (int kind = 0; kind < CAMERA_SOURCES; kind++) {
        const char *which = behind(rest, source_names[kind]);
        if (which == NULL)
            continue;
        const size_t length = strlen(which);
        if (length == 0 || length >= sizeof result.which)
            return false;
        result.kind = (camera_kind_t)kind;
        memcpy(result.which, which, length + 1);
        *parsed = result;
        return true;
    }
    return false;
}
