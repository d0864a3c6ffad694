// SPDX-License-Identifier: Apache-2.0
// A least-squares parabola through noisy vectors at irregular times, as far as it is more than noise.
#include "firmware/parabola_fit.h"

#include "warp_fixed/real_vector.h"

enum { SMALLEST_VELOCITY = 4, SMALLEST_ACCELERATION = 9 };           /* squared, in deviations of their noise */
enum { LARGEST_VELOCITY_GAIN = 16, LARGEST_ACCELERATION_GAIN = 64 }; /* of the noise's variance */
enum { EXPECTED_COMPONENTS = 9 }; /* of expected noise, mixed with what is measured */

void parabola_add(parabola_sums_t *sums, int32_t time_us, const int64_t value[3])
{
    const int64_t time = time_us, square = time * time;
    sums->count++;
    sums->time[0] += time;
    sums->time[1] += square;
    sums->time[2] += square * time; /* 2^51 each */
    sums->time_4 += (int128_t)square * square;
    for (int i = 0; i < 3; i++) {
        sums->value[i] += value[i];
        sums->time_value[i] += time * value[i]; /* 2^51 each */
        sums->time_2_value[i] += (int128_t)square * value[i];
        sums->value_2 += (int128_t)value[i] * value[i];
    }
}

/* |wide| < 2^125 */
static real_t real_from_wide(int128_t wide)
{
    const int64_t low = (int64_t)(wide & ((INT64_C(1) << 62) - 1));
    return real_add(real_from_int((int64_t)(wide >> 62), 62), real_from_int(low, 0));
}

static real_t real_int(int64_t value)
{
    return real_from_int(value, 0);
}

/* Sums over the count are means. */
typedef struct {
    real_t time, time_2, value[3];
} means_t;

static means_t means_of(const parabola_sums_t *sums)
{
    const real_t each = real_div(real_int(1), real_int(sums->count));
    means_t means = {real_mul(each, real_int(sums->time[0])), real_mul(each, real_int(sums->time[1])), {{0, 0}}};
    for (int i = 0; i < 3; i++)
        means.value[i] = real_mul(each, real_int(sums->value[i]));
    return means;
}

/* One of the orthogonal polynomials: its sum of squares over the vectors' times, its products with them, the square
 * of its coefficient in deviations (energy), and its values at two times. */
typedef struct {
    real_t square, product[3], energy;
    real_t at, farthest;
} term_t;

static void finish_term(term_t *term)
{
    term->energy = real_div(vector_dot(term->product, term->product), term->square);
}

/* p(t) = t - mean */
static void velocity_term(term_t *term, const parabola_sums_t *sums, const means_t *means, const parabola_ask_t *ask)
{
    term->square = real_sub(real_int(sums->time[1]), real_mul(means->time, real_int(sums->time[0])));
    term->at = real_sub(real_int(ask->time_us), means->time);
    term->farthest = real_sub(real_int(ask->farthest_us), means->time);
    for (int i = 0; i < 3; i++)
        term->product[i] = real_sub(real_int(sums->time_value[i]), real_mul(means->time, real_int(sums->value[i])));
}

/* p(t) = t^2 - slope (t - mean) - mean of t^2 */
static void acceleration_term(term_t *term, const term_t *velocity, const parabola_sums_t *sums, const means_t *means,
                              const parabola_ask_t *ask)
{
    const real_t slope =
        real_div(real_sub(real_int(sums->time[2]), real_mul(means->time_2, real_int(sums->time[0]))), velocity->square);
    term->square = real_sub(real_sub(real_from_wide(sums->time_4), real_mul(means->time_2, real_int(sums->time[1]))),
                            real_mul(real_mul(slope, slope), velocity->square));
    const int64_t at = ask->time_us, farthest = ask->farthest_us;
    term->at = real_sub(real_sub(real_int(at * at), real_mul(slope, velocity->at)), means->time_2);
    term->farthest =
        real_sub(real_sub(real_int(farthest * farthest), real_mul(slope, velocity->farthest)), means->time_2);
    for (int i = 0; i < 3; i++)
        term->product[i] =
            real_sub(real_sub(real_from_wide(sums->time_2_value[i]), real_mul(slope, velocity->product[i])),
                     real_mul(means->time_2, real_int(sums->value[i])));
}

/* Would the term's own noise at the farthest time be within bounds? */
static bool is_usable(const term_t *term, int32_t largest_gain)
{
    return real_sign(term->square) > 0 &&
           !real_less(real_mul(real_int(largest_gain), term->square), real_mul(term->farthest, term->farthest));
}

/* Add the term to the values, made smaller as its noise demands. */
static void add_term(real_t value[3], const term_t *term, real_t variance, int32_t smallest)
{
    const real_t noise = real_mul(real_int(smallest), variance);
    if (!real_less(noise, term->energy))
        return;
    const real_t kept = real_sub(term->energy, noise);
    const real_t factor = real_div(real_mul(kept, term->at), real_mul(term->energy, term->square));
    for (int i = 0; i < 3; i++)
        value[i] = real_add(value[i], real_mul(factor, term->product[i]));
}

/* Variance of a component: of what the terms leave over, mixed with what is expected. */
static real_t variance_of(const parabola_sums_t *sums, const means_t *means, const term_t term[2], int32_t terms,
                          int64_t noise)
{
    const real_t sum[3] = {real_int(sums->value[0]), real_int(sums->value[1]), real_int(sums->value[2])};
    real_t rest = real_sub(real_from_wide(sums->value_2), vector_dot(means->value, sum));
    for (int32_t n = 0; n < terms; n++)
        rest = real_sub(rest, term[n].energy);
    if (real_sign(rest) < 0)
        rest = real_int(0);
    const real_t expected = real_mul(real_int(EXPECTED_COMPONENTS), real_mul(real_int(noise), real_int(noise)));
    return real_div(real_add(rest, expected), real_int(3 * (sums->count - 1 - terms) + EXPECTED_COMPONENTS));
}

bool parabola_at(const parabola_sums_t *sums, const parabola_ask_t *ask, int64_t value[3])
{
    term_t term[2];
    int32_t terms = 1;
    if (sums->count < 2)
        return false;
    const means_t means = means_of(sums);
    velocity_term(&term[0], sums, &means, ask);
    if (!is_usable(&term[0], LARGEST_VELOCITY_GAIN))
        return false;
    finish_term(&term[0]);
    if (sums->count > 2) {
        acceleration_term(&term[1], &term[0], sums, &means, ask);
        if (is_usable(&term[1], LARGEST_ACCELERATION_GAIN)) {
            finish_term(&term[1]);
            terms = 2;
        }
    }
    const real_t variance = variance_of(sums, &means, term, terms, ask->noise);
    real_t at[3] = {means.value[0], means.value[1], means.value[2]};
    add_term(at, &term[0], variance, SMALLEST_VELOCITY);
    if (terms == 2)
        add_term(at, &term[1], variance, SMALLEST_ACCELERATION);
    for (int i = 0; i < 3; i++)
        value[i] = real_to_fixed(at[i], 0, INT64_C(1) << 60);
    return true;
}
