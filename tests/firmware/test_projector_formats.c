// SPDX-License-Identifier: Apache-2.0
// Cameras of every format, and workers: what the wall shows is the frame that the held picture and its pose make.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "sim/devices/camera_format.h"
#include "tests/firmware/projector_bench.h"

enum { WIDTH = 96, HEIGHT = 54, STEPS = 90 };

static projector_t board_zero;
static warp_t warp;

/* The frame that the projector must have made last. */
static void make_expected(uint8_t *bytes)
{
    const image_t image = {bytes, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = picture_from_image(&image);
    homography_t homography;
    warp_init(&warp, *bench.room.board[0].method, bench.room.board[0].step_all, bench.room.board[0].border);
    assert_true(
        homography_from_pose(&homography, &bench.room.camera, &bench.room.board[0].wall, &board_zero.report.pose.pose));
    assert_true(warp_plan(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &board_zero.picture.picture));
    warp_steps_run(&warp, NULL);
}

/* Run board 0 with a camera of its own. @return how far its picture is from another one, in levels per byte. */
static double difference_to(const uint8_t *other, uint8_t *shown_bytes, picture_format_t format, hal_workers_t *workers)
{
    static uint8_t expected[WIDTH * HEIGHT * 4];
    char error[FILE_ERROR_LENGTH] = "";
    const sim_camera_settings_t settings = {
        .video = bench.video, .width = WIDTH, .height = HEIGHT, .format = format, .rate = {0, 30, 1}};
    hal_board_t board = *devices();
    board.camera = sim_camera_create(&settings, error);
    board.workers = workers;
    assert_string_equal(error, "");
    projector_init(&board_zero, &bench.room, &bench.room.board[0], &board, &warp_kernels_scalar);
    for (int i = 0; i < STEPS; i++) {
        room_bench_advance(&bench);
        assert_true(sim_camera_advance(board.camera, room_bench_now_us(&bench), error));
        projector_step(&board_zero);
        bench.step++;
    }
    assert_int_equal(board_zero.report.state, CAN_BOARD_RUNNING);
    assert_true(board_zero.report.corrected);
    assert_int_equal(board_zero.picture.picture.format, format);
    const image_t *shown = sim_world_shown(bench.world, 0, room_bench_now_us(&bench));
    assert_non_null(shown);
    make_expected(expected);
    double sum = 0;
    for (int32_t y = 0; y < HEIGHT; y++)
        memcpy(shown_bytes + (ptrdiff_t)y * WIDTH * 4, image_row(shown, y), (size_t)WIDTH * 4);
    assert_memory_equal(shown_bytes, expected, sizeof expected);
    for (int k = 0; k < WIDTH * HEIGHT * 4; k++)
        sum += k % 4 == 3 ? 0 : abs(shown_bytes[k] - other[k]);
    sim_camera_destroy(board.camera);
    return sum / (WIDTH * HEIGHT * 3);
}

/* The same time of the same video and the same poses, so that formats show the same but for what chroma loses. */
static void cameras_of_every_format_are_shown(void **state)
{
    (void)state;
    static uint8_t reference[WIDTH * HEIGHT * 4], shown[WIDTH * HEIGHT * 4];
    for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
        if (format == PICTURE_GRAY8)
            continue;
        char error[HAL_WORKERS_ERROR_LENGTH];
        hal_workers_t *workers;
        const hal_workers_settings_t two = {.count = 2, .first_core = HAL_WORKERS_ANY_CORE};
        assert_int_equal(hal_workers_open(&workers, &two, error), HAL_OK);
        room_bench_open(&bench, true);
        bench.tracking = true;
        const bool is_reference = format == PICTURE_XRGB8888, yuv = picture_is_yuv(format);
        const double difference = difference_to(reference, is_reference ? reference : shown, format, workers);
        if (!is_reference && difference > (yuv ? 8 : 0))
            fail_msg("%s: %f levels per byte from xrgb8888", camera_format_names[format], difference);
        room_bench_close(&bench);
        hal_workers_close(workers);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_of_every_format_are_shown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
