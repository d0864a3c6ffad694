// SPDX-License-Identifier: Apache-2.0
// The simulated camera: when pictures come, and how they are lent.
#include "sim/devices/sim_camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "sim/files/png_file.h"
#include "sim/devices/sim_clock.h"
#include "tests/support/camera_rig.h"
#include "tests/support/scratch.h"

static void test_capture_times_are_told_on_the_boards_clock(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    camera_rig_t rig = camera_rig_open("pattern");
    const sim_clock_settings_t ahead = {.offset_us = 7000000};
    hal_time_t *clock = sim_clock_create(&ahead, error);
    sim_camera_settings_t settings = camera_rig_settings(rig.video);
    settings.clock = clock;
    sim_camera_destroy(rig.camera);
    rig.camera = sim_camera_create(&settings, error);
    hal_camera_frame_t frame;
    camera_rig_advance(&rig, camera_rig_time_us(3));
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
    assert_int_equal(frame.capture_time_us, camera_rig_time_us(3) + 7000000);
    hal_camera_release(rig.camera, &frame);
    camera_rig_close(&rig);
    sim_clock_destroy(clock);
}

static void test_pictures_come_on_time(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    hal_camera_frame_t frame = {.sequence = 77};
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_EMPTY);
    camera_rig_advance(&rig, camera_rig_time_us(0) - 1);
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_EMPTY);
    assert_int_equal(frame.sequence, 77);
    for (int64_t n = 0; n < 6; n++) {
        camera_rig_advance(&rig, camera_rig_time_us(n));
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
        assert_int_equal(frame.sequence, n);
        assert_int_equal(frame.capture_time_us, camera_rig_time_us(n));
        assert_int_equal(camera_rig_spoilt_rows(&rig, &frame, n), 0);
        hal_camera_release(rig.camera, &frame);
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_EMPTY);
        camera_rig_advance(&rig, camera_rig_time_us(n + 1) - 1);
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_EMPTY);
    }
    camera_rig_advance(&rig, camera_rig_time_us(200) + 3); /* the newest of many, and the video has wrapped around */
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
    assert_int_equal(frame.sequence, 200);
    assert_int_equal(camera_rig_spoilt_rows(&rig, &frame, 200 % 64), 0);
    camera_rig_close(&rig);
}

static void test_lent_pictures_stay(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    hal_camera_frame_t lent[HAL_CAMERA_LENT], another = {.sequence = 77};
    for (int n = 0; n < HAL_CAMERA_LENT; n++) {
        camera_rig_advance(&rig, camera_rig_time_us(n + 1));
        assert_int_equal(hal_camera_take(rig.camera, &lent[n]), HAL_OK);
    }
    for (int64_t n = HAL_CAMERA_LENT + 1; n < 12; n++) {
        camera_rig_advance(&rig, camera_rig_time_us(n));
        assert_int_equal(hal_camera_take(rig.camera, &another), HAL_FULL);
        assert_int_equal(another.sequence, 77);
    }
    for (int n = 0; n < HAL_CAMERA_LENT; n++)
        assert_int_equal(camera_rig_spoilt_rows(&rig, &lent[n], n + 1), 0);
    hal_camera_release(rig.camera, &lent[0]);
    assert_int_equal(hal_camera_take(rig.camera, &another), HAL_OK);
    assert_int_equal(another.sequence, 11);
    assert_int_equal(camera_rig_spoilt_rows(&rig, &another, 11), 0);
    for (int n = 1; n < HAL_CAMERA_LENT; n++)
        assert_int_equal(camera_rig_spoilt_rows(&rig, &lent[n], n + 1), 0);
    camera_rig_close(&rig);
}

static void test_gray_latency_and_the_video_s_own_rate(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    sim_camera_settings_t settings = camera_rig_settings(rig.video);
    settings.format = PICTURE_GRAY8;
    settings.latency_us = 7000;
    settings.rate.frames = 0;
    char error[FILE_ERROR_LENGTH];
    const camera_rig_t gray = {rig.video, sim_camera_create(&settings, error)};
    assert_int_equal(camera_rig_sequence_at(&gray, RIG_START_US + 100000 + 6999), 2);
    hal_camera_frame_t frame;
    camera_rig_advance(&gray, RIG_START_US + 100000 + 7000);
    assert_int_equal(hal_camera_take(gray.camera, &frame), HAL_OK);
    assert_int_equal(frame.sequence, 3); /* at 30 a second */
    assert_int_equal(frame.capture_time_us, RIG_START_US + 100000);
    assert_int_equal(frame.picture.format, PICTURE_GRAY8);
    assert_int_equal(frame.picture.data[0][0], 255);
    assert_int_equal(frame.picture.data[0][frame.picture.stride[0] + 5],
                     (19595 * 191 + 38470 * 191 + 7471 * 191 + 32768) >> 16);
    sim_camera_destroy(gray.camera);
    camera_rig_close(&rig);
}

static void test_a_video_that_vanishes(void **state)
{
    char path[2][SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    uint8_t pixels[RIG_WIDTH * RIG_HEIGHT];
    for (int i = 0; i < 2; i++) {
        memset(pixels, 50 * i, sizeof pixels);
        scratch_path(*state, i == 0 ? "v_0.png" : "v_1.png", path[i]);
        assert_true(png_file_write(path[i], &(image_t){pixels, RIG_WIDTH, RIG_HEIGHT, RIG_WIDTH, IMAGE_GRAY8}, error));
    }
    char name[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "v_%d.png", name);
    const camera_rig_t rig = camera_rig_open(name);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(0)), 0);
    assert_int_equal(unlink(path[1]), 0);
    assert_false(sim_camera_advance(rig.camera, camera_rig_time_us(1), error));
    assert_non_null(strstr(error, "v_1.png: cannot read"));
    hal_camera_frame_t frame;
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_EMPTY);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(2)), 2);
    camera_rig_close(&rig);
}

static void test_bad_settings(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    char error[FILE_ERROR_LENGTH];
    sim_camera_settings_t settings = camera_rig_settings(rig.video);
    settings.width = IMAGE_MAX_WIDTH + 1;
    assert_null(sim_camera_create(&settings, error));
    assert_string_equal(error, "camera: picture 4097x32, expected at most 4096x2160");
    settings = camera_rig_settings(rig.video);
    settings.format = PICTURE_NV12;
    settings.height = 31;
    assert_null(sim_camera_create(&settings, error));
    assert_string_equal(error, "camera: picture 64x31, expected an even size for nv12");
    settings = camera_rig_settings(rig.video);
    settings.rate.seconds = 0;
    assert_null(sim_camera_create(&settings, error));
    settings = camera_rig_settings(rig.video);
    settings.latency_us = -1;
    assert_null(sim_camera_create(&settings, error));
    assert_string_equal(error, "camera: latency -1 us, expected 0 or more");
    camera_rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pictures_come_on_time), cmocka_unit_test(test_capture_times_are_told_on_the_boards_clock),
        cmocka_unit_test(test_lent_pictures_stay),    cmocka_unit_test(test_gray_latency_and_the_video_s_own_rate),
        cmocka_unit_test(test_a_video_that_vanishes), cmocka_unit_test(test_bad_settings),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
