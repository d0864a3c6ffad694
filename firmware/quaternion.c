// SPDX-License-Identifier: Apache-2.0
// Rotations as unit quaternions in Q30: logarithm, exponential, and the way between two of them.
#include "firmware/quaternion.h"

#include <string.h>

#include "warp_fixed/fixed.h"

static const int64_t one_q30 = INT64_C(1) << 30;

static int64_t mul_q30(int64_t a, int64_t b)
{
    return round_shift(a * b, 30);
}

bool quaternion_normalise(int32_t unit[4], const int32_t q[4])
{
    uint64_t square_q58 = 0; /* each at most 2^60 */
    for (int i = 0; i < 4; i++)
        square_q58 += (uint64_t)((int64_t)q[i] * q[i]) >> 2;
    const int64_t length_q29 = floor_sqrt(square_q58);
    if (length_q29 < 1 << 19)
        return false;
    for (int i = 0; i < 4; i++) {
        const int64_t twice = (int64_t)q[i] * (1 << 30) / length_q29; /* below 2^42 */
        unit[i] = (int32_t)clamp_i64(round_shift(twice, 1), -one_q30, one_q30);
    }
    return true;
}

/* product = a b: first b, then a. */
static void multiply(int32_t product[4], const int32_t a[4], const int32_t b[4])
{
    /* Of unit length: no sum exceeds 2^60 by more than what rounding left. */
    const int64_t p[4] = {
        (int64_t)a[0] * b[0] - (int64_t)a[1] * b[1] - (int64_t)a[2] * b[2] - (int64_t)a[3] * b[3],
        (int64_t)a[0] * b[1] + (int64_t)a[1] * b[0] + (int64_t)a[2] * b[3] - (int64_t)a[3] * b[2],
        (int64_t)a[0] * b[2] - (int64_t)a[1] * b[3] + (int64_t)a[2] * b[0] + (int64_t)a[3] * b[1],
        (int64_t)a[0] * b[3] + (int64_t)a[1] * b[2] - (int64_t)a[2] * b[1] + (int64_t)a[3] * b[0],
    };
    for (int i = 0; i < 4; i++)
        product[i] = (int32_t)round_shift(p[i], 30);
}

void quaternion_between(int64_t vector_q30[3], const int32_t from[4], const int32_t to[4])
{
    const int32_t back[4] = {from[0], -from[1], -from[2], -from[3]};
    int32_t difference[4];
    multiply(difference, back, to);
    const int64_t sign = difference[0] < 0 ? -1 : 1; /* q and -q are the same rotation */
    const int64_t w = clamp_i64(sign * difference[0], 0, one_q30);
    /* Cosines of a quarter and an eighth of the turn, at most 45 and 22.5 degrees. */
    const int64_t quarter = floor_sqrt((uint64_t)(one_q30 + w) << 29);
    const int64_t eighth = floor_sqrt((uint64_t)(one_q30 + quarter) << 29);
    /* The arc sine's series by the sine, over that sine: sine^2 <= 0.147, and the first term left out is below 2e-6. */
    const int64_t square = one_q30 - mul_q30(eighth, eighth);
    static const int64_t series_q30[] = {32622364, 47934903, 80530637, 178956971, INT64_C(1) << 30};
    int64_t ratio = 0;
    for (size_t n = 0; n < sizeof series_q30 / sizeof *series_q30; n++)
        ratio = mul_q30(ratio, square) + series_q30[n];
    /* The sine of half the turn is 4 quarter eighth times that of its eighth; pi at most. */
    const int64_t scale = (2 * ratio << 30) / mul_q30(quarter, eighth);
    for (int i = 0; i < 3; i++)
        vector_q30[i] = mul_q30(sign * difference[i + 1], scale);
}

void quaternion_turn(int32_t turned[4], const int32_t from[4], const int64_t vector_q30[3])
{
    enum { SQUARINGS = 4 };
    /* The half angle of a sixteenth of the turn: at most 0.25 rad along each axis, so that its square is below 0.19. */
    int64_t half[3], square = 0;
    for (int i = 0; i < 3; i++) {
        half[i] = clamp_i64(vector_q30[i], -8 * one_q30, 8 * one_q30) / (2 << SQUARINGS);
        square += half[i] * half[i];
    }
    square = round_shift(square, 30);
    /* Cosine, and sine by its angle: the terms left out are below 4e-8. */
    const int64_t cosine = one_q30 - mul_q30(square, one_q30 / 2 - mul_q30(square, one_q30 / 24 - square / 720));
    const int64_t ratio = one_q30 - mul_q30(square, one_q30 / 6 - mul_q30(square, one_q30 / 120 - square / 5040));
    int32_t turn[4] = {(int32_t)cosine, 0, 0, 0};
    for (int i = 0; i < 3; i++)
        turn[i + 1] = (int32_t)mul_q30(half[i], ratio);
    for (int n = 0; n < SQUARINGS; n++)
        multiply(turn, turn, turn);
    int32_t product[4];
    multiply(product, from, turn);
    if (!quaternion_normalise(turned, product)) /* the product of two unit quaternions is not short */
        memcpy(turned, from, 4 * sizeof *from);
}

void quaternion_slerp(int32_t middle[4], const int32_t from[4], const int32_t to[4], int32_t part_q30)
{
    int64_t vector[3];
    quaternion_between(vector, from, to);
    for (int i = 0; i < 3; i++)
        vector[i] = mul_q30(vector[i], part_q30); /* |vector| < 2^32 */
    quaternion_turn(middle, from, vector);
}
