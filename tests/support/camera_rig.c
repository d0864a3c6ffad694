// SPDX-License-Identifier: Apache-2.0
// A simulated camera with its video, for tests: 100 small pictures a second.
#include "tests/support/camera_rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

sim_camera_settings_t camera_rig_settings(video_t *video)
{
    return (sim_camera_settings_t){.video = video,
                                   .width = RIG_WIDTH,
                                   .height = RIG_HEIGHT,
                                   .rate = {RIG_START_US, 1000000 / RIG_PERIOD_US, 1},
                                   .seed = 1};
}

camera_rig_t camera_rig_open(const char *name)
{
    char error[FILE_ERROR_LENGTH] = "";
    camera_rig_t rig = {.video = video_open(name, RIG_WIDTH, RIG_HEIGHT, error)};
    if (rig.video == NULL)
        fail_msg("%s", error);
    const sim_camera_settings_t settings = camera_rig_settings(rig.video);
    rig.camera = sim_camera_create(&settings, error);
    if (rig.camera == NULL)
        fail_msg("%s", error);
    return rig;
}

void camera_rig_close(const camera_rig_t *rig)
{
    sim_camera_destroy(rig->camera);
    video_close(rig->video);
}

int64_t camera_rig_time_us(int64_t n)
{
    return RIG_START_US + n * RIG_PERIOD_US;
}

void camera_rig_advance(const camera_rig_t *rig, int64_t now_us)
{
    char error[FILE_ERROR_LENGTH] = "";
    if (!sim_camera_advance(rig->camera, now_us, error))
        fail_msg("%s", error);
}

int64_t camera_rig_sequence_at(const camera_rig_t *rig, int64_t now_us)
{
    hal_camera_frame_t frame;
    camera_rig_advance(rig, now_us);
    const hal_status_t status = hal_camera_take(rig->camera, &frame);
    if (status != HAL_OK)
        return -(int64_t)status;
    hal_camera_release(rig->camera, &frame);
    return frame.sequence;
}

int camera_rig_spoilt_rows(const camera_rig_t *rig, const hal_camera_frame_t *frame, int64_t n)
{
    enum { ROW_BYTES = RIG_WIDTH * 4 };
    char error[FILE_ERROR_LENGTH];
    uint8_t pixels[ROW_BYTES * RIG_HEIGHT];
    const image_t expected = {pixels, RIG_WIDTH, RIG_HEIGHT, ROW_BYTES, IMAGE_XRGB8888};
    assert_true(video_frame(rig->video, n, &expected, error));
    const image_t found = picture_plane(&frame->picture, 0);
    assert_int_equal(frame->picture.format, PICTURE_XRGB8888);
    assert_int_equal(found.width, RIG_WIDTH);
    assert_int_equal(found.height, RIG_HEIGHT);
    int spoilt = 0, changes = 0;
    bool before = false;
    for (int32_t y = 0; y < RIG_HEIGHT; y++) {
        const bool differs = memcmp(image_row(&found, y), image_row(&expected, y), ROW_BYTES) != 0;
        spoilt += differs;
        changes += differs != before;
        before = differs;
    }
    assert_true(changes <= 2);
    return spoilt;
}
