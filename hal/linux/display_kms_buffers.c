// SPDX-License-Identifier: Apache-2.0
// The display's buffers: dumb ones, mapped once, each of which the display can scan out in several formats.
#include "hal/linux/display_kms_buffers.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <string.h>
#include <sys/mman.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

uint32_t kms_fourcc(picture_format_t format)
{
    if (format == PICTURE_XRGB8888)
        return DRM_FORMAT_XRGB8888;
    if (format == PICTURE_NV12)
        return DRM_FORMAT_NV12;
    return format == PICTURE_YUYV ? DRM_FORMAT_YUYV : 0;
}

/* Bytes from row to row: a YUV row is given a half, or a quarter, of an XRGB8888 one. */
static int32_t pitch_of(const kms_buffers_t *buffers, picture_format_t format)
{
    if (format == PICTURE_NV12)
        return buffers->pitch / 4;
    return format == PICTURE_YUYV ? buffers->pitch / 2 : buffers->pitch;
}

static int make_buffer(kms_buffers_t *buffers, kms_buffer_t *buffer, int card)
{
    uint64_t offset;
    uint32_t pitch, width = (uint32_t)buffers->width, height = (uint32_t)buffers->height;
    uint64_t bytes;
    if (drmModeCreateDumbBuffer(card, width, height, 32, 0, &buffer->handle, &pitch, &bytes) != 0 ||
        drmModeMapDumbBuffer(card, buffer->handle, &offset) != 0)
        return errno;
    void *data = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, card, (off_t)offset);
    if (data == MAP_FAILED)
        return errno;
    buffer->data = data;
    buffers->pitch = (int32_t)pitch;
    buffers->bytes = (int64_t)bytes;
    memset(data, 0, bytes);
    return 0;
}

int kms_buffers_open(kms_buffers_t *buffers, int card, int32_t width, int32_t height)
{
    *buffers = (kms_buffers_t){.width = width, .height = height};
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        const int failure = make_buffer(buffers, &buffers->buffer[i], card);
        if (failure != 0)
            return failure;
    }
    return kms_buffers_add_format(buffers, card, PICTURE_XRGB8888);
}

int kms_buffers_add_format(kms_buffers_t *buffers, int card, picture_format_t format)
{
    const bool planar = format == PICTURE_NV12;
    const uint32_t pitch = (uint32_t)pitch_of(buffers, format), chroma = pitch * (uint32_t)buffers->height;
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        kms_buffer_t *buffer = &buffers->buffer[i];
        const uint32_t handles[4] = {buffer->handle, planar ? buffer->handle : 0};
        const uint32_t pitches[4] = {pitch, planar ? pitch : 0}, offsets[4] = {0, planar ? chroma : 0};
        if (drmModeAddFB2(card, (uint32_t)buffers->width, (uint32_t)buffers->height, kms_fourcc(format), handles,
                          pitches, offsets, &buffer->framebuffer[format], 0) != 0) {
            const int failure = errno;
            buffer->framebuffer[format] = 0;
            kms_buffers_drop_format(buffers, card, format);
            return failure;
        }
    }
    return 0;
}

void kms_buffers_drop_format(kms_buffers_t *buffers, int card, picture_format_t format)
{
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        uint32_t *framebuffer = &buffers->buffer[i].framebuffer[format];
        if (*framebuffer != 0)
            (void)drmModeRmFB(card, *framebuffer);
        *framebuffer = 0;
    }
}

picture_t kms_buffers_picture(const kms_buffers_t *buffers, int32_t index, picture_format_t format)
{
    const int32_t pitch = pitch_of(buffers, format);
    picture_t picture = {
        .format = format,
        .width = buffers->width,
        .height = buffers->height,
        .data = {buffers->buffer[index].data},
        .stride = {pitch},
    };
    if (format == PICTURE_NV12) {
        picture.data[1] = picture.data[0] + (ptrdiff_t)pitch * buffers->height;
        picture.stride[1] = pitch;
    }
    return picture;
}

void kms_buffers_close(kms_buffers_t *buffers, int card)
{
    for (int format = 0; format < PICTURE_FORMATS; format++)
        kms_buffers_drop_format(buffers, card, (picture_format_t)format);
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        kms_buffer_t *buffer = &buffers->buffer[i];
        if (buffer->data != NULL)
            munmap(buffer->data, (size_t)buffers->bytes);
        if (buffer->handle != 0)
            (void)drmModeDestroyDumbBuffer(card, buffer->handle);
        *buffer = (kms_buffer_t){0};
    }
}
