// SPDX-License-Identifier: Apache-2.0
// Tests of the turns: known ones by hand, and the three ways of writing one against each other.
#include "sim/trackers/tracker_rotation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/rng.h"

static void expect_vector(const double found[3], double x, double y, double z)
{
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!(fabs(found[i] - expected[i]) <= 1e-9))
            fail_msg("found %.9f %.9f %.9f, expected %.9f %.9f %.9f", found[0], found[1], found[2], x, y, z);
}

static void expect_turned(const double quaternion[4], double x, double y, double z, const double expected[3])
{
    double turned[3];
    tracker_rotation_apply(turned, quaternion, (const double[3]){x, y, z});
    expect_vector(turned, expected[0], expected[1], expected[2]);
}

static void test_single_turns_follow_the_right_hand(void **state)
{
    (void)state;
    double turn[4];
    tracker_rotation_from_angles(turn, "xyz", (const double[3]){90.0, 0.0, 0.0});
    expect_turned(turn, 0.0, 1.0, 0.0, (const double[3]){0.0, 0.0, 1.0});
    tracker_rotation_from_angles(turn, "xyz", (const double[3]){0.0, 90.0, 0.0});
    expect_turned(turn, 0.0, 0.0, 1.0, (const double[3]){1.0, 0.0, 0.0});
    tracker_rotation_from_angles(turn, "xyz", (const double[3]){0.0, 0.0, 90.0});
    expect_turned(turn, 1.0, 0.0, 0.0, (const double[3]){0.0, 1.0, 0.0});
}

/* Rz(90) Rx(90): x goes to x and on to y; y goes to z and stays there; z goes to -y and on to x. */
static void test_turns_are_about_the_bodys_own_axes(void **state)
{
    (void)state;
    double turn[4];
    tracker_rotation_from_angles(turn, "zxy", (const double[3]){90.0, 90.0, 0.0});
    expect_turned(turn, 1.0, 0.0, 0.0, (const double[3]){0.0, 1.0, 0.0});
    expect_turned(turn, 0.0, 1.0, 0.0, (const double[3]){0.0, 0.0, 1.0});
    expect_turned(turn, 0.0, 0.0, 1.0, (const double[3]){1.0, 0.0, 0.0});
}

static void test_angles_may_be_many_turns(void **state)
{
    (void)state;
    double turn[4];
    tracker_rotation_from_angles(turn, "zxy", (const double[3]){90.0 + 360.0 * 1e9, 0.0, -720.0});
    expect_turned(turn, 1.0, 0.0, 0.0, (const double[3]){0.0, 1.0, 0.0});
}

static void test_rotation_vectors(void **state)
{
    (void)state;
    double turn[4];
    tracker_rotation_from_vector(turn, (const double[3]){0.0, M_PI / 2.0, 0.0});
    expect_turned(turn, 0.0, 0.0, 1.0, (const double[3]){1.0, 0.0, 0.0});
    const double third = 2.0 * M_PI / 3.0 / sqrt(3.0);
    tracker_rotation_from_vector(turn, (const double[3]){third, third, third});
    expect_turned(turn, 1.0, 0.0, 0.0, (const double[3]){0.0, 1.0, 0.0});
    tracker_rotation_from_vector(turn, (const double[3]){0.0, 0.0, 0.0});
    expect_turned(turn, 1.0, 2.0, 3.0, (const double[3]){1.0, 2.0, 3.0});
    tracker_rotation_from_vector(turn, (const double[3]){1e-12, 0.0, 0.0});
    expect_turned(turn, 1.0, 2.0, 3.0, (const double[3]){1.0, 2.0, 3.0});
}

/* Any turn, half turns among them, by its matrix again. */
static void test_a_matrix_gives_the_turn_that_made_it(void **state)
{
    (void)state;
    const uint64_t seed = 20261122;
    rng_t rng = {seed};
    for (int n = 0; n < 2000; n++) {
        double degrees[3], turn[4], column[3][3], again[4];
        for (int i = 0; i < 3; i++)
            degrees[i] = n % 2 == 0 ? 90.0 * (double)(rng_next(&rng) % 8) : 720.0 * rng_unit(&rng) - 360.0;
        tracker_rotation_from_angles(turn, "zxy", degrees);
        for (int i = 0; i < 3; i++) {
            double axis[3] = {0.0};
            axis[i] = 1.0;
            tracker_rotation_apply(column[i], turn, axis);
        }
        const double matrix[3][3] = {{column[0][0], column[1][0], column[2][0]},
                                     {column[0][1], column[1][1], column[2][1]},
                                     {column[0][2], column[1][2], column[2][2]}};
        assert_true(tracker_rotation_from_matrix(again, matrix));
        double product = 0.0;
        for (int i = 0; i < 4; i++)
            product += turn[i] * again[i];
        if (!(fabs(fabs(product) - 1.0) <= 1e-9) || again[0] < 0.0)
            fail_msg("seed %llu case %d: %g %g %g degrees come back as another turn", (unsigned long long)seed, n,
                     degrees[0], degrees[1], degrees[2]);
    }
}

static void test_matrices_that_are_no_rotation_are_refused(void **state)
{
    (void)state;
    static const double bad[][3][3] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},           {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {{1.02, 0, 0}, {0, 1, 0}, {0, 0, 1}},        {{1, 0.02, 0}, {0, 1, 0}, {0, 0, 1}},
        {{(double)NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, (double)INFINITY, 0}, {0, 0, 1}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double turn[4] = {7.0, 7.0, 7.0, 7.0};
        if (tracker_rotation_from_matrix(turn, bad[i]))
            fail_msg("matrix %zu was taken", i);
        assert_true(turn[0] >= 7.0 && turn[3] >= 7.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_turns_follow_the_right_hand),
        cmocka_unit_test(test_turns_are_about_the_bodys_own_axes),
        cmocka_unit_test(test_angles_may_be_many_turns),
        cmocka_unit_test(test_rotation_vectors),
        cmocka_unit_test(test_a_matrix_gives_the_turn_that_made_it),
        cmocka_unit_test(test_matrices_that_are_no_rotation_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
