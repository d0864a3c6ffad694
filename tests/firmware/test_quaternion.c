// SPDX-License-Identifier: Apache-2.0
// Rotations in integers against the same in double precision.
#include "firmware/quaternion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "tests/support/rng.h"

static const double one = 1073741824.0;

/* A random unit axis times an angle. */
static void random_turn(double turn[3], rng_t *rng, double angle_rad)
{
    double length = 0.0;
    for (int i = 0; i < 3; i++)
        length = hypot(length, turn[i] = rng_normal(rng));
    for (int i = 0; i < 3; i++)
        turn[i] *= angle_rad / length;
}

static void random_unit(int32_t q[4], rng_t *rng)
{
    int32_t any[4];
    for (int i = 0; i < 4; i++)
        any[i] = (int32_t)(rng_double(rng, -0.9, 0.9) * one);
    assert_true(quaternion_normalise(q, any));
}

static void multiply(double out[4], const double p[4], const double q[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

/* from exp(turn), and how far a quaternion is from it, degrees. */
static double off_deg(const int32_t q[4], const int32_t from[4], const double turn[3])
{
    const double angle = hypot(hypot(turn[0], turn[1]), turn[2]);
    const double s = angle > 0.0 ? sin(angle / 2) / angle : 0.5;
    const double exponential[4] = {cos(angle / 2), s * turn[0], s * turn[1], s * turn[2]};
    const double start[4] = {from[0] / one, from[1] / one, from[2] / one, from[3] / one};
    double expected[4], difference[4];
    multiply(expected, start, exponential);
    const double back[4] = {expected[0], -expected[1], -expected[2], -expected[3]};
    const double got[4] = {q[0] / one, q[1] / one, q[2] / one, q[3] / one};
    multiply(difference, back, got);
    return 360.0 / M_PI * hypot(hypot(difference[1], difference[2]), difference[3]);
}

static void any_length_is_made_one(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10000; seed++) {
        rng_t rng = {seed};
        int32_t q[4], unit[4];
        double length = 0.0;
        const double scale = exp2(rng_double(&rng, -8.0, 0.99));
        for (int i = 0; i < 4; i++) {
            q[i] = (int32_t)(rng_double(&rng, -1.0, 1.0) * scale * one);
            length = hypot(length, q[i]);
        }
        if (length < one / 1000)
            continue;
        assert_true(quaternion_normalise(unit, q));
        for (int i = 0; i < 4; i++)
            if (fabs(unit[i] - q[i] * (one / length)) > 2.0 + 4.0 * one / length)
                fail_msg("seed %d, component %d: %d, expected %.1f", (int)seed, i, unit[i], q[i] * (one / length));
    }
    int32_t unit[4] = {1, 2, 3, 4};
    assert_false(quaternion_normalise(unit, (const int32_t[4]){0, 0, 0, 0}));
    assert_false(quaternion_normalise(unit, (const int32_t[4]){0, 1 << 19, 0, 0}));
    assert_int_equal(unit[3], 4);
    assert_true(quaternion_normalise(unit, (const int32_t[4]){INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN}));
    assert_in_range(-unit[3], (1 << 29) - 1, (1 << 29) + 1);
}

/* The error that each turn may have: the series' own near half a turn, rounding before. */
static double limit_deg(double angle_rad)
{
    return angle_rad > M_PI / 2 ? 3e-4 : 1e-5;
}

static void a_turn_and_the_turn_between_agree(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20000; seed++) {
        rng_t rng = {seed};
        int32_t from[4], to[4];
        double turn[3], between[3];
        int64_t turn_q30[3], between_q30[3];
        const double angle = rng_double(&rng, 0.0, seed % 2 ? 0.1 : 0.999 * M_PI);
        random_unit(from, &rng);
        random_turn(turn, &rng, angle);
        for (int i = 0; i < 3; i++)
            turn_q30[i] = llround(turn[i] * one);
        quaternion_turn(to, from, turn_q30);
        if (off_deg(to, from, turn) > 1e-5)
            fail_msg("seed %d: turned wrong by %g degrees", (int)seed, off_deg(to, from, turn));
        quaternion_between(between_q30, from, to);
        double off = 0.0;
        for (int i = 0; i < 3; i++) {
            between[i] = (double)between_q30[i] / one;
            off = hypot(off, between[i] - turn[i]);
        }
        if (off * 180.0 / M_PI > limit_deg(angle))
            fail_msg("seed %d: %g degrees between, off by %g", (int)seed, angle * 180.0 / M_PI, off * 180.0 / M_PI);
        for (int i = 0; i < 4; i++)
            to[i] = -to[i];
        int64_t same_q30[3];
        quaternion_between(same_q30, from, to);
        for (int i = 0; i < 3; i++)
            assert_true(llabs(same_q30[i] - between_q30[i]) <= 64);
    }
}

static void more_than_a_turn_is_turned_too(void **state)
{
    (void)state;
    const int32_t from[4] = {1 << 30, 0, 0, 0};
    int32_t to[4];
    quaternion_turn(to, from, (const int64_t[3]){0, llround(7.0 * one), 0});
    assert_true(off_deg(to, from, (const double[3]){0.0, 7.0, 0.0}) < 1e-4);
    quaternion_turn(to, from, (const int64_t[3]){INT64_MAX, INT64_MIN, INT64_MAX}); /* clamped to 8 radians */
    assert_true(off_deg(to, from, (const double[3]){8.0, -8.0, 8.0}) < 1e-4);
}

static void the_way_between_has_constant_speed(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 5000; seed++) {
        rng_t rng = {seed};
        int32_t from[4], to[4], middle[4];
        double turn[3];
        int64_t turn_q30[3];
        random_unit(from, &rng);
        random_turn(turn, &rng, rng_double(&rng, 0.0, 1.4));
        for (int i = 0; i < 3; i++)
            turn_q30[i] = llround(turn[i] * one);
        quaternion_turn(to, from, turn_q30);
        const double part = rng_double(&rng, 0.0, 1.0);
        quaternion_slerp(middle, from, to, (int32_t)(part * one));
        for (int i = 0; i < 3; i++)
            turn[i] *= part;
        if (off_deg(middle, from, turn) > 2e-5)
            fail_msg("seed %d, part %g: off by %g degrees", (int)seed, part, off_deg(middle, from, turn));
        quaternion_slerp(from, from, to, 1 << 30);
        for (int i = 0; i < 3; i++)
            turn[i] = 0.0;
        assert_true(off_deg(from, to, turn) < 2e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_length_is_made_one),
        cmocka_unit_test(a_turn_and_the_turn_between_agree),
        cmocka_unit_test(more_than_a_turn_is_turned_too),
        cmocka_unit_test(the_way_between_has_constant_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
