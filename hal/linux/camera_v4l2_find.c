// SPDX-License-Identifier: Apache-2.0
// Which device file of V4L2 is meant by a name: see the header.
#include "hal/linux/camera_v4l2_find.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MOST_DEVICES = 64, TEXT_LENGTH = 64 };

bool camera_v4l2_split(camera_v4l2_names_t *names, const char *which)
{
    camera_v4l2_names_t result = {.video = ""};
    const char *plus = strchr(which, '+');
    const size_t length = plus == NULL ? strlen(which) : (size_t)(plus - which);
    if (length == 0 || length >= sizeof result.video || (plus != NULL && plus[1] == '\0') ||
        (plus != NULL && strlen(plus + 1) >= sizeof result.receiver))
        return false;
    memcpy(result.video, which, length);
    if (plus != NULL)
        memcpy(result.receiver, plus + 1, strlen(plus + 1));
    *names = result;
    return true;
}

static bool has_sysfs_name(const char *kind, int number, const char *name)
{
    char path[TEXT_LENGTH], text[TEXT_LENGTH] = "";
    (void)snprintf(path, sizeof path, "/sys/class/video4linux/%s%d/name", kind, number);
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    const ssize_t length = read(file, text, sizeof text - 1);
    close(file);
    if (length > 0 && text[length - 1] == '\n')
        text[length - 1] = '\0';
    return strcmp(text, name) == 0;
}

/* Does a video device capture, and is it meant? */
static bool is_meant(const char *path, int number, const char *name)
{
    const int file = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return false;
    struct v4l2_capability can = {.driver = ""};
    const bool answers = ioctl(file, VIDIOC_QUERYCAP, &can) == 0;
    close(file);
    const uint32_t able = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
    const bool captures = answers && (able & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) != 0 &&
                          (able & V4L2_CAP_STREAMING) != 0;
    return captures && (strcmp(name, "auto") == 0 || strcmp(name, (const char *)can.card) == 0 ||
                        strcmp(name, (const char *)can.bus_info) == 0 || has_sysfs_name("video", number, name));
}

bool camera_v4l2_find(char path[CAMERA_V4L2_PATH_LENGTH], const char *name, const char *kind,
                      char error[HAL_BOARD_ERROR_LENGTH])
{
    const bool is_video = strcmp(kind, "video") == 0;
    if (name[0] == '/') {
        (void)snprintf(path, CAMERA_V4L2_PATH_LENGTH, "%s", name);
        return true;
    }
    for (int number = 0; number < MOST_DEVICES; number++) {
        char candidate[TEXT_LENGTH];
        (void)snprintf(candidate, sizeof candidate, "/dev/%s%d", kind, number);
        if (is_video ? is_meant(candidate, number, name) : has_sysfs_name(kind, number, name)) {
            (void)snprintf(path, CAMERA_V4L2_PATH_LENGTH, "%s", candidate);
            return true;
        }
    }
    return camera_fail(error,
                       "no %s device of that name is here; plug it in, or choose one that "
                       "`v4l2-ctl --list-devices` lists",
                       is_video ? "capture" : kind);
}
