// SPDX-License-Identifier: Apache-2.0
// The buffers of a V4L2 device: see the header.
#include "hal/linux/camera_v4l2_buffers.h"

#include <errno.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include "hal/linux/camera_clock.h"

/* A buffer as the calls want it, of either type. */
typedef struct {
    struct v4l2_buffer of;
    struct v4l2_plane plane[PICTURE_MAX_PLANES];
} ask_t;

static bool has_planes(const camera_v4l2_buffers_t *buffers)
{
    return buffers->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

static void ask_for(ask_t *ask, const camera_v4l2_buffers_t *buffers, int buffer)
{
    memset(ask, 0, sizeof *ask);
    ask->of.type = buffers->type;
    ask->of.memory = V4L2_MEMORY_MMAP;
    ask->of.index = (uint32_t)buffer;
    if (has_planes(buffers)) {
        ask->of.m.planes = ask->plane;
        ask->of.length = (uint32_t)buffers->layout.memories;
    }
}

static bool map_buffer(const camera_v4l2_buffers_t *buffers, int buffer, char error[HAL_BOARD_ERROR_LENGTH])
{
    ask_t ask;
    ask_for(&ask, buffers, buffer);
    if (ioctl(buffers->file, VIDIOC_QUERYBUF, &ask.of) != 0)
        return camera_fail(error, "can't ask for buffer %d: %s", buffer, strerror(errno));
    camera_map_t map[PICTURE_MAX_PLANES] = {{NULL, 0}};
    for (int plane = 0; plane < buffers->layout.memories; plane++) {
        const size_t length = has_planes(buffers) ? ask.plane[plane].length : ask.of.length;
        const uint32_t offset = has_planes(buffers) ? ask.plane[plane].m.mem_offset : ask.of.m.offset;
        if (length < buffers->layout.bytes[plane])
            return camera_fail(error, "has buffers of %zu bytes, expected %zu for the picture", length,
                               buffers->layout.bytes[plane]);
        void *address = mmap(NULL, length, PROT_READ | PROT_WRITE, MAP_SHARED, buffers->file, (off_t)offset);
        if (address == MAP_FAILED)
            return camera_fail(error, "can't map %zu bytes of buffer %d: %s", length, buffer, strerror(errno));
        map[plane] = (camera_map_t){address, length};
        if (plane == buffers->layout.memories - 1)
            camera_exchange_map(buffers->exchange, buffer, map);
    }
    return true;
}

bool camera_v4l2_buffers_make(camera_v4l2_buffers_t *buffers, char error[HAL_BOARD_ERROR_LENGTH])
{
    struct v4l2_requestbuffers wish = {.count = 0, .type = buffers->type, .memory = V4L2_MEMORY_MMAP};
    bool takes_hints = ioctl(buffers->file, VIDIOC_REQBUFS, &wish) == 0 &&
                       (wish.capabilities & V4L2_BUF_CAP_SUPPORTS_MMAP_CACHE_HINTS) != 0;
    wish = (struct v4l2_requestbuffers){.count = CAMERA_BUFFERS, .type = buffers->type, .memory = V4L2_MEMORY_MMAP};
    wish.flags = takes_hints ? V4L2_MEMORY_FLAG_NON_COHERENT : 0;
    if (ioctl(buffers->file, VIDIOC_REQBUFS, &wish) != 0)
        return camera_fail(error,
                           errno == EBUSY ? "is used by another program; find it with `fuser -v /dev/video*`"
                                          : "can't have %d buffers: %s; give it more memory (cma= of the kernel)",
                           CAMERA_BUFFERS, strerror(errno));
    buffers->count = (int)wish.count;
    if (wish.count < CAMERA_BUFFERS_MIN || wish.count > CAMERA_BUFFERS_MAX)
        return camera_fail(error, "has %u buffers, expected %d to %d; give it more memory (cma= of the kernel)",
                           wish.count, CAMERA_BUFFERS_MIN, CAMERA_BUFFERS_MAX);
    for (int buffer = 0; buffer < buffers->count; buffer++)
        if (!map_buffer(buffers, buffer, error))
            return false;
    for (int buffer = 0; buffer < buffers->count; buffer++)
        if (!camera_v4l2_fill(buffers, buffer))
            return camera_fail(error, "does not take buffer %d: %s", buffer, strerror(errno));
    return true;
}

void camera_v4l2_buffers_free(camera_v4l2_buffers_t *buffers)
{
    struct v4l2_requestbuffers none = {.count = 0, .type = buffers->type, .memory = V4L2_MEMORY_MMAP};
    (void)ioctl(buffers->file, VIDIOC_REQBUFS, &none); /* of a device that is gone it fails, and is not needed */
    buffers->count = 0;
}

bool camera_v4l2_fill(const camera_v4l2_buffers_t *buffers, int buffer)
{
    ask_t ask;
    ask_for(&ask, buffers, buffer);
    return ioctl(buffers->file, VIDIOC_QBUF, &ask.of) == 0;
}

bool camera_v4l2_fill_returned(const camera_v4l2_buffers_t *buffers)
{
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++) {
        const int buffer = camera_exchange_collect(buffers->exchange);
        if (buffer == CAMERA_NO_BUFFER)
            break;
        if (!camera_v4l2_fill(buffers, buffer))
            return false;
    }
    return true;
}

/* @return Is all of the picture there? */
static bool place_picture(picture_t *picture, const camera_v4l2_buffers_t *buffers, const ask_t *ask)
{
    const camera_v4l2_layout_t *layout = &buffers->layout;
    uint8_t *begin[PICTURE_MAX_PLANES] = {NULL};
    for (int plane = 0; plane < layout->memories; plane++) {
        const camera_map_t map = camera_exchange_memory(buffers->exchange, (int)ask->of.index, plane);
        const size_t used = has_planes(buffers) ? ask->plane[plane].bytesused : ask->of.bytesused;
        const size_t offset = has_planes(buffers) ? ask->plane[plane].data_offset : 0;
        if (used > map.length || offset > used || used - offset < layout->bytes[plane])
            return false;
        begin[plane] = (uint8_t *)map.address + offset;
    }
    *picture = layout->picture;
    picture->data[0] = begin[0];
    if (picture->format == PICTURE_NV12)
        picture->data[1] = layout->memories == 1 ? begin[0] + layout->chroma_offset : begin[1];
    return true;
}

camera_v4l2_got_t camera_v4l2_get(const camera_v4l2_buffers_t *buffers)
{
    ask_t ask;
    ask_for(&ask, buffers, 0);
    if (ioctl(buffers->file, VIDIOC_DQBUF, &ask.of) != 0)
        return errno == EAGAIN ? CAMERA_V4L2_NONE : CAMERA_V4L2_LOST;
    const int buffer = (int)ask.of.index;
    const bool monotonic = (ask.of.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    const int64_t now_us = camera_now_us(),
                  stamp_us = (int64_t)ask.of.timestamp.tv_sec * 1000000 + ask.of.timestamp.tv_usec;
    hal_camera_frame_t frame = {
        .capture_time_us = monotonic && stamp_us < now_us ? stamp_us : now_us,
        .sequence = ask.of.sequence,
    };
    if ((ask.of.flags & V4L2_BUF_FLAG_ERROR) != 0 || !place_picture(&frame.picture, buffers, &ask))
        return camera_v4l2_fill(buffers, buffer) ? CAMERA_V4L2_BROKEN : CAMERA_V4L2_LOST;
    const int older = camera_exchange_put(buffers->exchange, buffer, &frame);
    return older == CAMERA_NO_BUFFER || camera_v4l2_fill(buffers, older) ? CAMERA_V4L2_PICTURE : CAMERA_V4L2_LOST;
}
