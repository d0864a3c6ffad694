// SPDX-License-Identifier: Apache-2.0
// Parabolas that are known, noise without any, and both, at even and uneven times.
#include "firmware/parabola_fit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "tests/support/rng.h"

/* value = c[0] + c[1] t + c[2] t^2 with t in units of 10 ms, for each of three components. */
typedef struct {
    double c[3][3];
} parabola_t;

static double parabola_value(const parabola_t *parabola, int component, double time_us)
{
    const double t = time_us / 1e4, *c = parabola->c[component];
    return c[0] + (c[1] + c[2] * t) * t;
}

static parabola_t random_parabola(rng_t *rng, double size)
{
    parabola_t parabola;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            parabola.c[i][k] = rng_double(rng, -size, size);
    return parabola;
}

/* Vectors of a parabola with noise, over times from -length to length, some of them missing. */
static void add_vectors(parabola_sums_t *sums, const parabola_t *parabola, int32_t length_us, double noise, rng_t *rng)
{
    for (int32_t time_us = -length_us; time_us <= length_us; time_us += 4167) {
        if (rng_int(rng, 0, 4) == 0)
            continue;
        const int32_t uneven_us = time_us + (int32_t)rng_int(rng, 0, 2000);
        int64_t value[3];
        for (int i = 0; i < 3; i++)
            value[i] = llround(parabola_value(parabola, i, uneven_us) + noise * rng_normal(rng));
        parabola_add(sums, uneven_us, value);
    }
}

static void a_parabola_without_noise_is_itself(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        rng_t rng = {seed};
        const parabola_t parabola = random_parabola(&rng, 1e7);
        parabola_sums_t sums = {.count = 0};
        add_vectors(&sums, &parabola, 60000, 0.0, &rng);
        const parabola_ask_t ask = {(int32_t)rng_int(&rng, -50000, 110000), 110000, 0};
        int64_t value[3];
        if (!parabola_at(&sums, &ask, value)) /* so few are left that their velocity is worth nothing */
            continue;
        for (int i = 0; i < 3; i++) {
            const double expected = parabola_value(&parabola, i, ask.time_us);
            if (fabs((double)value[i] - expected) > 10.0)
                fail_msg("seed %d, %d vectors, component %d at %d us: %ld, expected %.1f", (int)seed, sums.count, i,
                         ask.time_us, (long)value[i], expected);
        }
    }
}

/* The largest values that are allowed neither overflow nor lose what is asked for. */
static void the_largest_values_fit(void **state)
{
    (void)state;
    enum { LARGEST_US = 1 << 17 };
    const double large = 17179869184.0 / (13.1072 * 13.1072 + 13.1072 + 1.0) * 0.999; /* 2^34 at the ends */
    const parabola_t parabola = {{{large, large, large}, {-large, large, -large}, {-large, -large, -large}}};
    parabola_sums_t sums = {.count = 0};
    for (int n = 0; n < 1024; n++) {
        const int32_t time_us = -LARGEST_US + n * 256;
        int64_t value[3];
        for (int i = 0; i < 3; i++)
            value[i] = llround(parabola_value(&parabola, i, time_us));
        parabola_add(&sums, time_us, value);
    }
    const parabola_ask_t ask = {LARGEST_US, LARGEST_US, 0};
    int64_t value[3];
    assert_true(parabola_at(&sums, &ask, value));
    for (int i = 0; i < 3; i++)
        assert_true(fabs((double)value[i] - parabola_value(&parabola, i, LARGEST_US)) < 4.0);
}

/* At rest the mean remains nearly always: its noise, not the parabola's, which is three times that of one vector. */
static void noise_alone_is_averaged(void **state)
{
    (void)state;
    const double noise = 5e5;
    const parabola_t rest = {{{3e6, 0.0, 0.0}, {-4e6, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
    for (int expected = 1; expected <= 4; expected *= 4) { /* noise as stated, and four times that */
        double square = 0.0;
        int32_t count = 0;
        for (uint64_t seed = 1; seed <= 3000; seed++) {
            rng_t rng = {seed};
            parabola_sums_t sums = {.count = 0};
            add_vectors(&sums, &rest, 55000, noise, &rng);
            const parabola_ask_t ask = {55000 + 40000, 55000 + 60000, (int64_t)noise / expected};
            int64_t value[3];
            if (!parabola_at(&sums, &ask, value))
                continue;
            for (int i = 0; i < 3; i++)
                square += pow(((double)value[i] - rest.c[i][0]) / noise, 2);
            count += 3;
        }
        const double ratio = sqrt(square / count);
        assert_true(count > 8000);
        if (ratio > 0.5)
            fail_msg("%d times the stated noise: %.3f of it is left", expected, ratio);
    }
}

/* In motion the fit is the plain least-squares one: as good as its noise allows, without a bias. */
static void motion_is_not_held_back(void **state)
{
    (void)state;
    const double noise = 5e5;
    const parabola_t moves = {{{0.0, 1.4e7, 0.0}, {0.0, 0.0, 1e6}, {0.0, 5e6, -5e5}}};
    double sum[3] = {0.0, 0.0, 0.0}, square = 0.0;
    enum { RUNS = 3000 };
    for (uint64_t seed = 1; seed <= RUNS; seed++) {
        rng_t rng = {seed};
        parabola_sums_t sums = {.count = 0};
        add_vectors(&sums, &moves, 55000, noise, &rng);
        const parabola_ask_t ask = {95000, 115000, (int64_t)noise};
        int64_t value[3];
        assert_true(parabola_at(&sums, &ask, value));
        for (int i = 0; i < 3; i++) {
            const double error = ((double)value[i] - parabola_value(&moves, i, ask.time_us)) / noise;
            sum[i] += error / RUNS;
            square += error * error / (3 * RUNS);
        }
    }
    for (int i = 0; i < 3; i++)
        if (fabs(sum[i]) > 0.5)
            fail_msg("component %d is biased by %.2f of the noise", i, sum[i]);
    if (sqrt(square) > 2.5)
        fail_msg("noise grows by %.2f", sqrt(square));
}

static void too_few_vectors_tell_no_velocity(void **state)
{
    (void)state;
    int64_t value[3] = {7, 7, 7};
    const parabola_ask_t ask = {100000, 110000, 500000};
    parabola_sums_t sums = {.count = 0};
    assert_false(parabola_at(&sums, &ask, value));
    const int64_t at[3] = {1000, 2000, 3000};
    parabola_add(&sums, 50000, at);
    assert_false(parabola_at(&sums, &ask, value));
    parabola_add(&sums, 49999, at); /* a microsecond says nothing */
    assert_false(parabola_at(&sums, &ask, value));
    assert_int_equal(value[0], 7);
    for (int32_t time_us = 46000; time_us > 20000; time_us -= 4000)
        parabola_add(&sums, time_us, at);
    assert_true(parabola_at(&sums, &ask, value));
    assert_int_equal(value[2], 3000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_parabola_without_noise_is_itself),
        cmocka_unit_test(the_largest_values_fit),
        cmocka_unit_test(noise_alone_is_averaged),
        cmocka_unit_test(motion_is_not_held_back),
        cmocka_unit_test(too_few_vectors_tell_no_velocity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
