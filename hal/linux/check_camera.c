// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the video source. V4L2 devices are opened and asked, which disturbs nobody who streams.
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "hal/linux/camera_name.h"
#include "hal/linux/camera_v4l2_find.h"
#include "hal/linux/camera_v4l2_format.h"
#include "hal/linux/camera_v4l2_receiver.h"
#include "hal/linux/check.h"

enum { MOST_ENTRIES = 64 };

static bool is_taken(uint32_t fourcc)
{
    for (size_t i = 0; i < CAMERA_V4L2_FORMATS; i++)
        if (camera_v4l2_formats[i].fourcc == fourcc)
            return true;
    return false;
}

/* Is the wanted size among those that the device has in a format? Devices that list none take what their signal is. */
static bool has_size(int file, uint32_t format, const hal_board_needs_t *needs)
{
    struct v4l2_frmsizeenum size = {.pixel_format = format};
    const uint32_t width = (uint32_t)needs->picture_width, height = (uint32_t)needs->picture_height;
    for (; size.index < MOST_ENTRIES && ioctl(file, VIDIOC_ENUM_FRAMESIZES, &size) == 0; size.index++) {
        if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
            if (size.discrete.width == width && size.discrete.height == height)
                return true;
            continue;
        }
        const struct v4l2_frmsize_stepwise *range = &size.stepwise;
        return width >= range->min_width && width <= range->max_width && height >= range->min_height &&
               height <= range->max_height && (width - range->min_width) % range->step_width == 0 &&
               (height - range->min_height) % range->step_height == 0;
    }
    return size.index == 0;
}

/* Formats that the firmware takes, and whether one of them has the wanted size. */
static bool list_formats(int file, uint32_t type, const hal_board_needs_t *needs, char *text, size_t size)
{
    struct v4l2_fmtdesc format = {.type = type};
    bool fits = false;
    size_t used = 0;
    text[0] = '\0';
    for (; format.index < MOST_ENTRIES && ioctl(file, VIDIOC_ENUM_FMT, &format) == 0; format.index++) {
        if (!is_taken(format.pixelformat))
            continue;
        fits = fits || needs == NULL || has_size(file, format.pixelformat, needs);
        if (used < size)
            used += (size_t)snprintf(text + used, size - used, " %.4s", (const char *)&format.pixelformat);
    }
    return fits;
}

/* The type of its capture queue; 0 when it captures nothing. */
static uint32_t capture_type(const struct v4l2_capability *about)
{
    const uint32_t can = (about->capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? about->device_caps : about->capabilities;
    if ((can & V4L2_CAP_STREAMING) == 0)
        return 0;
    if ((can & V4L2_CAP_VIDEO_CAPTURE) != 0)
        return V4L2_BUF_TYPE_VIDEO_CAPTURE;
    return (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE : 0;
}

static void check_device(check_t *check, int file, const char *device)
{
    struct v4l2_capability about;
    char formats[CHECK_WORD_LENGTH], mend[CHECK_LINE_LENGTH];
    (void)snprintf(mend, sizeof mend, "v4l2-ctl -d %s --list-formats-ext", device);
    if (ioctl(file, VIDIOC_QUERYCAP, &about) != 0 || capture_type(&about) == 0) {
        check_miss(check, "v4l2-ctl --list-devices", "camera: %s delivers no video", device);
        return;
    }
    const char *card = (const char *)about.card, *driver = (const char *)about.driver;
    const bool fits = list_formats(file, capture_type(&about), check->needs, formats, sizeof formats);
    if (formats[0] == '\0')
        check_miss(check, mend, "camera: %s, %s, has none of the formats XR24 RGB3 BGR3 YUYV UYVY NV12", device, card);
    else if (!fits)
        check_miss(check, mend, "camera: %s, %s, has%s, none in %dx%d as the room file has it", device, card, formats,
                   (int)check->needs->picture_width, (int)check->needs->picture_height);
    else
        check_found(check, "camera: %s, %s (%s),%s", device, card, driver, formats);
}

/* What comes in over HDMI. The EDID is loaded by the firmware, so a source may be silent until then. */
static void check_signal(check_t *check, int file, const char *device)
{
    char news[HAL_BOARD_ERROR_LENGTH];
    struct v4l2_dv_timings timings = {.type = V4L2_DV_BT_656_1120};
    if (!camera_v4l2_is_receiver(file))
        return;
    (void)ioctl(file, VIDIOC_QUERY_DV_TIMINGS, &timings); /* for a check without a room, which takes any size */
    const camera_wanted_t wanted = {
        .width = check->needs != NULL ? check->needs->picture_width : (int32_t)timings.bt.width,
        .height = check->needs != NULL ? check->needs->picture_height : (int32_t)timings.bt.height,
    };
    if (camera_v4l2_query(file, &wanted, &timings, news))
        check_found(check, "camera: %s receives %ux%u at %u kHz", device, timings.bt.width, timings.bt.height,
                    (unsigned)(timings.bt.pixelclock / 1000));
    else
        check_advise(check, "switch the source on; it may need the EDID that the firmware loads when it starts",
                     "camera: %s: %s", device, news);
}

static void check_receiver(check_t *check, const char *name)
{
    char path[CAMERA_V4L2_PATH_LENGTH], error[HAL_BOARD_ERROR_LENGTH];
    if (!camera_v4l2_find(path, name, "v4l-subdev", error)) {
        check_miss(check, "media-ctl -d /dev/media0 -p", "camera: %s", error);
        return;
    }
    const int file = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        check_refused(check, "camera", path, errno, "video");
        return;
    }
    check_signal(check, file, path);
    close(file);
}

static void check_v4l2(check_t *check, const char *which)
{
    camera_v4l2_names_t names;
    char path[CAMERA_V4L2_PATH_LENGTH], error[HAL_BOARD_ERROR_LENGTH];
    if (!camera_v4l2_split(&names, which) || !camera_v4l2_find(path, names.video, "video", error)) {
        check_miss(check, "plug it in, or load its overlay as the page of the board has it; v4l2-ctl --list-devices",
                   "camera: there is no \"%s\"", which);
        return;
    }
    const int file = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        check_refused(check, "camera", path, errno, "video");
        return;
    }
    check_device(check, file, path);
    if (names.receiver[0] == '\0')
        check_signal(check, file, path);
    else
        check_receiver(check, names.receiver);
    close(file);
}

void check_camera(check_t *check)
{
    camera_name_t name;
    if (!camera_name_parse(&name, check->table->camera))
        check_miss(check, "--camera v4l2:/dev/video0", "camera: found \"%s\", expected v4l2:DEVICE or libcamera:WHICH",
                   check->table->camera);
    else if (name.kind == CAMERA_V4L2)
        check_v4l2(check, name.which);
    else
        check_libcamera(check, &name);
}
