// SPDX-License-Identifier: Apache-2.0
// Names of cameras: their parts, what is refused, and which device file of V4L2 is meant.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "hal/linux/camera_name.h"
#include "hal/linux/camera_v4l2_find.h"

static void names_have_parts(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        camera_name_t is;
    } cases[] = {
        {"v4l2:/dev/video0", {CAMERA_V4L2, true, PICTURE_XRGB8888, "/dev/video0"}},
        {"v4l2:auto", {CAMERA_V4L2, true, PICTURE_XRGB8888, "auto"}},
        {"v4l2:usb-0000:01:00.0-1.3", {CAMERA_V4L2, true, PICTURE_XRGB8888, "usb-0000:01:00.0-1.3"}},
        {"libcamera:platform/vimc.0 Sensor B", {CAMERA_LIBCAMERA, true, PICTURE_XRGB8888, "platform/vimc.0 Sensor B"}},
        {"nv12:libcamera:0", {CAMERA_LIBCAMERA, false, PICTURE_NV12, "0"}},
        {"uyvy:v4l2:vivid", {CAMERA_V4L2, false, PICTURE_UYVY, "vivid"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        camera_name_t parsed;
        if (!camera_name_parse(&parsed, cases[i].name))
            fail_msg("%s: refused", cases[i].name);
        const camera_name_t *is = &cases[i].is;
        if (parsed.kind != is->kind || parsed.any_format != is->any_format ||
            (!is->any_format && parsed.format != is->format) || strcmp(parsed.which, is->which) != 0)
            fail_msg("%s: kind %d, any format %d, format %d, which %s", cases[i].name, parsed.kind, parsed.any_format,
                     parsed.format, parsed.which);
    }
}

static void other_names_are_refused(void **state)
{
    (void)state;
    char long_name[sizeof "v4l2:" + CAMERA_WHICH_LENGTH];
    memset(long_name, 'x', sizeof long_name - 1);
    memcpy(long_name, "v4l2:", strlen("v4l2:"));
    long_name[sizeof long_name - 1] = '\0';
    const char *const names[] = {"",       "/dev/video0", "v4l2",           "v4l2:",           "pattern",
                                 "nv12:",  "nv12:v4l2:",  "nv21:v4l2:auto", "gray8:v4l2:auto", "v4l2x:auto",
                                 long_name};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        camera_name_t parsed = {.kind = CAMERA_SOURCES};
        if (camera_name_parse(&parsed, names[i]) || parsed.kind != CAMERA_SOURCES)
            fail_msg("\"%s\": taken, or half taken", names[i]);
    }
    long_name[sizeof long_name - 2] = '\0';
    camera_name_t longest;
    assert_true(camera_name_parse(&longest, long_name));
}

static void v4l2_names_may_have_a_receiver(void **state)
{
    (void)state;
    camera_v4l2_names_t names;
    assert_true(camera_v4l2_split(&names, "/dev/video0"));
    assert_string_equal(names.video, "/dev/video0");
    assert_string_equal(names.receiver, "");
    assert_true(camera_v4l2_split(&names, "rp1-cfe+tc358743 10-000f"));
    assert_string_equal(names.video, "rp1-cfe");
    assert_string_equal(names.receiver, "tc358743 10-000f");
    assert_false(camera_v4l2_split(&names, "+/dev/v4l-subdev0"));
    assert_false(camera_v4l2_split(&names, "/dev/video0+"));
    assert_string_equal(names.video, "rp1-cfe");
}

static void paths_are_taken_and_missing_devices_told(void **state)
{
    (void)state;
    char path[CAMERA_V4L2_PATH_LENGTH] = "before", error[HAL_BOARD_ERROR_LENGTH] = "";
    assert_false(camera_v4l2_find(path, "no such card", "video", error));
    assert_string_equal(path, "before");
    assert_non_null(strstr(error, "v4l2-ctl --list-devices"));
    assert_true(camera_v4l2_find(path, "/dev/video7", "video", error));
    assert_string_equal(path, "/dev/video7");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_have_parts),
        cmocka_unit_test(other_names_are_refused),
        cmocka_unit_test(v4l2_names_may_have_a_receiver),
        cmocka_unit_test(paths_are_taken_and_missing_devices_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
