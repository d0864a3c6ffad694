// SPDX-License-Identifier: Apache-2.0
// Which of libcamera's cameras is meant, and which of its formats fits picture.h: see the header.
#include "hal/linux/camera_libcamera_choice.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    uint32_t fourcc;
    picture_format_t format;
} format_t;

/* The best first. DRM's names are ours. */
static const format_t formats[] = {
    {DRM_FORMAT_XRGB8888, PICTURE_XRGB8888}, {DRM_FORMAT_RGB888, PICTURE_RGB888}, {DRM_FORMAT_BGR888, PICTURE_BGR888},
    {DRM_FORMAT_YUYV, PICTURE_YUYV},         {DRM_FORMAT_UYVY, PICTURE_UYVY},     {DRM_FORMAT_NV12, PICTURE_NV12},
};

bool camera_libcamera_start(libcamera_session_t **session, char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
    const int failure = libcamera_open(session);
    return failure >= 0 || camera_fail(error, "libcamera does not start: %s; see `cam -l`", strerror(-failure));
}

int camera_libcamera_find(const libcamera_session_t *session, const char *which, char error[HAL_BOARD_ERROR_LENGTH])
{
    const int count = libcamera_count(session);
    for (int camera = 0; camera < count; camera++) {
        libcamera_name_t name;
        char number[16];
        (void)snprintf(number, sizeof number, "%d", camera);
        libcamera_name(session, camera, &name);
        if (strcmp(which, number) == 0 || strcmp(which, name.id) == 0 || strcmp(which, name.model) == 0)
            return camera;
    }
    (void)camera_fail(error,
                      "is not among the %d cameras here; plug it in, end other programs that use it, or choose one "
                      "that `cam -l` lists",
                      count);
    return -1;
}

/* BT.601 or BT.709, of limited range; a pipeline that says nothing means V4L2's default, BT.601. */
static bool judge_colours(picture_t *picture, const libcamera_format_t *given, char error[HAL_BOARD_ERROR_LENGTH])
{
    picture->matrix = given->colours == LIBCAMERA_BT709 ? PICTURE_BT709 : PICTURE_BT601;
    if (!picture_is_yuv(picture->format) || given->colours != LIBCAMERA_OTHER_COLOURS)
        return true;
    return camera_fail(error, "gives colours %s, expected BT.601 or BT.709 of limited range; try another format",
                       given->colours_text);
}

static bool try_format(libcamera_session_t *session, int camera, const camera_wanted_t *wanted, const format_t *format,
                       picture_t *picture, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = camera_format_name(format->format);
    picture_t fits = {.format = format->format, .width = wanted->width, .height = wanted->height};
    const libcamera_format_t wish = {
        .fourcc = format->fourcc,
        .width = (uint32_t)wanted->width,
        .height = (uint32_t)wanted->height,
        .colours = picture_is_yuv(format->format) ? LIBCAMERA_BT709 : LIBCAMERA_UNTOLD,
    };
    libcamera_format_t given;
    const int failure = libcamera_try(session, camera, &wish, CAMERA_BUFFERS, &given);
    if (failure == -ENODEV)
        return camera_fail(error, "has no video stream; choose another camera of `cam -l`");
    if (failure < 0)
        return camera_fail(error, "has no valid configuration for %s; see `cam -c 1 -I`", name);
    if (given.fourcc != wish.fourcc)
        return false; /* an earlier reason may tell more */
    if (given.width != wish.width || given.height != wish.height)
        return camera_fail(error, "gives %s of %ux%u at nearest, expected %dx%d as the room file states", name,
                           given.width, given.height, wanted->width, wanted->height);
    if (!judge_colours(&fits, &given, error))
        return false;
    *picture = fits;
    return true;
}

bool camera_libcamera_fit(libcamera_session_t *session, int camera, const camera_wanted_t *wanted, picture_t *picture,
                          char error[HAL_BOARD_ERROR_LENGTH])
{
    const camera_name_t *name = &wanted->name;
    (void)camera_fail(error, "gives none of the formats that are wanted; see `cam -c 1 -I` and README.md");
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if ((name->any_format || name->format == formats[i].format) &&
            try_format(session, camera, wanted, &formats[i], picture, error))
            return true;
    return false;
}
