// SPDX-License-Identifier: Apache-2.0
// The camera of a Linux board: chooses its source by the name; see the header.
#include "hal/linux/camera.h"

#include "hal/linux/camera_keeper.h"
#include "hal/linux/camera_libcamera_source.h"
#include "hal/linux/camera_v4l2.h"

static const camera_source_t *const sources[CAMERA_SOURCES] = {
    [CAMERA_V4L2] = &camera_v4l2,
    [CAMERA_LIBCAMERA] = &camera_libcamera,
};

hal_status_t camera_open(hal_camera_t **camera, const camera_settings_t *settings, char error[HAL_BOARD_ERROR_LENGTH])
{
    camera_name_t parsed;
    if (!camera_name_parse(&parsed, settings->name)) {
        (void)camera_fail(error,
                          "camera %.120s: expected v4l2:DEVICE or libcamera:CAMERA, as v4l2:/dev/video0 or "
                          "nv12:libcamera:0; `v4l2-ctl --list-devices` and `cam -l` list what is here",
                          settings->name);
        return HAL_BAD_CALL;
    }
    return camera_keeper_open(camera, settings, &parsed, sources[parsed.kind], error);
}

void camera_close(hal_camera_t *camera)
{
    camera_keeper_close(camera);
}
