// SPDX-License-Identifier: Apache-2.0
// One axis of the least-squares spline: its pieces, its weights at every phase, and that its equations are rotations.
#include "warp_fixed/ls_axis.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/support/ls_oracle.h"
#include "tests/support/rng.h"

static const double one = 65536, q30 = 1073741824.0, q31 = 2147483648.0;

static ls_axis_t axis, other;
static ls_oracle_t oracle;

static int32_t k_q16(double k)
{
    return (int32_t)lround(k * one);
}

static const uint16_t *uniform(void)
{
    static uint16_t weight[LS_MAX_SIZE];
    for (int i = 0; i < LS_MAX_SIZE; i++)
        weight[i] = LS_WEIGHT_ONE;
    return weight;
}

static void pieces_follow_the_step(void **state)
{
    (void)state;
    static const struct {
        int32_t size;
        double k;
        int32_t intervals;
        bool interpolates;
    } cases[] = {
        {1920, 2, 960, false},     {1920, 1, 1917, true},
        {1920, 0.05, 1917, true},  {1920, 1 + 1 / 65536.0, 1536, false},
        {1920, 1.25, 1536, false}, {1920, 1.26, 1524, false},
        {100, 64, 2, false},       {100, 300, 1, false},
        {4096, 30000, 1, false},   {17, 1.1, 14, false},
        {16, 1.1, 13, false},      {15, 1.1, 12, false},
        {5, 1.1, 2, false},        {5, 2, 2, false},
        {5, 1, 2, true},           {4, 1, 1, true},
        {4, 1.1, 1, false},        {3, 1, 1, false},
        {2, 5, 1, false},          {1, 0.5, 1, false},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const ls_knots_t knots = ls_knots(cases[c].size, k_q16(cases[c].k));
        if (knots.intervals != cases[c].intervals || knots.interpolates != cases[c].interpolates)
            fail_msg("size %d, k %f: %d pieces, interpolates is %d", cases[c].size, cases[c].k, knots.intervals,
                     knots.interpolates);
        assert_int_equal(ls_coefficients(&knots), cases[c].intervals + 3);
    }
}

static double random_k(rng_t *rng)
{
    static const double ks[10] = {0.05, 1, 1.0001, 1.2, 1.25, 1.3, 2, 5, 16, 64};
    return rng_int(rng, 0, 1) == 0 ? ks[rng_int(rng, 0, 9)] : rng_double(rng, 0.5, 9);
}

static void check_taps(uint64_t seed, int32_t phase)
{
    const double x = (double)phase * axis.knots.size / axis.phases;
    const ls_taps_t taps = ls_axis_taps(&axis, (int32_t)lround(x * (1 << GRID_FRACTION_BITS)));
    double expected[4];
    const int first = ls_oracle_basis(&oracle, x, expected);
    int64_t sum = 0;
    for (int t = 0; t < 4; t++) {
        /* On a knot the fixed path may be one piece further on, with the same B-splines not zero. */
        const int u = taps.first + t - first;
        const double value = u >= 0 && u < 4 ? expected[u] : 0;
        sum += taps.weight[t];
        if (fabs(taps.weight[t] / q30 - value) > 4 / q30)
            fail_msg("seed %lu, size %d, %d pieces, x %f: weight %d is %.9f, expected %.9f", (unsigned long)seed,
                     axis.knots.size, axis.knots.intervals, x, t, taps.weight[t] / q30, value);
    }
    assert_int_equal(sum, 1 << LS_WEIGHT_BITS);
    assert_in_range(taps.first, 0, axis.coefficients - LS_TAPS);
}

static void weights_are_b_splines(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        rng_t rng = {seed};
        const int32_t size = (int32_t)rng_int(&rng, 1, seed % 2 == 0 ? 300 : 20);
        const int32_t k = k_q16(random_k(&rng));
        ls_axis_init(&axis);
        ls_axis_update(&axis, size, k, uniform());
        ls_oracle(&oracle, size, k / one, NULL);
        assert_int_equal(axis.coefficients, oracle.coefficients);
        for (int32_t phase = 0; phase <= axis.phases; phase += phase < 700 || phase > axis.phases - 700 ? 1 : 37)
            check_taps(seed, phase);
        const ls_taps_t begin = ls_axis_taps(&axis, 0), before = ls_axis_taps(&axis, INT32_MIN);
        const ls_taps_t end = ls_axis_taps(&axis, size << GRID_FRACTION_BITS), after = ls_axis_taps(&axis, INT32_MAX);
        assert_true(before.weight == begin.weight && before.first == begin.first);
        assert_true(after.weight == end.weight && after.first == end.first);
    }
}

/* The largest axis: every phase is reached, from its own pixels. */
static void points_round_to_phases(void **state)
{
    (void)state;
    ls_axis_init(&axis);
    ls_axis_update(&axis, LS_MAX_SIZE, 1 << 16, uniform());
    ls_oracle(&oracle, LS_MAX_SIZE, 1, NULL);
    check_taps(0, 3 * axis.phases / 4 + 1);
    ls_axis_update(&axis, LS_MAX_SIZE, LS_GUARD_Q16, uniform());
    ls_oracle(&oracle, LS_MAX_SIZE, 1.25, NULL);
    for (int32_t phase = 0; phase <= axis.phases; phase += 4111)
        check_taps(0, phase);
}

static void random_weights(uint16_t *weight, rng_t *rng)
{
    const int kind = (int)rng_int(rng, 0, 4);
    for (int i = 0; i < LS_MAX_SIZE; i++) {
        const bool heavy = kind == 1 ? rng_int(rng, 0, 1) == 0 : kind == 2 ? i % 64 == 0 : i % 64 != 0;
        weight[i] = kind == 0   ? LS_WEIGHT_ONE
                    : kind == 4 ? (uint16_t)rng_int(rng, 0, LS_WEIGHT_ONE)
                                : (uint16_t)(heavy ? LS_WEIGHT_ONE : rng_int(rng, 0, 2));
    }
}

/* What the proofs of ls_axis.c and ls_fit.c build on. */
static void equations_are_rotations(void **state)
{
    (void)state;
    static uint16_t weight[LS_MAX_SIZE];
    for (uint64_t seed = 1; seed <= 300; seed++) {
        rng_t rng = {seed};
        const int32_t size = (int32_t)rng_int(&rng, 1, seed % 9 == 0 ? LS_MAX_SIZE : 60);
        random_weights(weight, &rng);
        ls_axis_init(&axis);
        ls_axis_update(&axis, size, k_q16(random_k(&rng)), weight);
        assert_int_equal(axis.equations, size < 4 ? 4 : size);
        const double h = axis.knots.interpolates ? 1 : (double)size / axis.knots.intervals;
        for (int32_t i = 0; i < axis.equations; i++) {
            const ls_equation_t *equation = &axis.equation[i];
            assert_in_range(equation->first, 0, axis.coefficients - LS_TAPS);
            const double scale = i < size ? sqrt(fmax(weight[i], LS_WEIGHT_MIN) / LS_WEIGHT_ONE / h) : 0;
            assert_true(fabs(equation->scale_q31 / q31 - scale) < 1e-6);
            for (int t = 0; t < LS_TAPS; t++)
                if (fabs(hypot(equation->cos_q31[t], equation->sin_q31[t]) / q31 - 1) > 3e-9)
                    fail_msg("seed %lu, equation %d: no rotation", (unsigned long)seed, i);
        }
        for (int32_t j = 0; j < axis.coefficients; j++) {
            const ls_solution_t *solution = &axis.solution[j];
            assert_in_range(solution->shift, 1, 29);
            assert_true(solution->own > 0 && solution->own < 1 << 29);
            for (int t = 0; t < LS_TAPS - 1; t++)
                assert_true(solution->next[t] > -(1 << 29) && solution->next[t] < 1 << 29);
        }
    }
}

/* How large coefficients become over the data, without weights: the numbers from which ls_fit.c proves its range. */
static void growth_is_bounded(void **state)
{
    (void)state;
    static const struct {
        double k;
        int most;
    } bounds[] = {{1, 13}, {1.25, 2600}, {1.5, 82}, {2, 19}};
    enum { LARGEST = 24 }; /* larger axes have less of it */
    static double data[LARGEST];
    for (size_t b = 0; b < sizeof bounds / sizeof *bounds; b++) {
        double largest = 0;
        for (int size = 1; size <= LARGEST; size++) {
            ls_oracle(&oracle, size, bounds[b].k, NULL);
            for (int j = 0; j < oracle.coefficients; j++)
                largest = fmax(largest, ls_oracle_worst(&oracle, j, data));
        }
        if (largest > bounds[b].most || largest < bounds[b].most * 0.9)
            fail_msg("k %f: coefficients reach %f, expected just below %d", bounds[b].k, largest, bounds[b].most);
    }
}

/* A kept axis answers as a fresh one; only a change of size or pieces solves it anew. */
static void axes_are_kept(void **state)
{
    (void)state;
    ls_axis_init(&axis);
    ls_axis_init(&other);
    static const double ks[6] = {2.5, 1, 1.1, 17, 2.5, 2.4999};
    for (int n = 0; n < 6; n++)
        ls_axis_update(&axis, 200, k_q16(ks[n]), uniform());
    ls_axis_update(&other, 200, k_q16(2.5), uniform());
    assert_memory_equal(axis.equation, other.equation, sizeof(ls_equation_t) * 200);
    assert_memory_equal(axis.solution, other.solution, sizeof(ls_solution_t) * (size_t)other.coefficients);
    for (int end = 0; end < 2; end++)
        assert_memory_equal(axis.weight[end], other.weight[end],
                            sizeof(int32_t) * LS_TAPS * (size_t)(other.edge_phases + PHASES));

    axis.equation[3].scale_q31 = 1; /* shows whether it is made anew */
    ls_axis_update(&axis, 200, k_q16(2.5001), uniform());
    assert_int_equal(axis.equation[3].scale_q31, 1);
    ls_axis_update(&axis, 201, k_q16(2.5001), uniform());
    assert_int_not_equal(axis.equation[3].scale_q31, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_follow_the_step), cmocka_unit_test(weights_are_b_splines),
        cmocka_unit_test(points_round_to_phases), cmocka_unit_test(equations_are_rotations),
        cmocka_unit_test(growth_is_bounded),      cmocka_unit_test(axes_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
