// SPDX-License-Identifier: Apache-2.0
// A picture as cameras deliver it and displays take it: the formats, by DRM's names, and the planes they are made of.
#include "warp_fixed/picture.h"

picture_t picture_from_image(const image_t *image)
{
    return (picture_t){.format = image->format == IMAGE_GRAY8 ? PICTURE_GRAY8 : PICTURE_XRGB8888,
                       .width = image->width,
                       .height = image->height,
                       .data = {image->data},
                       .stride = {image->stride}};
}

bool picture_is_yuv(picture_format_t format)
{
    return format == PICTURE_YUYV || format == PICTURE_UYVY || format == PICTURE_NV12;
}

int picture_chroma_rows_log2(picture_format_t format)
{
    return format == PICTURE_NV12 ? 1 : 0;
}

/* Bytes of a pixel in plane 0. */
static int32_t pixel_bytes(picture_format_t format)
{
    switch (format) {
    case PICTURE_GRAY8:
    case PICTURE_NV12:
        return 1;
    case PICTURE_YUYV:
    case PICTURE_UYVY:
        return 2;
    case PICTURE_RGB888:
    case PICTURE_BGR888:
        return 3;
    case PICTURE_XRGB8888:
        return 4;
    case PICTURE_FORMATS:
        break;
    }
    return 0;
}

bool picture_is_valid(const picture_t *picture)
{
    const int32_t bytes = pixel_bytes(picture->format);
    const bool yuv = picture_is_yuv(picture->format), planar = picture->format == PICTURE_NV12;
    return bytes > 0 && picture->width >= 1 && picture->width <= IMAGE_MAX_WIDTH && picture->height >= 1 &&
           picture->height <= IMAGE_MAX_HEIGHT && picture->stride[0] >= picture->width * bytes &&
           !(yuv && picture->width % 2 != 0) && !(planar && picture->height % 2 != 0) &&
           !(planar && picture->stride[1] < picture->width);
}

image_t picture_plane(const picture_t *picture, int plane)
{
    image_t image = {picture->data[plane], picture->width, picture->height, picture->stride[plane],
                     picture->format == PICTURE_XRGB8888 ? IMAGE_XRGB8888 : IMAGE_GRAY8};
    if (plane > 0) {
        image.format = IMAGE_UV88;
        image.width /= 2;
        image.height >>= picture_chroma_rows_log2(picture->format);
    }
    return image;
}
