// SPDX-License-Identifier: Apache-2.0
// The code is never seen: what is below it is warped as it would be without it, and the code changes no byte of it.
#include "firmware/frame_tag.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "sim/devices/sim_picture.h"
#include "sim/files/png_file.h"
#include "tests/support/tagged.h"

enum { WIDTH = 480, HEIGHT = 270, BYTES = WIDTH * HEIGHT * 4, BORDER = 200, FILTER_REACH = 12 };

/* The picture fills the wall of 4.8 x 2.7 m exactly, a panel pixel for each of its pixels. */
static const camera_t CAMERA = {
    .width = WIDTH, .height = HEIGHT, .focal_upx = {480000000, 480000000}, .principal_upx = {240000000, 135000000}};
static const wall_corners_t CORNERS = {.panel_width = WIDTH,
                                       .panel_height = HEIGHT,
                                       .corner_um = {{-2400000, -1350000, 4800000},
                                                     {2400000, -1350000, 4800000},
                                                     {2400000, 1350000, 4800000},
                                                     {-2400000, 1350000, 4800000}},
                                       .corner_known = {true, true, true, true}};

static warp_t warp;
static image_t photo;
static frame_tag_layout_t layout;
static uint8_t tagged[BYTES], captured[BYTES], shown[2][BYTES];

static int set_up(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    if (!png_file_load("tests/images/studio_480x270.png", IMAGE_XRGB8888, &photo, error))
        fail_msg("%s", error);
    return !frame_tag_layout(&layout, WIDTH, HEIGHT);
}

static int tear_down(void **state)
{
    (void)state;
    free(photo.data);
    return 0;
}

/* As a cable or a camera may do: one pixel down, and a mean of 3 x 3. */
static void wear_out(const image_t *image)
{
    static uint8_t before[BYTES];
    memcpy(before, image->data, sizeof before);
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++)
            for (int c = 0; c < 4; c++) {
                int sum = 0;
                for (int k = 0; k < 9; k++) {
                    const int32_t from_y = y - 2 + k / 3, from_x = x - 1 + k % 3;
                    sum += before[(from_y < 0 ? 0 : from_y) * WIDTH * 4 +
                                  (from_x < 0        ? 0
                                   : from_x >= WIDTH ? WIDTH - 1
                                                     : from_x) *
                                      4 +
                                  c];
                }
                image_row(image, y)[4 * x + c] = (uint8_t)(sum / 9);
            }
}

static picture_t capture(picture_format_t format, const frame_tag_t *tag, bool worn)
{
    const image_t image = {tagged, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    memcpy(tagged, photo.data, BYTES);
    if (tag != NULL)
        tagged_paint(&image, tag);
    if (worn)
        wear_out(&image);
    const picture_t picture = sim_picture(format, WIDTH, HEIGHT, captured);
    sim_picture_from_xrgb(&picture, &image);
    return picture;
}

/* Warp what is below `rows_px` rows. */
static void show(uint8_t *to, const picture_t *captured_picture, int32_t rows_px, const pose_t *pose)
{
    const image_t image = {to, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = picture_from_image(&image), picture = frame_tag_picture_below(captured_picture, rows_px);
    const camera_t camera = frame_tag_camera_below(&CAMERA, rows_px);
    wall_t wall;
    homography_t homography;
    assert_int_equal(wall_from_corners(&wall, &CORNERS), WALL_OK);
    assert_true(homography_from_pose(&homography, &camera, &wall, pose));
    assert_true(warp_plan(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
    warp_steps_run(&warp, NULL);
}

static const pose_t STRAIGHT = {.quaternion_q30 = {1 << 30}};
static const pose_t ASKEW = {.eye_nm = {900000000, -300000000, 1500000000},
                             .quaternion_q30 = {1060000000, 40000000, -150000000, 60000000}};

static void no_byte_of_the_code_is_seen(void **state)
{
    (void)state;
    static const char *const methods[] = {"mean+cubic", "mean+spline", "area", "gauss+cubic", "none+linear", "ls"};
    const frame_tag_t ones = {UINT32_MAX, UINT32_MAX, 3}, zeros = {0, 0, 0};
    const uint8_t border[3] = {BORDER, BORDER, BORDER};
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
        warp_init(&warp, *warp_method_from_name(methods[m]), false, border);
        for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
            if (format == PICTURE_GRAY8)
                continue;
            const frame_tag_t *const tags[] = {&ones, &zeros};
            for (int t = 0; t < 2; t++) {
                const picture_t picture = capture(format, tags[t], true);
                frame_tag_t found;
                assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_OK);
                show(shown[t], &picture, layout.hidden_px, &ASKEW);
            }
            if (memcmp(shown[0], shown[1], BYTES) != 0)
                fail_msg("%s, %s", methods[m], sim_picture_formats[format]);
        }
    }
}

static void every_pixel_keeps_its_place(void **state)
{
    (void)state;
    const uint8_t border[3] = {BORDER, BORDER, BORDER};
    warp_init(&warp, *warp_method_from_name("mean+cubic"), false, border);
    for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
        if (format == PICTURE_GRAY8)
            continue;
        const picture_t picture = capture(format, NULL, false);
        show(shown[0], &picture, 0, &STRAIGHT);
        show(shown[1], &picture, layout.hidden_px, &STRAIGHT);
        for (int32_t n = 0; n < BYTES; n++) {
            const int32_t row = n / (WIDTH * 4);
            const int expected = row < layout.hidden_px ? BORDER : shown[0][n];
            const bool near_the_edge = row >= layout.hidden_px - 1 && row < layout.hidden_px + FILTER_REACH;
            /* Points of grids may lie 1/256 px apart. */
            if (n % 4 != 3 && !near_the_edge && abs(shown[1][n] - expected) > 1)
                fail_msg("%s, row %d, column %d: %d, not %d", sim_picture_formats[format], (int)row,
                         (int)(n / 4 % WIDTH), shown[1][n], expected);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_byte_of_the_code_is_seen),
        cmocka_unit_test(every_pixel_keeps_its_place),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
