// SPDX-License-Identifier: Apache-2.0
// The step of chroma along each axis: exact cases, any homography against doubles, and what it is for.
#include "warp_fixed/chroma_step.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/footprint_from_homography.h"

enum { SIZE = 64, K_Q16 = 5 << 15 };

static const chroma_log2_t two_by_one = {1, 0}, two_by_two = {1, 1};

static void check(const double rows[9], chroma_log2_t panel, chroma_log2_t picture, const int32_t expected_q16[2])
{
    const homography_t h = homography_of(rows, (homography_sizes_t){SIZE, SIZE, SIZE, SIZE});
    const chroma_step_t step = chroma_step(&h, K_Q16, (const int32_t[2]){20, 30}, panel, picture);
    assert_int_equal(step.x_q16, expected_q16[0]);
    assert_int_equal(step.y_q16, expected_q16[1]);
}

static void turns_and_kinds(void **state)
{
    (void)state;
    static const double scaled[9] = {2.5, 0, -48, 0, 1.5, -30, 0, 0, 1},
                        turned[9] = {0, -2.5, 112, 2.5, 0, -48, 0, 0, 1};
    check(scaled, two_by_one, two_by_one, (const int32_t[2]){K_Q16, K_Q16});
    check(scaled, two_by_two, two_by_two, (const int32_t[2]){K_Q16, K_Q16});
    check(scaled, two_by_two, two_by_one, (const int32_t[2]){K_Q16, 2 * K_Q16});
    check(scaled, two_by_one, two_by_two, (const int32_t[2]){K_Q16, K_Q16 / 2});
    check(turned, two_by_one, two_by_one, (const int32_t[2]){K_Q16 / 2, 2 * K_Q16});
    check(turned, two_by_two, two_by_two, (const int32_t[2]){K_Q16, K_Q16});
    check(turned, two_by_two, two_by_one, (const int32_t[2]){K_Q16, 2 * K_Q16});
    check(turned, two_by_one, two_by_two, (const int32_t[2]){K_Q16 / 2, K_Q16});
}

/* The side along an axis of a footprint of pixels of these sizes, times the depth squared. */
static double side(const double rows[9], const double at[2], int axis, const double size[2])
{
    const double depth = rows[6] * at[0] + rows[7] * at[1] + rows[8];
    const double value = rows[3 * axis] * at[0] + rows[3 * axis + 1] * at[1] + rows[3 * axis + 2];
    return hypot(size[0] * (rows[3 * axis] * depth - rows[6] * value),
                 size[1] * (rows[3 * axis + 1] * depth - rows[7] * value));
}

static void any_homography(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        rng_t rng = {seed};
        double rows[9];
        for (int i = 0; i < 9; i++)
            rows[i] = rng_double(&rng, -1, 1) * (i % 3 == 2 ? 50 : 1) * (i >= 6 ? 0.02 : 1);
        rows[8] += 1.5;
        const int32_t pixel[2] = {(int32_t)rng_int(&rng, 0, SIZE - 1), (int32_t)rng_int(&rng, 0, SIZE - 1)};
        const int32_t k_q16 = (int32_t)rng_int(&rng, 1, 8 << 16);
        const chroma_log2_t panel = {1, (int)rng_int(&rng, 0, 1)}, picture = {1, (int)rng_int(&rng, 0, 1)};
        const homography_t h = homography_of(rows, (homography_sizes_t){SIZE, SIZE, SIZE, SIZE});
        const chroma_step_t step = chroma_step(&h, k_q16, pixel, panel, picture);
        const double at[2] = {pixel[0] + 0.5, pixel[1] + 0.5};
        const double whole[2] = {1, 1}, chroma[2] = {2, 1 << panel.y};
        const double x = k_q16 * side(rows, at, 0, chroma) / side(rows, at, 0, whole) / 2;
        const double y = k_q16 * side(rows, at, 1, chroma) / side(rows, at, 1, whole) / (1 << picture.y);
        if (fabs(step.x_q16 - x) > 1.01 || fabs(step.y_q16 - y) > 1.01)
            fail_msg("seed %d: steps %d and %d, expected %f and %f", (int)seed, step.x_q16, step.y_q16, x, y);
    }
}

/* The pixel and one of its two neighbours are k apart. */
static void the_pixel_of_a_step(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 500; seed++) {
        rng_t rng = {seed};
        double rows[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        for (int i = 0; i < 8; i++)
            rows[i] += rng_double(&rng, -1, 1) * (i >= 6 ? 0.01 : i % 3 == 2 ? 20 : 0.8);
        const homography_t h = homography_of(rows, (homography_sizes_t){SIZE, SIZE, SIZE, SIZE});
        const footprint_step_t step = footprint_step(&h);
        double nearest = 0;
        for (int way = 0; way < 2 && step.in_q16 > 0; way++) {
            double point[2][2];
            for (int end = 0; end < 2; end++) {
                const double u = step.pixel[0] + 0.5 + (way == 0 ? end : 0),
                             v = step.pixel[1] + 0.5 + (way == 1 ? end : 0);
                const double depth = rows[6] * u + rows[7] * v + rows[8];
                for (int a = 0; a < 2; a++)
                    point[end][a] = (rows[3 * a] * u + rows[3 * a + 1] * v + rows[3 * a + 2]) / depth;
            }
            const double distance = hypot(point[1][0] - point[0][0], point[1][1] - point[0][1]);
            if (fabs(distance * 65536 - step.in_q16) < fabs(nearest * 65536 - step.in_q16))
                nearest = distance;
        }
        if (fabs(nearest * 65536 - step.in_q16) > 2)
            fail_msg("seed %d: pixel (%d, %d) has %f, expected %f", (int)seed, step.pixel[0], step.pixel[1], nearest,
                     step.in_q16 / 65536.0);
    }
}

/* Chroma of 128 -+ 40 from row to row, turned by 90 degrees: a panel's pairs, two rows apart, must not show it. (The
 * Gaussian passes 0.42 of it.) */
static void turned_chroma_does_not_alias(void **state)
{
    (void)state;
    static const double rows[9] = {0, -1.0625, 66, 1.0625, 0, -2, 0, 0, 1};
    static const char *const methods[] = {"gauss+linear", "kaiser+nearest", "butter+cubic"};
    static warp_t warp;
    static uint8_t picture_bytes[SIZE * SIZE * 2], panel_bytes[SIZE * SIZE * 2];
    const uint8_t border[3] = {0, 0, 0};
    const homography_t h = homography_of(rows, (homography_sizes_t){SIZE, SIZE, SIZE, SIZE});
    const picture_t picture = {PICTURE_YUYV, PICTURE_BT709, SIZE, SIZE, {picture_bytes}, {2 * SIZE}};
    const picture_t panel = {PICTURE_YUYV, PICTURE_BT709, SIZE, SIZE, {panel_bytes}, {2 * SIZE}};
    for (int i = 0; i < SIZE * SIZE * 2; i++)
        picture_bytes[i] = i % 2 == 0 ? 100 : (uint8_t)(i / (2 * SIZE) % 2 ? 168 : 88);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        warp_init(&warp, *warp_method_from_name(methods[m]), false, border);
        assert_true(warp_plan(&warp, warp_kernels_best(), NULL, &h, &panel, &picture));
        warp_steps_run(&warp, NULL);
        for (int j = 8; j < SIZE - 8; j++)
            for (int i = 8; i < 2 * SIZE - 16; i++)
                if (i % 2 == 1 && abs(panel_bytes[2 * SIZE * j + i] - 128) > 20)
                    fail_msg("%s: chroma byte %d of row %d is %d, expected about 128", methods[m], i, j,
                             panel_bytes[2 * SIZE * j + i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_and_kinds),
        cmocka_unit_test(any_homography),
        cmocka_unit_test(the_pixel_of_a_step),
        cmocka_unit_test(turned_chroma_does_not_alias),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
