// SPDX-License-Identifier: Apache-2.0
// The weights that linear interpolation computes in NEON are the table's, at every phase along both axes.
//
// Pixels show only the upper 8 of a sum's 30 bits. So for each phase there must be pictures whose pixel changes when a
// weight of the second pass is larger or smaller by 1; a weight of the first pass moves pixels by levels.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/rng.h"
#include "warp_fixed/kernels.h"

enum { STEP = 8, CASES = 20000, PHASE_SHIFT = GRID_FRACTION_BITS - PHASE_BITS };

static window_weights_t weights;

static int build_table(void **state)
{
    (void)state;
    window_weights_init(&weights, WARP_LINEAR, false);
    return 0;
}

/* The formulas at the head of resample_linear_neon.c. */
static void weights_follow_from_phases(void **state)
{
    (void)state;
    const window_axis_t axis = window_axis(&weights, 0);
    assert_int_equal(axis.taps, 2);
    for (int32_t p = 0; p < PHASES; p++) {
        const int32_t w = 256 * p - p / 64;
        assert_int_equal(axis.first[p * axis.row], 128 - p);
        assert_int_equal(axis.first[p * axis.row + 1], p);
        assert_int_equal(axis.second[p * axis.row], 32767 - w);
        assert_int_equal(axis.second[p * axis.row + 1], w);
    }
}

/* Four texels, and the level between them; with the second pass' right weight larger by `more`, its left one less. */
static int32_t level_between(const uint8_t texel[4], int32_t phase_x, int32_t phase_y, int32_t more)
{
    const window_axis_t axis = window_axis(&weights, 0);
    const int16_t *first = axis.first + phase_y * axis.row, *second = axis.second + phase_x * axis.row;
    const int32_t left = first[0] * texel[0] + first[1] * texel[2], right = first[0] * texel[1] + first[1] * texel[3];
    return ((second[0] - more) * left + (second[1] + more) * right + (1 << (SUM_SHIFT - 1))) >> SUM_SHIFT;
}

/* What the NEON loops make of it: the same in every one of a step's pixels, and in every channel. */
static void check_level(const uint8_t texel[4], int32_t phase_x, int32_t phase_y, int32_t expected)
{
    const int32_t half = 1 << (GRID_FRACTION_BITS - 1);
    int32_t x_q18[STEP], y_q18[STEP];
    for (int i = 0; i < STEP; i++) {
        x_q18[i] = half + (phase_x << PHASE_SHIFT);
        y_q18[i] = half + (phase_y << PHASE_SHIFT);
    }
    for (int channels = 1; channels <= 4; channels += 3) {
        uint8_t picture[4 * 4], out[4 * STEP];
        for (int i = 0; i < 4; i++)
            memset(picture + i * channels, texel[i], (size_t)channels);
        const bool gray = channels == 1;
        const patch_t patch = {out, 0, x_q18, y_q18, STEP, 1};
        const window_t window = {
            .x = window_axis(&weights, 0),
            .y = window_axis(&weights, 0),
            .picture = {picture, 2, 2, 2 * channels, gray ? IMAGE_GRAY8 : IMAGE_XRGB8888},
            .width = 2,
            .height = 2,
        };
        (gray ? warp_kernels_neon.window_gray : warp_kernels_neon.window_xrgb)(&patch, &window);
        for (int i = 0; i < STEP * channels; i++)
            if (out[i] != expected)
                fail_msg("phases %d and %d, texels %d %d %d %d, channels %d: %d at byte %d, expected %d", phase_x,
                         phase_y, texel[0], texel[1], texel[2], texel[3], channels, out[i], i, expected);
    }
}

static void every_phase_is_the_tables(void **state)
{
    (void)state;
    for (int32_t phase = 0; phase < PHASES; phase++) {
        rng_t rng = {(uint64_t)phase + 1};
        int32_t larger = 0, smaller = 0;
        for (int n = 0; n < CASES; n++) {
            uint8_t texel[4];
            for (int i = 0; i < 4; i++)
                texel[i] = rng_int(&rng, 0, 3) == 0 ? 0 : (uint8_t)rng_next(&rng);
            const int32_t phase_y = (int32_t)rng_int(&rng, 0, PHASES - 1);
            const int32_t expected = level_between(texel, phase, phase_y, 0);
            const bool tells_larger = level_between(texel, phase, phase_y, 1) != expected;
            const bool tells_smaller = level_between(texel, phase, phase_y, -1) != expected;
            larger += tells_larger;
            smaller += tells_smaller;
            if (tells_larger || tells_smaller)
                check_level(texel, phase, phase_y, expected);
        }
        assert_true(larger > 0 && smaller > 0);
        check_level((const uint8_t[4]){0, 0, 255, 255}, 0, phase,
                    level_between((const uint8_t[4]){0, 0, 255, 255}, 0, phase, 0));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_follow_from_phases),
        cmocka_unit_test(every_phase_is_the_tables),
    };
    return cmocka_run_group_tests(tests, build_table, NULL);
}
