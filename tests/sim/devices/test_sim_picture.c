// SPDX-License-Identifier: Apache-2.0
// Pictures of every format: bytes in their places, names, colours that come back.
#include "sim/devices/sim_picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 4, HEIGHT = 2, TALL = 4 };

static uint8_t xrgb[WIDTH * TALL * 4], bytes[WIDTH * TALL * 4];

static picture_t converted(picture_format_t format, int32_t stride)
{
    const image_t from = {xrgb, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t to = {.format = format,
                          .width = WIDTH,
                          .height = HEIGHT,
                          .data = {bytes, bytes + WIDTH * HEIGHT},
                          .stride = {stride, WIDTH}};
    memset(bytes, 0xa5, sizeof bytes);
    sim_picture_from_xrgb(&to, &from);
    return to;
}

/* Two red, two white pixels above two red, two black ones. */
static void paint(void)
{
    for (int k = 0; k < WIDTH * HEIGHT; k++) {
        const uint8_t white = k == 2 || k == 3 ? 255 : 0, red = k % WIDTH < 2 ? 255 : white;
        const uint8_t pixel[4] = {white, white, red, 0};
        memcpy(xrgb + 4 * k, pixel, 4);
    }
}

static void bytes_are_in_their_places(void **state)
{
    (void)state;
    paint();
    (void)converted(PICTURE_RGB888, 3 * WIDTH);
    assert_memory_equal(bytes, ((const uint8_t[]){0, 0, 255, 0, 0, 255, 255, 255, 255}), 9);
    (void)converted(PICTURE_BGR888, 3 * WIDTH);
    assert_memory_equal(bytes, ((const uint8_t[]){255, 0, 0, 255, 0, 0, 255, 255, 255}), 9);
    (void)converted(PICTURE_YUYV, 2 * WIDTH); /* BT.709 red is 63, 102, 240 */
    assert_memory_equal(bytes, ((const uint8_t[]){63, 102, 63, 240, 235, 128, 235, 128}), 8);
    (void)converted(PICTURE_UYVY, 2 * WIDTH);
    assert_memory_equal(bytes, ((const uint8_t[]){102, 63, 240, 63, 128, 235, 128, 235}), 8);
    (void)converted(PICTURE_NV12, WIDTH);
    assert_memory_equal(bytes, ((const uint8_t[]){63, 63, 235, 235, 63, 63, 16, 16, 102, 240, 128, 128}), 12);
    assert_int_equal(bytes[12], 0xa5);
}

static void colours_come_back(void **state)
{
    (void)state;
    uint8_t back[WIDTH * TALL * 4];
    const image_t to = {back, WIDTH, TALL, WIDTH * 4, IMAGE_XRGB8888};
    const image_t from = {xrgb, WIDTH, TALL, WIDTH * 4, IMAGE_XRGB8888};
    for (int n = 0; n < 64; n++) {
        for (int k = 0; k < WIDTH * TALL; k++) {
            const int colour = (k % WIDTH < 2) == (k / WIDTH < 2) ? n : 63 - n;
            const uint8_t pixel[4] = {(uint8_t)(colour % 4 * 85), (uint8_t)(colour / 4 % 4 * 85),
                                      (uint8_t)(colour / 16 * 85), 0};
            memcpy(xrgb + 4 * k, pixel, 4);
        }
        for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
            if (format == PICTURE_GRAY8)
                continue;
            picture_t picture = sim_picture(format, WIDTH, TALL, bytes);
            picture.matrix = n % 2 ? PICTURE_BT709 : PICTURE_BT601;
            sim_picture_from_xrgb(&picture, &from);
            memset(back, 0xa5, sizeof back);
            sim_picture_to_xrgb(&to, &picture);
            for (int i = 0; i < WIDTH * TALL * 4; i++)
                if (abs(back[i] - xrgb[i]) > (picture_is_yuv(format) ? 2 : 0))
                    fail_msg("%s, colours %d: byte %d is %d, expected %d", sim_picture_formats[format], n, i, back[i],
                             xrgb[i]);
        }
    }
}

static void names_are_found(void **state)
{
    (void)state;
    picture_format_t format = PICTURE_FORMATS;
    assert_true(sim_picture_format_from_name(&format, "nv12:file", 4));
    assert_int_equal(format, PICTURE_NV12);
    assert_true(sim_picture_format_from_name(&format, "xrgb8888", 8));
    assert_int_equal(format, PICTURE_XRGB8888);
    assert_false(sim_picture_format_from_name(&format, "gray8", 5));
    assert_false(sim_picture_format_from_name(&format, "nv1", 3));
    assert_false(sim_picture_format_from_name(&format, "nv123", 5));
    assert_false(sim_picture_format_from_name(&format, "", 0));
    assert_int_equal(format, PICTURE_XRGB8888);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_are_in_their_places),
        cmocka_unit_test(colours_come_back),
        cmocka_unit_test(names_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
