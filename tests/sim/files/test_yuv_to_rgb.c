// SPDX-License-Identifier: Apache-2.0
// The conversion of Y'CbCr against the standards' formulas in floating point.
#include "sim/files/yuv_to_rgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static double exact_gain(double kr, double kb, int channel, const double centred[3])
{
    const double kg = 1 - kr - kb;
    const double red = 2 * (1 - kr) * centred[2], blue = 2 * (1 - kb) * centred[1];
    switch (channel) {
    case 0:
        return centred[0] + red;
    case 1:
        return centred[0] - blue * kb / kg - red * kr / kg;
    default:
        return centred[0] + blue;
    }
}

static void test_conversion_follows_the_standards(void **state)
{
    (void)state;
    for (int variant = 0; variant < 4; variant++) {
        const bool bt709 = variant & 1, full = variant & 2;
        const double kr = bt709 ? 0.2126 : 0.299, kb = bt709 ? 0.0722 : 0.114;
        const double luma = full ? 1 : 255.0 / 219, chroma = full ? 1 : 255.0 / 224;
        for (int i = 0; i < 52 * 52 * 52; i++) {
            const int y = i % 52 * 5, cb = i / 52 % 52 * 5, cr = i / 2704 * 5;
            const double centred[3] = {luma * (y - (full ? 0 : 16)), chroma * (cb - 128), chroma * (cr - 128)};
            const rgb_t rgb = rgb_from_yuv(yuv_matrix(bt709, full), (uint8_t)y, (uint8_t)cb, (uint8_t)cr);
            const int got[3] = {rgb.red, rgb.green, rgb.blue};
            for (int c = 0; c < 3; c++) {
                const double exact = fmin(fmax(exact_gain(kr, kb, c, centred), 0), 255);
                /* Half a step of rounding, and what the constants' 16 bits leave: 3 * 255 * 2^-17. */
                if (fabs(got[c] - exact) > 0.506)
                    fail_msg("variant %d, YCbCr %d %d %d, channel %d: %d, exactly %f", variant, y, cb, cr, c, got[c],
                             exact);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_conversion_follows_the_standards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
