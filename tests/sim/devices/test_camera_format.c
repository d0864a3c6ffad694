// SPDX-License-Identifier: Apache-2.0
// What a camera of another format makes of a picture: bytes in their places, colours that come back.
#include "sim/devices/camera_format.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

enum { WIDTH = 4, HEIGHT = 2 };

static uint8_t xrgb[WIDTH * HEIGHT * 4], bytes[WIDTH * HEIGHT * 4];

static picture_t converted(picture_format_t format, int32_t stride)
{
    const image_t from = {xrgb, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t to = {.format = format,
                          .width = WIDTH,
                          .height = HEIGHT,
                          .data = {bytes, bytes + WIDTH * HEIGHT},
                          .stride = {stride, WIDTH}};
    memset(bytes, 0xa5, sizeof bytes);
    camera_format_convert(&to, &from);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_are_in_their_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
