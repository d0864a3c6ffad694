// SPDX-License-Identifier: Apache-2.0
// An HDMI receiver: see the header.
#include "hal/linux/camera_v4l2_receiver.h"

#include <errno.h>
#include <string.h>
#include <sys/ioctl.h>

enum { MOST_EVENTS = 16 };

/* The numbers of these calls are the same for video devices and sub-devices. */
bool camera_v4l2_is_receiver(int file)
{
    struct v4l2_dv_timings_cap able = {.type = V4L2_DV_BT_656_1120};
    return ioctl(file, VIDIOC_DV_TIMINGS_CAP, &able) == 0;
}

bool camera_v4l2_offer(int file, const camera_wanted_t *wanted, char error[HAL_BOARD_ERROR_LENGTH])
{
    edid_mode_t mode;
    if (!edid_mode(&mode, wanted->width, wanted->height, wanted->rate_frames, wanted->rate_seconds))
        return camera_fail(error,
                           "no EDID can offer %dx%d at %d/%d Hz over HDMI 1.4; choose a size or rate that it has",
                           wanted->width, wanted->height, wanted->rate_frames, wanted->rate_seconds);
    uint8_t ours[EDID_BYTES], shown[EDID_BYTES];
    edid_write(ours, &mode);
    int input = 0;
    if (ioctl(file, VIDIOC_G_INPUT, &input) != 0)
        input = 0; /* a sub-device: its first pad */
    struct v4l2_edid edid = {.pad = (uint32_t)input, .blocks = EDID_BLOCKS, .edid = shown};
    if (ioctl(file, VIDIOC_G_EDID, &edid) == 0 && edid.blocks == EDID_BLOCKS &&
        memcmp(shown, ours, EDID_BLOCK_BYTES) == 0) /* into the second, drivers may write an address of their own */
        return true;
    edid = (struct v4l2_edid){.pad = (uint32_t)input, .blocks = EDID_BLOCKS, .edid = ours};
    if (ioctl(file, VIDIOC_S_EDID, &edid) == 0 || errno == ENOTTY || errno == EINVAL)
        return true;
    return camera_fail(error, "the HDMI receiver refuses an EDID: %s; close other programs that use it",
                       strerror(errno));
}

void camera_v4l2_watch_source(int file)
{
    struct v4l2_event_subscription wish = {.type = V4L2_EVENT_SOURCE_CHANGE};
    if (ioctl(file, VIDIOC_G_INPUT, &wish.id) != 0)
        wish.id = 0;
    (void)ioctl(file, VIDIOC_SUBSCRIBE_EVENT, &wish); /* without it the timings are queried often */
}

bool camera_v4l2_source_changed(int file)
{
    bool changed = false;
    for (int i = 0; i < MOST_EVENTS; i++) {
        struct v4l2_event event;
        if (ioctl(file, VIDIOC_DQEVENT, &event) != 0)
            break;
        changed |= event.type == V4L2_EVENT_SOURCE_CHANGE;
    }
    return changed;
}

static const char *reason_of(int error)
{
    switch (error) {
    case ENOLINK:
        return "no HDMI signal; check cable and source";
    case ENOLCK:
        return "the HDMI signal is unsteady; try another cable or a lower rate";
    case ERANGE:
        return "the HDMI source sends more than the receiver can take; set it to the room's size and rate";
    default:
        return strerror(error);
    }
}

bool camera_v4l2_query(int file, const camera_wanted_t *wanted, struct v4l2_dv_timings *timings,
                       char news[HAL_BOARD_ERROR_LENGTH])
{
    struct v4l2_dv_timings found = {.type = V4L2_DV_BT_656_1120};
    if (ioctl(file, VIDIOC_QUERY_DV_TIMINGS, &found) != 0)
        return camera_fail(news, "%s", reason_of(errno));
    const struct v4l2_bt_timings bt = found.bt;
    if (bt.width == 0 || bt.height == 0)
        return camera_fail(news, "%s", reason_of(ENOLINK));
    if (bt.width != (uint32_t)wanted->width || bt.height != (uint32_t)wanted->height || bt.interlaced != 0)
        return camera_fail(news, "the HDMI source sends %ux%u%s, expected %dx%dp as the room file states; set it there",
                           bt.width, bt.height, bt.interlaced != 0 ? "i" : "p", wanted->width, wanted->height);
    *timings = found;
    return true;
}

bool camera_v4l2_same_timings(const struct v4l2_dv_timings *a, const struct v4l2_dv_timings *b)
{
    const struct v4l2_bt_timings x = a->bt, y = b->bt;
    const uint64_t apart = x.pixelclock > y.pixelclock ? x.pixelclock - y.pixelclock : y.pixelclock - x.pixelclock;
    return x.width == y.width && x.height == y.height && x.interlaced == y.interlaced && apart <= x.pixelclock / 1000 &&
           V4L2_DV_BT_FRAME_WIDTH(&x) == V4L2_DV_BT_FRAME_WIDTH(&y) &&
           V4L2_DV_BT_FRAME_HEIGHT(&x) == V4L2_DV_BT_FRAME_HEIGHT(&y);
}
