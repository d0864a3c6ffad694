// SPDX-License-Identifier: Apache-2.0
// Video from a V4L2 device: see the header.
#include "hal/linux/camera_v4l2.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_v4l2_buffers.h"
#include "hal/linux/camera_v4l2_find.h"
#include "hal/linux/camera_v4l2_receiver.h"

enum { POLL_MS = 500, LOST_US = 5000000, MOST_FORMATS = 64, CLOSED = -1 };

typedef struct {
    camera_wanted_t wanted;
    int receiver; /* the file to ask for timings; may be buffers.file; CLOSED: it has none */
    camera_v4l2_buffers_t buffers;
    bool runs;
    struct v4l2_dv_timings timings; /* while it runs */
    int64_t picture_us;             /* when the last one came, or the device began */
} device_t;

static void *create(const camera_wanted_t *wanted)
{
    device_t *device = calloc(1, sizeof *device);
    if (device != NULL) {
        device->wanted = *wanted;
        device->buffers.exchange = wanted->exchange;
        device->buffers.file = device->receiver = CLOSED;
    }
    return device;
}

static void stop(device_t *device)
{
    int type = (int)device->buffers.type;
    (void)ioctl(device->buffers.file, VIDIOC_STREAMOFF, &type); /* of a device that is gone it fails */
    camera_exchange_withdraw(device->wanted.exchange);
    camera_v4l2_buffers_free(&device->buffers);
    device->runs = false;
}

static void close_device(void *source)
{
    device_t *device = source;
    if (device->buffers.file == CLOSED)
        return;
    stop(device);
    if (device->receiver != CLOSED && device->receiver != device->buffers.file)
        close(device->receiver);
    close(device->buffers.file);
    device->buffers.file = device->receiver = CLOSED;
}

static int open_file(const char *path, char error[HAL_BOARD_ERROR_LENGTH])
{
    const int file = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file >= 0)
        return file;
    const char *mend = errno == EACCES || errno == EPERM ? "; add the user to the group video" : "; plug it in";
    (void)camera_fail(error, "can't open %.60s: %s%s", path, strerror(errno), mend);
    return CLOSED;
}

/* The type of its buffers. */
static bool find_type(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    struct v4l2_capability can = {.driver = ""};
    if (ioctl(device->buffers.file, VIDIOC_QUERYCAP, &can) != 0)
        return camera_fail(error, "is no video device; choose one that `v4l2-ctl --list-devices` lists");
    const uint32_t able = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
    device->buffers.type =
        (able & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE : V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if ((able & (V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_VIDEO_CAPTURE)) == 0 || (able & V4L2_CAP_STREAMING) == 0)
        return camera_fail(error, "captures no video; choose a device that `v4l2-ctl --list-devices` lists");
    return true;
}

static bool gives(const device_t *device, uint32_t fourcc)
{
    for (uint32_t i = 0; i < MOST_FORMATS; i++) {
        struct v4l2_fmtdesc offered = {.index = i, .type = device->buffers.type};
        if (ioctl(device->buffers.file, VIDIOC_ENUM_FMT, &offered) != 0)
            return false;
        if (offered.pixelformat == fourcc)
            return true;
    }
    return false;
}

static bool choose_format(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const camera_wanted_t *wanted = &device->wanted;
    (void)camera_fail(error, "gives none of the formats that are wanted; see `v4l2-ctl --list-formats` and README.md");
    for (int i = 0; i < CAMERA_V4L2_FORMATS; i++) {
        const camera_v4l2_format_t *format = &camera_v4l2_formats[i];
        if ((!wanted->name.any_format && wanted->name.format != format->format) || !gives(device, format->fourcc))
            continue;
        struct v4l2_format ask;
        camera_v4l2_ask(&ask, device->buffers.type, format, wanted->width, wanted->height);
        if (ioctl(device->buffers.file, VIDIOC_S_FMT, &ask) != 0)
            return camera_fail(error,
                               errno == EBUSY ? "is used by another program; find it with `fuser -v /dev/video*`"
                                              : "refuses format %s: %s",
                               camera_format_name(format->format), strerror(errno));
        if (camera_v4l2_layout(&device->buffers.layout, format, &ask, wanted->width, wanted->height, error))
            return true;
    }
    return false;
}

/* Devices without rates refuse it, and others take the nearest. */
static void ask_for_rate(const device_t *device)
{
    struct v4l2_streamparm ask = {.type = device->buffers.type};
    ask.parm.capture.timeperframe.numerator = (uint32_t)device->wanted.rate_seconds;
    ask.parm.capture.timeperframe.denominator = (uint32_t)device->wanted.rate_frames;
    (void)ioctl(device->buffers.file, VIDIOC_S_PARM, &ask);
}

/* Choose the format, and let pictures come. On failure nothing is left of it. */
static bool start(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    if (!choose_format(device, error))
        return false;
    if (device->receiver == CLOSED)
        ask_for_rate(device);
    int type = (int)device->buffers.type;
    bool good = camera_v4l2_buffers_make(&device->buffers, error);
    if (good && ioctl(device->buffers.file, VIDIOC_STREAMON, &type) != 0)
        good = camera_fail(error, "does not start: %s; see `dmesg` and, on CSI, `media-ctl -p`", strerror(errno));
    if (!good) {
        stop(device);
        return false;
    }
    error[0] = '\0'; /* of formats that did not fit */
    device->runs = true;
    device->picture_us = camera_now_us();
    return true;
}

/* When the source of a receiver sends what is wanted, start. @return false when the receiver has that and refuses. */
static bool start_when_right(device_t *device, char news[HAL_BOARD_ERROR_LENGTH])
{
    struct v4l2_dv_timings timings;
    if (!camera_v4l2_query(device->receiver, &device->wanted, &timings, news))
        return true;
    device->timings = timings;
    if (ioctl(device->receiver, VIDIOC_S_DV_TIMINGS, &timings) != 0)
        return camera_fail(news, "the HDMI receiver refuses the timings it has: %s", strerror(errno));
    return start(device, news);
}

static bool open_receiver(device_t *device, const char *name, char error[HAL_BOARD_ERROR_LENGTH])
{
    char path[CAMERA_V4L2_PATH_LENGTH];
    device->receiver = camera_v4l2_is_receiver(device->buffers.file) ? device->buffers.file : CLOSED;
    if (name[0] != '\0') {
        if (!camera_v4l2_find(path, name, "v4l-subdev", error))
            return false;
        device->receiver = open_file(path, error);
        if (device->receiver == CLOSED)
            return false;
        if (!camera_v4l2_is_receiver(device->receiver))
            return camera_fail(error, "%.60s is no HDMI receiver; choose one that `media-ctl -p` shows", path);
    }
    if (device->receiver == CLOSED)
        return true;
    camera_v4l2_watch_source(device->receiver);
    return camera_v4l2_offer(device->receiver, &device->wanted, error);
}

static bool open_device(void *source, char error[HAL_BOARD_ERROR_LENGTH])
{
    device_t *device = source;
    camera_v4l2_names_t names;
    char path[CAMERA_V4L2_PATH_LENGTH];
    if (!camera_v4l2_split(&names, device->wanted.name.which))
        return camera_fail(error, "expected v4l2:DEVICE or v4l2:DEVICE+RECEIVER");
    if (!camera_v4l2_find(path, names.video, "video", error))
        return false;
    device->buffers.file = open_file(path, error);
    if (device->buffers.file == CLOSED)
        return false;
    device->picture_us = camera_now_us();
    if (find_type(device, error) && open_receiver(device, names.receiver, error) &&
        (device->receiver != CLOSED || start(device, error)))
        return true;
    close_device(device);
    return false;
}

static bool take_pictures(device_t *device)
{
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++) {
        const camera_v4l2_got_t got = camera_v4l2_get(&device->buffers);
        if (got == CAMERA_V4L2_LOST)
            return false;
        if (got == CAMERA_V4L2_NONE)
            return true;
        if (got == CAMERA_V4L2_PICTURE)
            device->picture_us = camera_now_us();
    }
    return true;
}

/* Stop unless the source still sends what it did. A rate of its own is no change for who waits for pictures. */
static void check_source(device_t *device, char news[HAL_BOARD_ERROR_LENGTH])
{
    struct v4l2_dv_timings timings;
    if (!camera_v4l2_query(device->receiver, &device->wanted, &timings, news) ||
        !camera_v4l2_same_timings(&timings, &device->timings))
        stop(device);
}

static bool serve(void *source, char news[HAL_BOARD_ERROR_LENGTH])
{
    device_t *device = source;
    struct pollfd waits[] = {
        {.fd = device->buffers.file, .events = (short)(device->runs ? POLLIN | POLLPRI : POLLPRI)},
        {.fd = device->wanted.wake, .events = POLLIN},
        {.fd = device->receiver == device->buffers.file ? CLOSED : device->receiver, .events = POLLPRI},
    };
    const int ready = poll(waits, sizeof waits / sizeof waits[0], POLL_MS);
    if (ready < 0 && errno != EINTR)
        return camera_fail(news, "can't wait for pictures: %s", strerror(errno));
    camera_wake_clear(device->wanted.wake);
    const bool lost = ((waits[0].revents | waits[2].revents) & (POLLERR | POLLHUP | POLLNVAL)) != 0;
    if (lost || (device->runs && !(camera_v4l2_fill_returned(&device->buffers) && take_pictures(device))))
        return camera_fail(news, "is gone; plug it in again");
    const bool changed = device->receiver != CLOSED && camera_v4l2_source_changed(device->receiver);
    if (!device->runs)
        return start_when_right(device, news);
    if (device->receiver != CLOSED && (changed || ready == 0))
        check_source(device, news);
    if (device->runs && camera_now_us() - device->picture_us > LOST_US)
        return camera_fail(news, "gave no picture for %d s; see `dmesg`", LOST_US / 1000000);
    return true;
}

static void destroy(void *source)
{
    free(source);
}

const camera_source_t camera_v4l2 = {create, open_device, serve, close_device, destroy};
