// SPDX-License-Identifier: Apache-2.0
// Tests of a frame's plan: which pictures count as turned.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "warp_fixed/warp.h"

enum { WIDTH = 128, HEIGHT = 96 };

static warp_t warp;

/* Indices of panel to those of the picture: turned about its middle. */
static homography_t turned(double degrees)
{
    const double one = 1099511627776.0, angle = degrees * M_PI / 180.0, c = cos(angle), s = sin(angle);
    const double x = (WIDTH - 1) / 2.0, y = (HEIGHT - 1) / 2.0;
    const int64_t rows[3][3] = {
        {llround(c * one), llround(-s * one), llround((x - c * x + s * y) * one)},
        {llround(s * one), llround(c * one), llround((y - s * x - c * y) * one)},
        {0, 0, llround(one)},
    };
    const int32_t size[2] = {WIDTH, HEIGHT};
    homography_t homography;
    homography_from_indices(&homography, rows, size, size);
    return homography;
}

static void test_pictures_are_turned_from_30_degrees_on(void **state)
{
    (void)state;
    static uint8_t memory[2][WIDTH * HEIGHT * 4];
    const uint8_t border[3] = {0};
    picture_t picture[2];
    for (int i = 0; i < 2; i++)
        picture[i] = (picture_t){
            .format = PICTURE_XRGB8888, .width = WIDTH, .height = HEIGHT, .data = {memory[i]}, .stride = {WIDTH * 4}};
    warp_init(&warp, *warp_method_from_name("none+linear"), false, border);
    for (int degrees = -360; degrees <= 360; degrees++) {
        const homography_t homography = turned(degrees);
        assert_true(warp_plan(&warp, &warp_kernels_scalar, NULL, &homography, &picture[0], &picture[1]));
        const bool expected = fabs(sin(degrees * M_PI / 180.0)) > 0.5 - 1e-9;
        if (warp.plane[0].is_turned != expected && abs(degrees) % 30 != 0) /* 30 itself may be either */
            fail_msg("%d degrees: turned is %d", degrees, warp.plane[0].is_turned);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pictures_are_turned_from_30_degrees_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
