// SPDX-License-Identifier: Apache-2.0
// Pictures that no frame can be made of or into: refused, and nothing written.
#include "warp_fixed/picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/homography_of.h"
#include "warp_fixed/warp.h"

enum { MAX_BYTES = 2 * 160 * 41 };

static warp_t warp;

static void wrong_pictures_are_refused(void **state)
{
    (void)state;
    static const struct {
        picture_format_t from, to;
        int32_t size[4];
    } wrong[] = {
        {PICTURE_NV12, PICTURE_GRAY8, {40, 40, 40, 40}},       {PICTURE_GRAY8, PICTURE_NV12, {40, 40, 40, 40}},
        {PICTURE_XRGB8888, PICTURE_NV12, {40, 40, 40, 40}},    {PICTURE_XRGB8888, PICTURE_RGB888, {40, 40, 40, 40}},
        {PICTURE_YUYV, PICTURE_UYVY, {40, 40, 40, 40}},        {PICTURE_RGB888, PICTURE_GRAY8, {40, 40, 40, 40}},
        {PICTURE_NV12, PICTURE_NV12, {41, 40, 40, 40}},        {PICTURE_NV12, PICTURE_NV12, {40, 41, 40, 40}},
        {PICTURE_NV12, PICTURE_NV12, {40, 40, 40, 41}},        {PICTURE_YUYV, PICTURE_YUYV, {40, 40, 41, 40}},
        {PICTURE_NV12, PICTURE_XRGB8888, {40, 40, 41, 40}},    {PICTURE_NV12, PICTURE_XRGB8888, {40, 40, 40, 41}},
        {PICTURE_FORMATS, PICTURE_XRGB8888, {40, 40, 40, 40}},
    };
    static uint8_t bytes[2][MAX_BYTES];
    const double rows[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    warp_init(&warp, *warp_method_default(), false, (const uint8_t[3]){1, 2, 3});
    for (size_t n = 0; n < sizeof wrong / sizeof *wrong + 4; n++) {
        picture_t pictures[2];
        const bool by_size = n < sizeof wrong / sizeof *wrong;
        const int32_t even[4] = {40, 40, 40, 40}, *size = by_size ? wrong[n].size : even;
        memset(bytes, 0xa5, sizeof bytes);
        for (int i = 0; i < 2; i++)
            pictures[i] = (picture_t){.format = by_size ? (i == 0 ? wrong[n].from : wrong[n].to) : PICTURE_NV12,
                                      .width = size[2 * i],
                                      .height = size[2 * i + 1],
                                      .data = {bytes[i], bytes[i] + MAX_BYTES / 2},
                                      .stride = {160, 160}};
        if (!by_size)
            pictures[n % 2].stride[(n / 2) % 2] = 39;
        const homography_t h = homography_of(rows, (homography_sizes_t){size[2], size[3], size[0], size[1]});
        assert_false(warp_plan(&warp, warp_kernels_best(), NULL, &h, &pictures[1], &pictures[0]));
        for (int i = 0; i < MAX_BYTES; i++)
            assert_int_equal(bytes[1][i], 0xa5);
    }
}

static void right_pictures_are_taken(void **state)
{
    (void)state;
    for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
        picture_t picture = {.format = format, .width = 40, .height = 40, .stride = {160, 40}};
        assert_true(picture_is_valid(&picture));
        picture.width = IMAGE_MAX_WIDTH + 2;
        picture.stride[0] = picture.stride[1] = 4 * picture.width;
        assert_false(picture_is_valid(&picture));
        picture.width = 40;
        picture.height = IMAGE_MAX_HEIGHT + 2;
        assert_false(picture_is_valid(&picture));
        picture.height = 0;
        assert_false(picture_is_valid(&picture));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_pictures_are_refused),
        cmocka_unit_test(right_pictures_are_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
