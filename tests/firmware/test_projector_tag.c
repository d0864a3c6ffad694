// SPDX-License-Identifier: Apache-2.0
// Whole projectors and pictures that say which pose they were drawn from: a head that turns at 100 degrees/s does not
// turn the world on the wall, though drawing takes 50 ms. In mode latest it does.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/pose_sender.h"
#include "sim/run/sim_world.h"
#include "sim/tag/paint_tag.h"
#include "tests/support/scratch.h"

enum { WIDTH = 96, HEIGHT = 54, HZ = 60, POSES_HZ = 240, SECONDS = 8, RENDER_US = 50000, START_US = 1000, TEXT = 1024 };

static const sim_rate_t REFRESH = {8333, HZ, 1};
static const double degrees_per_s = 100;

static double yaw_deg(double time_s)
{
    return fmod(degrees_per_s * time_s, 90.0) - 45.0; /* to and fro would do as well */
}

static int64_t pose_time_us(int64_t n)
{
    return START_US + n * 1000000 / POSES_HZ;
}

/* The newest pose that was there when the engine began to draw the picture that the camera takes at that time. */
static int64_t drawn_pose(int64_t capture_us)
{
    int64_t n = (capture_us - RENDER_US - START_US) * POSES_HZ / 1000000;
    while (pose_time_us(n) > capture_us - RENDER_US)
        n--;
    return n < 0 ? 0 : n;
}

/* The engine's video: frame f is captured at f / 30 s. */
static void write_video(const char *path)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (int f = 0; f < SECONDS * 30; f++) {
        uint8_t pixels[WIDTH * HEIGHT * 4];
        memset(pixels, 100, sizeof pixels);
        const paint_tag_picture_t picture = {pixels, WIDTH, HEIGHT, (ptrdiff_t)WIDTH * 4, 4};
        const int64_t drawn_us = pose_time_us(drawn_pose((int64_t)f * 1000000 / 30));
        const paint_tag_t tag = {.capture_time_us = (uint32_t)drawn_us, .frame_number = (uint32_t)f};
        assert_true(paint_tag(&picture, &tag));
        assert_int_equal(fwrite(pixels, sizeof pixels, 1, file), 1);
    }
    assert_int_equal(fclose(file), 0);
}

static void make_turn(pose_list_t *list)
{
    list->count = (size_t)SECONDS * POSES_HZ;
    list->entry = calloc(list->count, sizeof *list->entry);
    assert_non_null(list->entry);
    for (size_t n = 0; n < list->count; n++) {
        const double half = yaw_deg((double)n / POSES_HZ) * M_PI / 360.0;
        list->entry[n] = (pose_list_entry_t){
            .time_us = (int64_t)n * 1000000 / POSES_HZ,
            .pose = {.eye_nm = {0, 0, -500000000},
                     .quaternion_q30 = {(int32_t)lround(cos(half) * 1073741824.0), 0,
                                        (int32_t)lround(sin(half) * 1073741824.0), 0}},
        };
    }
}

static double yaw_of(const pose_t *pose)
{
    return 2.0 * atan2(pose->quaternion_q30[2], pose->quaternion_q30[0]) * 180.0 / M_PI;
}

/* @return The largest angle by which the wall's picture was turned against the world, in the last seconds. */
static double swim_deg(const scratch_t *scratch, const char *mode)
{
    char path[SCRATCH_PATH_LENGTH], text[TEXT], error[ROOM_MESSAGE_LENGTH] = "";
    static room_t room;
    pose_list_t list;
    pose_sender_t sender;
    const int length =
        snprintf(text, sizeof text,
                 "camera: {width: %d, height: %d, focal_px: [60, 60], principal_px: [48, 27]}\n"
                 "boards:\n  - name: wall\n    node: 1\n    projector: {width: 64, height: 36}\n"
                 "    wall: {corners_mm: [[-2000, -1125, 1000], [2000, -1125, 1000], [2000, 1125, 1000], null]}\n"
                 "frames: {pose: %s, render_ms: 50}\n",
                 WIDTH, HEIGHT, mode);
    scratch_path(scratch, "room.yaml", path);
    scratch_write(path, text, (size_t)length);
    assert_true(room_load(&room, path, NULL, NULL, error));
    scratch_path(scratch, "tagged.xrgb", path);
    write_video(path);
    video_t *video = video_open(path, WIDTH, HEIGHT, error);
    assert_string_equal(error, "");
    make_turn(&list);
    const sim_world_config_t config = {.room = &room, .video = video, .refresh = REFRESH, .seed = 1};
    sim_world_t *world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    const pose_sender_config_t sending = {
        .bus = sim_world_bus(world), .list = &list, .fd = true, .start_us = START_US, .sync = true};
    assert_true(pose_sender_open(&sender, &sending));
    double worst = 0;
    for (int64_t step = 0; step < (int64_t)(SECONDS - 1) * HZ; step++) {
        const int64_t now_us = sim_rate_time_us(&REFRESH, step);
        pose_sender_advance(&sender, now_us);
        assert_true(sim_world_step(world, now_us, error));
        const projector_t *projector = sim_world_projector(world, 0);
        if (step < 5 * HZ)
            continue; /* bus time is there by then */
        assert_true(projector->report.corrected);
        const int64_t drawn = drawn_pose(projector->choice.now.capture_us);
        const double off = yaw_of(&projector->report.pose) - yaw_of(&list.entry[drawn].pose);
        if (fabs(off) < 45) /* not across the jump back */
            worst = fmax(worst, fabs(off));
    }
    sim_world_destroy(world);
    video_close(video);
    free(list.entry);
    printf("%s: the picture is turned by up to %.4f degrees\n", mode, worst);
    return worst;
}

static void test_tags_keep_the_world_still(void **state)
{
    assert_true(swim_deg(*state, "tag") < 0.1);
    assert_true(swim_deg(*state, "latest") > 5.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tags_keep_the_world_still),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
