// SPDX-License-Identifier: Apache-2.0
// Pictures of V4L2: every format in both kinds of device, rows and planes in memory, colours, and what does not fit.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "hal/linux/camera_v4l2_format.h"

enum { WIDTH = 640, HEIGHT = 480, PAD = 32 };

static const camera_v4l2_format_t *format_of(uint32_t fourcc)
{
    int i = 0;
    while (i < CAMERA_V4L2_FORMATS - 1 && camera_v4l2_formats[i].fourcc != fourcc)
        i++;
    assert_int_equal(camera_v4l2_formats[i].fourcc, fourcc);
    return &camera_v4l2_formats[i];
}

/* What a well-behaved device leaves of what was asked for: rows a little longer than they must be. */
static struct v4l2_format answer(const camera_v4l2_format_t *format, uint32_t type, uint32_t stride)
{
    struct v4l2_format got;
    camera_v4l2_ask(&got, type, format, WIDTH, HEIGHT);
    if (type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        assert_int_equal(got.fmt.pix_mp.num_planes, format->planes);
        got.fmt.pix_mp.colorspace = V4L2_COLORSPACE_REC709;
        for (int plane = 0; plane < format->planes; plane++)
            got.fmt.pix_mp.plane_fmt[plane].bytesperline = stride;
    } else {
        got.fmt.pix.colorspace = V4L2_COLORSPACE_REC709;
        got.fmt.pix.bytesperline = stride;
    }
    return got;
}

static const struct {
    uint32_t fourcc;
    picture_format_t format;
    uint32_t row; /* bytes of WIDTH pixels */
} formats[] = {
    {V4L2_PIX_FMT_XBGR32, PICTURE_XRGB8888, 4 * WIDTH}, {V4L2_PIX_FMT_ABGR32, PICTURE_XRGB8888, 4 * WIDTH},
    {V4L2_PIX_FMT_BGR32, PICTURE_XRGB8888, 4 * WIDTH},  {V4L2_PIX_FMT_BGR24, PICTURE_RGB888, 3 * WIDTH},
    {V4L2_PIX_FMT_RGB24, PICTURE_BGR888, 3 * WIDTH},    {V4L2_PIX_FMT_YUYV, PICTURE_YUYV, 2 * WIDTH},
    {V4L2_PIX_FMT_UYVY, PICTURE_UYVY, 2 * WIDTH},       {V4L2_PIX_FMT_NV12, PICTURE_NV12, WIDTH},
    {V4L2_PIX_FMT_NV12M, PICTURE_NV12, WIDTH},
};

static void every_format_has_its_layout(void **state)
{
    (void)state;
    static const uint32_t types[] = {V4L2_BUF_TYPE_VIDEO_CAPTURE, V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE};
    char error[HAL_BOARD_ERROR_LENGTH];
    _Static_assert(sizeof formats / sizeof formats[0] == CAMERA_V4L2_FORMATS, "all of them");
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        for (size_t type = 0; type < 2; type++) {
            const camera_v4l2_format_t *format = format_of(formats[i].fourcc);
            if (format->planes == 2 && types[type] == V4L2_BUF_TYPE_VIDEO_CAPTURE)
                continue;
            const uint32_t stride = formats[i].row + PAD;
            const struct v4l2_format got = answer(format, types[type], stride);
            camera_v4l2_layout_t layout;
            if (!camera_v4l2_layout(&layout, format, &got, WIDTH, HEIGHT, error))
                fail_msg("format %#x: %s", (unsigned)format->fourcc, error);
            const size_t luma = (size_t)stride * HEIGHT, chroma = format->format == PICTURE_NV12 ? luma / 2 : 0;
            assert_int_equal(layout.picture.format, formats[i].format);
            assert_int_equal(layout.picture.width, WIDTH);
            assert_int_equal(layout.picture.height, HEIGHT);
            assert_int_equal(layout.picture.stride[0], stride);
            assert_int_equal(layout.memories, format->planes);
            assert_int_equal(layout.bytes[0], format->planes == 1 ? luma + chroma : luma);
            if (format->planes == 2)
                assert_int_equal(layout.bytes[1], chroma);
            if (chroma != 0) {
                assert_int_equal(layout.picture.stride[1], stride);
                assert_int_equal(layout.chroma_offset, format->planes == 1 ? luma : 0);
            }
        }
    }
}

typedef struct {
    uint32_t fourcc, colorspace, ycbcr_enc, quantization;
    const char *says; /* NULL: it fits */
    picture_matrix_t matrix;
} colours_t;

static void colours_are_of_a_matrix_and_range(void **state)
{
    (void)state;
    static const colours_t cases[] = {
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_SRGB, 0, 0, NULL, PICTURE_BT601}, /* a webcam */
        {V4L2_PIX_FMT_UYVY, V4L2_COLORSPACE_SMPTE170M, 0, 0, NULL, PICTURE_BT601},
        {V4L2_PIX_FMT_NV12, V4L2_COLORSPACE_REC709, 0, 0, NULL, PICTURE_BT709},
        {V4L2_PIX_FMT_NV12, V4L2_COLORSPACE_SRGB, V4L2_YCBCR_ENC_709, V4L2_QUANTIZATION_LIM_RANGE, NULL, PICTURE_BT709},
        {V4L2_PIX_FMT_NV12, V4L2_COLORSPACE_REC709, V4L2_YCBCR_ENC_601, 0, NULL, PICTURE_BT601},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_JPEG, 0, 0, "yuyv of full range", PICTURE_BT601},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_REC709, 0, V4L2_QUANTIZATION_FULL_RANGE, "expected limited", PICTURE_BT709},
        {V4L2_PIX_FMT_YUYV, V4L2_COLORSPACE_BT2020, 0, 0, "expected BT.601 or BT.709", PICTURE_BT601},
        {V4L2_PIX_FMT_XBGR32, V4L2_COLORSPACE_SRGB, 0, V4L2_QUANTIZATION_FULL_RANGE, NULL, PICTURE_BT601},
        {V4L2_PIX_FMT_XBGR32, V4L2_COLORSPACE_SRGB, 0, V4L2_QUANTIZATION_LIM_RANGE, "limited range", PICTURE_BT601},
        {V4L2_PIX_FMT_RGB24, V4L2_COLORSPACE_BT2020, 0, 0, NULL, PICTURE_BT601},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const camera_v4l2_format_t *format = format_of(cases[i].fourcc);
        struct v4l2_format got = answer(format, V4L2_BUF_TYPE_VIDEO_CAPTURE, 4 * WIDTH);
        got.fmt.pix.colorspace = cases[i].colorspace;
        got.fmt.pix.ycbcr_enc = cases[i].ycbcr_enc;
        got.fmt.pix.quantization = cases[i].quantization;
        char error[HAL_BOARD_ERROR_LENGTH] = "";
        camera_v4l2_layout_t layout = {.memories = -1};
        const bool fits = camera_v4l2_layout(&layout, format, &got, WIDTH, HEIGHT, error);
        if (fits != (cases[i].says == NULL))
            fail_msg("case %zu: fits %d: %s", i, fits, error);
        if (!fits && (strstr(error, cases[i].says) == NULL || layout.memories != -1))
            fail_msg("case %zu: \"%s\" lacks \"%s\", or the layout is written", i, error, cases[i].says);
        if (fits && picture_is_yuv(format->format))
            assert_int_equal(layout.picture.matrix, cases[i].matrix);
    }
}

static void refuse(const struct v4l2_format *got, const camera_v4l2_format_t *format, const char *says)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    camera_v4l2_layout_t layout = {.memories = -1};
    if (camera_v4l2_layout(&layout, format, got, WIDTH, HEIGHT, error))
        fail_msg("taken, expected \"%s\"", says);
    assert_int_equal(layout.memories, -1);
    if (strstr(error, says) == NULL)
        fail_msg("\"%s\" lacks \"%s\"", error, says);
}

static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    const camera_v4l2_format_t *yuyv = format_of(V4L2_PIX_FMT_YUYV), *nv12m = format_of(V4L2_PIX_FMT_NV12M);
    struct v4l2_format got = answer(yuyv, V4L2_BUF_TYPE_VIDEO_CAPTURE, 2 * WIDTH);
    got.fmt.pix.width = WIDTH - 4;
    refuse(&got, yuyv, "yuyv of 636x480 at nearest, expected 640x480");
    got = answer(yuyv, V4L2_BUF_TYPE_VIDEO_CAPTURE, 2 * WIDTH);
    got.fmt.pix.pixelformat = V4L2_PIX_FMT_MJPEG;
    refuse(&got, yuyv, "does not give yuyv");
    got = answer(yuyv, V4L2_BUF_TYPE_VIDEO_CAPTURE, 2 * WIDTH);
    got.fmt.pix.field = V4L2_FIELD_INTERLACED;
    refuse(&got, yuyv, "interlaced");
    got = answer(yuyv, V4L2_BUF_TYPE_VIDEO_CAPTURE, 2 * WIDTH - 1);
    refuse(&got, yuyv, "rows of 1279 bytes");
    got = answer(yuyv, V4L2_BUF_TYPE_VIDEO_CAPTURE, UINT32_MAX);
    refuse(&got, yuyv, "memories");
    got = answer(nv12m, V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE, WIDTH);
    got.fmt.pix_mp.num_planes = 1;
    refuse(&got, nv12m, "1 memories, expected 2");
    got = answer(nv12m, V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE, WIDTH);
    got.fmt.pix_mp.plane_fmt[1].bytesperline = WIDTH / 2;
    refuse(&got, nv12m, "no picture has");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_has_its_layout),
        cmocka_unit_test(colours_are_of_a_matrix_and_range),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
