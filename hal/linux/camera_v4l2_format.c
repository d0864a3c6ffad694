// SPDX-License-Identifier: Apache-2.0
// Which pictures of V4L2 are pictures of ours: see the header.
#include "hal/linux/camera_v4l2_format.h"

#include "hal/linux/camera_name.h"

const camera_v4l2_format_t camera_v4l2_formats[CAMERA_V4L2_FORMATS] = {
    {V4L2_PIX_FMT_XBGR32, PICTURE_XRGB8888, 1}, {V4L2_PIX_FMT_ABGR32, PICTURE_XRGB8888, 1},
    {V4L2_PIX_FMT_BGR24, PICTURE_RGB888, 1},    {V4L2_PIX_FMT_RGB24, PICTURE_BGR888, 1},
    {V4L2_PIX_FMT_YUYV, PICTURE_YUYV, 1},       {V4L2_PIX_FMT_UYVY, PICTURE_UYVY, 1},
    {V4L2_PIX_FMT_NV12, PICTURE_NV12, 1},       {V4L2_PIX_FMT_NV12M, PICTURE_NV12, 2},
    {V4L2_PIX_FMT_BGR32, PICTURE_XRGB8888, 1}, /* the old name of the first */
};

/* The same of both types. */
typedef struct {
    uint32_t fourcc, width, height, field, colorspace, ycbcr_enc, quantization, planes;
    uint32_t stride[PICTURE_MAX_PLANES];
} facts_t;

static facts_t facts_of(const struct v4l2_format *got)
{
    if (got->type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        const struct v4l2_pix_format_mplane *pix = &got->fmt.pix_mp;
        return (facts_t){
            pix->pixelformat,  pix->width,      pix->height,
            pix->field,        pix->colorspace, pix->ycbcr_enc,
            pix->quantization, pix->num_planes, {pix->plane_fmt[0].bytesperline, pix->plane_fmt[1].bytesperline}};
    }
    const struct v4l2_pix_format *pix = &got->fmt.pix;
    return (facts_t){pix->pixelformat,
                     pix->width,
                     pix->height,
                     pix->field,
                     pix->colorspace,
                     pix->ycbcr_enc,
                     pix->quantization,
                     1,
                     {pix->bytesperline, pix->bytesperline}};
}

static bool judge_colours(picture_t *picture, const facts_t *got, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = camera_format_name(picture->format);
    const bool is_yuv = picture_is_yuv(picture->format);
    const uint32_t range = got->quantization != V4L2_QUANTIZATION_DEFAULT
                               ? got->quantization
                               : V4L2_MAP_QUANTIZATION_DEFAULT(!is_yuv, got->colorspace, got->ycbcr_enc);
    if (is_yuv != (range == V4L2_QUANTIZATION_LIM_RANGE))
        return camera_fail(error, "gives %s of %s range, expected %s range; set the source's range, or another format",
                           name, is_yuv ? "full" : "limited", is_yuv ? "limited" : "full");
    const uint32_t encoding = got->ycbcr_enc != V4L2_YCBCR_ENC_DEFAULT
                                  ? got->ycbcr_enc
                                  : (uint32_t)V4L2_MAP_YCBCR_ENC_DEFAULT(got->colorspace);
    picture->matrix = encoding == V4L2_YCBCR_ENC_709 ? PICTURE_BT709 : PICTURE_BT601;
    if (is_yuv && encoding != V4L2_YCBCR_ENC_709 && encoding != V4L2_YCBCR_ENC_601)
        return camera_fail(error, "gives %s of colour encoding %u of V4L2, expected BT.601 or BT.709; set the source's",
                           name, encoding);
    return true;
}

bool camera_v4l2_layout(camera_v4l2_layout_t *layout, const camera_v4l2_format_t *wanted, const struct v4l2_format *got,
                        int32_t width, int32_t height, char error[HAL_BOARD_ERROR_LENGTH])
{
    const facts_t facts = facts_of(got);
    const char *name = camera_format_name(wanted->format);
    if (facts.fourcc != wanted->fourcc)
        return camera_fail(error, "does not give %s", name);
    if (facts.width != (uint32_t)width || facts.height != (uint32_t)height)
        return camera_fail(error, "gives %s of %ux%u at nearest, expected %dx%d as the room file states", name,
                           facts.width, facts.height, width, height);
    if (facts.field != V4L2_FIELD_NONE && facts.field != V4L2_FIELD_ANY)
        return camera_fail(error, "gives interlaced pictures, expected progressive ones; set the source's mode");
    camera_v4l2_layout_t result = {
        .picture = {.format = wanted->format, .width = width, .height = height},
        .memories = (int)facts.planes,
    };
    if (facts.planes != (uint32_t)wanted->planes || facts.stride[0] > INT32_MAX || facts.stride[1] > INT32_MAX)
        return camera_fail(error, "gives %s in %u memories, expected %d", name, facts.planes, wanted->planes);
    result.picture.stride[0] = (int32_t)facts.stride[0];
    result.picture.stride[1] = (int32_t)facts.stride[wanted->planes - 1];
    if (!picture_is_valid(&result.picture))
        return camera_fail(error, "gives %s of %dx%d with rows of %d bytes, which no picture has", name, width, height,
                           result.picture.stride[0]);
    if (!judge_colours(&result.picture, &facts, error))
        return false;
    result.bytes[0] = (size_t)facts.stride[0] * (size_t)height;
    if (wanted->format == PICTURE_NV12) {
        const size_t chroma = (size_t)result.picture.stride[1] * (size_t)height / 2;
        result.chroma_offset = wanted->planes == 1 ? result.bytes[0] : 0;
        result.bytes[wanted->planes - 1] += chroma;
    }
    *layout = result;
    return true;
}

void camera_v4l2_ask(struct v4l2_format *ask, uint32_t type, const camera_v4l2_format_t *wanted, int32_t width,
                     int32_t height)
{
    *ask = (struct v4l2_format){.type = type};
    if (type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        ask->fmt.pix_mp.pixelformat = wanted->fourcc;
        ask->fmt.pix_mp.width = (uint32_t)width;
        ask->fmt.pix_mp.height = (uint32_t)height;
        ask->fmt.pix_mp.field = V4L2_FIELD_NONE;
        ask->fmt.pix_mp.num_planes = (uint8_t)wanted->planes;
    } else {
        ask->fmt.pix.pixelformat = wanted->fourcc;
        ask->fmt.pix.width = (uint32_t)width;
        ask->fmt.pix.height = (uint32_t)height;
        ask->fmt.pix.field = V4L2_FIELD_NONE;
    }
}
