// SPDX-License-Identifier: Apache-2.0
// Which camera of libcamera's is meant, and which of its formats is taken, with a library that this test plays.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <drm_fourcc.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/camera_libcamera_choice.h"

/* A camera with some formats of one size. */
struct libcamera_session {
    const char *ids[2], *models[2];
    int count;
    uint32_t formats[3], width, height; /* formats end with 0 */
    libcamera_colours_t colours;
    int failure; /* of libcamera_try(), or 0 */
    libcamera_format_t last;
};

int libcamera_count(const libcamera_session_t *session)
{
    return session->count;
}

void libcamera_name(const libcamera_session_t *session, int camera, libcamera_name_t *name)
{
    memset(name, 0, sizeof *name);
    strcpy(name->id, session->ids[camera]);
    strcpy(name->model, session->models[camera]);
}

int libcamera_open(libcamera_session_t **session)
{
    (void)session;
    return -EACCES;
}

/* As pipelines do: an unknown format becomes the first, and any size theirs. */
int libcamera_try(libcamera_session_t *session, int camera, const libcamera_format_t *wish, unsigned buffers,
                  libcamera_format_t *given)
{
    assert_int_equal(camera, 1);
    assert_int_equal(buffers, CAMERA_BUFFERS);
    *given = (libcamera_format_t){session->formats[0], session->width, session->height, 0, session->colours, "sYCC"};
    for (int i = 0; i < 3; i++)
        if (session->formats[i] == wish->fourcc)
            given->fourcc = wish->fourcc;
    session->last = *wish;
    return session->failure;
}

static libcamera_session_t two_cameras(void)
{
    return (libcamera_session_t){
        .ids = {"/base/i2c/imx219@10", "/base/usb-1.2"},
        .models = {"imx219", "Webcam"},
        .count = 2,
        .formats = {DRM_FORMAT_NV12, DRM_FORMAT_YUYV},
        .width = 640,
        .height = 480,
    };
}

static camera_wanted_t wanted_of(const char *name)
{
    camera_wanted_t wanted = {.width = 640, .height = 480, .rate_frames = 60, .rate_seconds = 1};
    assert_true(camera_name_parse(&wanted.name, name));
    return wanted;
}

static void cameras_have_three_names(void **state)
{
    (void)state;
    const libcamera_session_t session = two_cameras();
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    assert_int_equal(camera_libcamera_find(&session, "0", error), 0);
    assert_int_equal(camera_libcamera_find(&session, "1", error), 1);
    assert_int_equal(camera_libcamera_find(&session, "imx219", error), 0);
    assert_int_equal(camera_libcamera_find(&session, "/base/usb-1.2", error), 1);
    assert_string_equal(error, "");
    static const char *const none[] = {"2", "-1", "00", "imx", "/base"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_int_equal(camera_libcamera_find(&session, none[i], error), -1);
        assert_non_null(strstr(error, "is not among the 2 cameras here; plug it in"));
    }
}

static void expect(libcamera_session_t *session, const char *name, bool fits, picture_format_t format,
                   picture_matrix_t matrix)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    const camera_wanted_t wanted = wanted_of(name);
    picture_t picture;
    if (camera_libcamera_fit(session, 1, &wanted, &picture, error) != fits)
        fail_msg("%s: fits is not %d, %s", name, fits, error);
    if (!fits)
        return;
    assert_int_equal(picture.format, format);
    assert_int_equal(picture.matrix, matrix);
    assert_int_equal(picture.width, 640);
    assert_int_equal(picture.height, 480);
    assert_int_equal(session->last.colours, picture_is_yuv(format) ? LIBCAMERA_BT709 : LIBCAMERA_UNTOLD);
}

static void the_best_format_that_fits_is_taken(void **state)
{
    (void)state;
    libcamera_session_t session = two_cameras();
    expect(&session, "libcamera:1", true, PICTURE_YUYV, PICTURE_BT601);
    expect(&session, "nv12:libcamera:1", true, PICTURE_NV12, PICTURE_BT601);
    expect(&session, "uyvy:libcamera:1", false, PICTURE_UYVY, PICTURE_BT601);
    session.colours = LIBCAMERA_BT709;
    expect(&session, "libcamera:1", true, PICTURE_YUYV, PICTURE_BT709);
    session.formats[2] = DRM_FORMAT_BGR888;
    session.colours = LIBCAMERA_OTHER_COLOURS; /* which RGB has not */
    expect(&session, "libcamera:1", true, PICTURE_BGR888, PICTURE_BT601);
    expect(&session, "yuyv:libcamera:1", false, PICTURE_YUYV, PICTURE_BT601);
}

static void expect_error(libcamera_session_t *session, const char *name, const char *text)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    const camera_wanted_t wanted = wanted_of(name);
    picture_t picture = {.width = 77}, before = picture;
    assert_false(camera_libcamera_fit(session, 1, &wanted, &picture, error));
    assert_memory_equal(&picture, &before, sizeof picture);
    if (strstr(error, text) == NULL)
        fail_msg("%s: expected \"%s\", found \"%s\"", name, text, error);
}

static void what_does_not_fit_is_told(void **state)
{
    (void)state;
    libcamera_session_t session = two_cameras();
    char error[HAL_BOARD_ERROR_LENGTH];
    libcamera_session_t *none = NULL;
    assert_false(camera_libcamera_start(&none, error));
    assert_non_null(strstr(error, "libcamera does not start: Permission denied"));
    expect_error(&session, "xrgb8888:libcamera:1", "gives none of the formats that are wanted");
    session.width = 636;
    expect_error(&session, "yuyv:libcamera:1", "gives yuyv of 636x480 at nearest, expected 640x480");
    session.width = 640;
    session.colours = LIBCAMERA_OTHER_COLOURS;
    expect_error(&session, "libcamera:1", "gives colours sYCC, expected BT.601 or BT.709 of limited range");
    session.failure = -ENODEV;
    expect_error(&session, "libcamera:1", "has no video stream");
    session.failure = -EINVAL;
    expect_error(&session, "yuyv:libcamera:1", "has no valid configuration for yuyv");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_have_three_names),
        cmocka_unit_test(the_best_format_that_fits_is_taken),
        cmocka_unit_test(what_does_not_fit_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
