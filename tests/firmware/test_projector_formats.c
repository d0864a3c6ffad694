// SPDX-License-Identifier: Apache-2.0
// Cameras and displays of every format, and workers: what the wall shows is the frame that the held picture and its
// pose make.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/safe_picture.h"
#include "firmware/warp_steps.h"
#include "sim/devices/sim_picture.h"
#include "tests/firmware/projector_bench.h"

enum { WIDTH = 96, HEIGHT = 54, STEPS = 90 };

static projector_t board_zero;
static warp_t warp;

/* The frame that the projector must have made last, in that format, as XRGB8888. */
static void make_expected(uint8_t *bytes, picture_format_t format)
{
    static uint8_t panel_bytes[WIDTH * HEIGHT * 4];
    const image_t image = {bytes, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = sim_picture(format, WIDTH, HEIGHT, panel_bytes);
    homography_t homography;
    warp_init(&warp, *bench.room.board[0].method, bench.room.board[0].step_all, bench.room.board[0].border);
    assert_true(
        homography_from_pose(&homography, &bench.room.camera, &bench.room.board[0].wall, &board_zero.report.pose));
    assert_true(
        warp_plan(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &board_zero.choice.now.frame.picture));
    warp_steps_run(&warp, NULL);
    sim_picture_to_xrgb(&image, &panel);
}

/* What a camera delivers, what a display takes besides XRGB8888, and what its panel must get then. */
typedef struct {
    picture_format_t camera, display, panel;
} formats_t;

/* Board 0 with a camera and a display of its own. */
static void open_board(hal_board_t *board, const formats_t *formats, hal_workers_t *workers)
{
    char error[FILE_ERROR_LENGTH] = "";
    const sim_camera_settings_t camera = {
        .video = bench.video, .width = WIDTH, .height = HEIGHT, .format = formats->camera, .rate = {0, 30, 1}};
    *board = *devices();
    const sim_display_settings_t display = {.width = WIDTH,
                                            .height = HEIGHT,
                                            .format = formats->display,
                                            .clock = board->clock,
                                            .blanks = {1000000 / (2 * ROOM_BENCH_HZ), ROOM_BENCH_HZ, 1}};
    board->camera = sim_camera_create(&camera, error);
    board->display = sim_display_create(&display, error);
    board->workers = workers;
    assert_string_equal(error, "");
}

/* The wall after some time of the same video and the same poses. */
static void run_board(uint8_t *shown_bytes, const formats_t *formats, hal_workers_t *workers)
{
    static uint8_t expected[WIDTH * HEIGHT * 4];
    char error[FILE_ERROR_LENGTH] = "";
    hal_board_t board;
    room_bench_open(&bench, true);
    bench.tracking = true;
    open_board(&board, formats, workers);
    projector_init(&board_zero, &bench.room, &bench.room.board[0], &board, &warp_kernels_scalar);
    for (int i = 0; i < STEPS; i++) {
        room_bench_advance(&bench);
        assert_true(sim_camera_advance(board.camera, room_bench_now_us(&bench), error));
        projector_step(&board_zero);
        bench.step++;
    }
    assert_int_equal(board_zero.report.state, CAN_BOARD_RUNNING);
    assert_true(board_zero.report.corrected);
    assert_int_equal(board_zero.choice.now.frame.picture.format, formats->camera);
    sim_display_advance(board.display, room_bench_now_us(&bench));
    assert_int_equal(sim_display_scanned(board.display)->format, formats->panel);
    const image_t *shown = sim_display_shown(board.display);
    make_expected(expected, formats->panel);
    for (int32_t y = 0; y < HEIGHT; y++)
        memcpy(shown_bytes + (ptrdiff_t)y * WIDTH * 4, image_row(shown, y), (size_t)WIDTH * 4);
    assert_memory_equal(shown_bytes, expected, sizeof expected);
    sim_camera_destroy(board.camera);
    sim_display_destroy(board.display);
    room_bench_close(&bench);
}

/* In levels per byte. */
static double difference_of(const uint8_t *a, const uint8_t *b)
{
    double sum = 0;
    for (int k = 0; k < WIDTH * HEIGHT * 4; k++)
        sum += k % 4 == 3 ? 0 : abs(a[k] - b[k]);
    return sum / (WIDTH * HEIGHT * 3);
}

/* All show the same but for what chroma loses. */
static void cameras_and_displays_of_every_format(void **state)
{
    (void)state;
    static const formats_t cases[] = {
        {PICTURE_XRGB8888, PICTURE_XRGB8888, PICTURE_XRGB8888},
        {PICTURE_RGB888, PICTURE_XRGB8888, PICTURE_XRGB8888},
        {PICTURE_BGR888, PICTURE_NV12, PICTURE_XRGB8888},
        {PICTURE_YUYV, PICTURE_XRGB8888, PICTURE_XRGB8888},
        {PICTURE_UYVY, PICTURE_XRGB8888, PICTURE_XRGB8888},
        {PICTURE_NV12, PICTURE_XRGB8888, PICTURE_XRGB8888},
        {PICTURE_XRGB8888, PICTURE_YUYV, PICTURE_XRGB8888},
        {PICTURE_YUYV, PICTURE_YUYV, PICTURE_YUYV},
        {PICTURE_YUYV, PICTURE_NV12, PICTURE_NV12},
        {PICTURE_UYVY, PICTURE_YUYV, PICTURE_YUYV},
        {PICTURE_UYVY, PICTURE_NV12, PICTURE_NV12},
        {PICTURE_NV12, PICTURE_YUYV, PICTURE_YUYV},
        {PICTURE_NV12, PICTURE_NV12, PICTURE_NV12},
    };
    static uint8_t reference[WIDTH * HEIGHT * 4], shown[WIDTH * HEIGHT * 4];
    char error[HAL_WORKERS_ERROR_LENGTH];
    hal_workers_t *workers;
    const hal_workers_settings_t two = {.count = 2, .first_core = HAL_WORKERS_ANY_CORE};
    assert_int_equal(hal_workers_open(&workers, &two, error), HAL_OK);
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        run_board(n == 0 ? reference : shown, &cases[n], workers);
        const double difference = n == 0 ? 0 : difference_of(reference, shown);
        if (difference > (picture_is_yuv(cases[n].camera) ? 8 : 0))
            fail_msg("%s on %s: %f levels per byte from xrgb8888", sim_picture_formats[cases[n].camera],
                     sim_picture_formats[cases[n].display], difference);
    }
    hal_workers_close(workers);
}

/* The safe picture goes into the camera's format too; without any picture yet it is XRGB8888. */
static void the_safe_picture_in_every_format(void **state)
{
    (void)state;
    static uint8_t expected[WIDTH * HEIGHT * 4];
    const image_t image = {expected, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = picture_from_image(&image);
    const formats_t formats = {PICTURE_NV12, PICTURE_NV12, PICTURE_NV12};
    char error[FILE_ERROR_LENGTH] = "";
    hal_board_t board;
    room_bench_open(&bench, true); /* and nobody sends poses */
    open_board(&board, &formats, NULL);
    projector_init(&board_zero, &bench.room, &bench.room.board[0], &board, &warp_kernels_scalar);
    safe_picture_draw(&panel, &(safe_picture_t){bench.room.board[0].name, bench.room.board[0].node, "no pose yet"});
    for (int i = 0; i < 4; i++) {
        room_bench_advance(&bench);
        if (i == 2)
            assert_true(sim_camera_advance(board.camera, room_bench_now_us(&bench), error));
        projector_step(&board_zero);
        bench.step++;
        sim_display_advance(board.display, room_bench_now_us(&bench));
        assert_int_equal(sim_display_scanned(board.display)->format, i < 2 ? PICTURE_XRGB8888 : PICTURE_NV12);
        const image_t *shown = sim_display_shown(board.display);
        for (int32_t k = 0; k < WIDTH * HEIGHT; k++)
            assert_in_range(shown->data[4 * k] + 1, expected[4 * k], expected[4 * k] + 2);
    }
    sim_camera_destroy(board.camera);
    sim_display_destroy(board.display);
    room_bench_close(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_and_displays_of_every_format),
        cmocka_unit_test(the_safe_picture_in_every_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
