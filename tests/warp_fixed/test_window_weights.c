// SPDX-License-Identifier: Apache-2.0
// The weights of the window loop: exact sums, the bytes that the loops in vector code read, and sides by footprint.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "tests/support/float_methods.h"
#include "tests/support/rng.h"
#include "warp_fixed/kernels_scalar.h"

static const struct {
    warp_resampler_t resampler;
    bool of_coefficients;
    int32_t sides;
} tables[] = {
    {WARP_LINEAR, false, 1},
    {WARP_LINEAR, true, 1},
    {WARP_CUBIC, false, 1},
    {WARP_CUBIC, true, 1},
    {WARP_SPLINE, true, 1},
    {WARP_AREA, false, WINDOW_SIDES},
    {WARP_MEAN_CUBIC, false, WINDOW_SIDES},
    {WARP_MEAN_SPLINE, true, WINDOW_SIDES},
};
enum { TABLES = sizeof tables / sizeof *tables };

static window_weights_t weights;

static void weights_sum_exactly_and_fit(void **state)
{
    (void)state;
    for (int r = 0; r < TABLES; r++) {
        const bool of_coefficients = tables[r].of_coefficients, positive = tables[r].resampler == WARP_AREA;
        int32_t first_sum = positive ? FIRST_SUM_POSITIVE : FIRST_SUM;
        int32_t second_sum = positive ? SECOND_SUM_POSITIVE : SECOND_SUM;
        if (of_coefficients) {
            first_sum = 1;
            second_sum = 1 << COEFFICIENT_SUM_LOG2;
        }
        window_weights_init(&weights, tables[r].resampler, of_coefficients);
        for (int32_t side = 0; side < tables[r].sides; side++) {
            const window_axis_t axis = window_axis(&weights, (uint16_t)side);
            assert_in_range(axis.taps, 1, WINDOW_MAX_TAPS);
            const uint32_t end = weights.at[side] + (uint32_t)axis.row * PHASES;
            assert_true(end + WINDOW_ROW_SLACK <= WINDOW_POOL);
            assert_true(axis.first_bytes == NULL || end <= sizeof weights.first_bytes);
            for (int32_t row = 0; row < PHASES; row++) {
                int32_t first = 0, second = 0;
                for (int32_t t = 0; t < axis.row; t++) {
                    const int32_t at = row * axis.row + t, w = axis.first[at];
                    const bool signs_known = weights.negative && axis.taps == CUBIC_TAPS;
                    if (axis.first_bytes != NULL && t < axis.taps)
                        assert_int_equal(axis.first_bytes[at], (uint8_t)(weights.negative ? -w : w));
                    if (axis.first_bytes != NULL && t < axis.taps && signs_known)
                        assert_int_equal(axis.first_bytes[at + CUBIC_TAPS], t % 3 == 0 ? -w : w);
                    if (t >= axis.taps)
                        assert_int_equal(axis.second[at], 0);
                    first += w;
                    second += axis.second[at];
                    if (axis.first_shift == 0) /* 8-bit: unsigned, or negated and signed */
                        assert_true(positive ? w >= 0 && w <= 255 : -w >= -128 && -w <= 127);
                    assert_true(w >= 0 || !(warp_splines(tables[r].resampler) || positive));
                }
                assert_int_equal(first, first_sum << axis.first_shift);
                assert_int_equal(second, second_sum);
            }
        }
    }
}

/* resample_pairs_neon.c reads it as the weight of the row before the window. */
static void zeros_are_before_weights_of_odd_numbers_of_taps(void **state)
{
    (void)state;
    int32_t sides = 0;
    window_weights_init(&weights, WARP_MEAN_CUBIC, false);
    for (uint16_t side = 0; side < WINDOW_SIDES; side++) {
        const window_axis_t axis = window_axis(&weights, side);
        if (axis.taps % 2 == 0 || axis.taps > WINDOW_SHORT_TAPS)
            continue;
        sides++;
        for (int row = 0; row < PHASES; row++)
            assert_int_equal(axis.first_bytes[row * WINDOW_SHORT_TAPS - 1], 0);
    }
    assert_true(sides > 60);
}

/* The side chosen for a footprint is the table's nearest; mean+cubic takes sqrt(w^2 - 1); large ones use levels. */
static void sides_follow_footprints(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20000; seed++) {
        rng_t rng = {seed};
        const double width = exp(rng_double(&rng, log(0.01), log(4000)));
        const int level = width > 512 ? 2 : width > 64 ? 1 : 0;
        const double reduced = width / (1 << 3 * level);
        const double cubic = reduced > 1 ? sqrt(reduced * reduced - 1) : 0;
        const window_side_t area = window_side(WARP_AREA, (uint32_t)lround(width * 65536));
        const window_side_t mean = window_side(WARP_MEAN_CUBIC, (uint32_t)lround(width * 65536));
        if (area.level != level || mean.level != level ||
            fabs(float_side(area.side) - reduced) > fmax(reduced, 0.5) / 60 ||
            fabs(float_side(mean.side) - cubic) > fmax(cubic, 0.5) / 60)
            fail_msg("seed %lu: width %f, level %d: sides %f and %f", (unsigned long)seed, width, area.level,
                     float_side(area.side), float_side(mean.side));
        const window_side_t mean_spline = window_side(WARP_MEAN_SPLINE, (uint32_t)lround(width * 65536));
        assert_int_equal(mean_spline.side, mean.side);
        assert_int_equal(mean_spline.level, mean.level);
        assert_int_equal(window_side(WARP_CUBIC, (uint32_t)lround(width * 65536)).side, 0);
        assert_int_equal(window_side(WARP_SPLINE, (uint32_t)lround(width * 65536)).side, 0);
    }
    assert_int_equal(window_side(WARP_AREA, UINT32_MAX).side, WINDOW_SIDES - 1);
    assert_int_equal(window_side(WARP_AREA, 0).side, 0);
    const window_side_t largest = window_side(WARP_AREA, WINDOW_MAX_SIDE << 16);
    assert_int_equal(largest.side, WINDOW_SIDES - 1);
    assert_int_equal(largest.level, 0);
    assert_int_equal(window_side(WARP_AREA, (WINDOW_MAX_SIDE << 16) + 1).level, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_sum_exactly_and_fit),
        cmocka_unit_test(zeros_are_before_weights_of_odd_numbers_of_taps),
        cmocka_unit_test(sides_follow_footprints),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
