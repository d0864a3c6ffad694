// SPDX-License-Identifier: Apache-2.0
// Y, U, V to B, G, R against the formula in double, for every triple of a grid; and the border's way back.
#include "warp_fixed/color.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "warp_fixed/kernels.h"

static void exact(double bgr[3], const uint8_t yuv[3], picture_matrix_t matrix)
{
    const double kr = matrix == PICTURE_BT601 ? 0.299 : 0.2126, kb = matrix == PICTURE_BT601 ? 0.114 : 0.0722;
    const double kg = 1 - kr - kb, luma = (yuv[0] - 16) * 255.0 / 219;
    const double u = (yuv[1] - 128) * 255.0 / 224, v = (yuv[2] - 128) * 255.0 / 224;
    bgr[0] = luma + 2 * (1 - kb) * u;
    bgr[1] = luma - 2 * (1 - kb) * kb / kg * u - 2 * (1 - kr) * kr / kg * v;
    bgr[2] = luma + 2 * (1 - kr) * v;
}

static void colours_are_those_of_the_formula(void **state)
{
    (void)state;
    double worst = 0;
    for (picture_matrix_t m = PICTURE_BT709; m <= PICTURE_BT601; m++) {
        const color_matrix_t matrix = color_matrix(m);
        for (int n = 0; n < 52 * 52 * 52; n++) {
            const uint8_t yuv[3] = {(uint8_t)(n % 52 * 5), (uint8_t)(n / 52 % 52 * 5), (uint8_t)(n / 52 / 52 * 5)};
            const uint8_t luma[2] = {yuv[0], yuv[0]};
            uint8_t xrgb[8];
            double bgr[3];
            exact(bgr, yuv, m);
            warp_kernels_scalar.xrgb_from_yuv(xrgb, luma, yuv + 1, &matrix, 1);
            for (int c = 0; c < 3; c++) {
                const double off = fabs(xrgb[c] - fmin(255, fmax(0, bgr[c])));
                worst = off > worst ? off : worst;
                assert_int_equal(xrgb[c], xrgb[4 + c]);
            }
            assert_int_equal(xrgb[3], 0);
        }
    }
    assert_true(worst < 0.53); /* 0.5 of the last rounding, and the weights' */
}

static void colours_come_back(void **state)
{
    (void)state;
    for (picture_matrix_t m = PICTURE_BT709; m <= PICTURE_BT601; m++) {
        const color_matrix_t matrix = color_matrix(m);
        for (int n = 0; n < 16 * 16 * 16; n++) {
            const uint8_t bgr[3] = {(uint8_t)(n % 16 * 17), (uint8_t)(n / 16 % 16 * 17), (uint8_t)(n / 256 * 17)};
            uint8_t yuv[3], xrgb[8];
            color_yuv_from_bgr(yuv, bgr, m);
            const uint8_t luma[2] = {yuv[0], yuv[0]};
            warp_kernels_scalar.xrgb_from_yuv(xrgb, luma, yuv + 1, &matrix, 1);
            for (int c = 0; c < 3; c++)
                assert_true(abs(xrgb[c] - bgr[c]) <= 2);
            assert_in_range(yuv[0], 16, 235);
            if (bgr[0] == bgr[1] && bgr[1] == bgr[2])
                assert_true(yuv[1] == 128 && yuv[2] == 128);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_are_those_of_the_formula),
        cmocka_unit_test(colours_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
