// SPDX-License-Identifier: Apache-2.0
// Random walls, cameras and poses within the range that the grid's figure holds for.
#include <math.h>
#include <string.h>

#include "tests/support/oracle.h"

/* A rotation from a random unit quaternion. */
static void random_rotation(double r[3][3], rng_t *rng)
{
    double q[4], square;
    do {
        square = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = rng_double(rng, -1, 1);
            square += q[i] * q[i];
        }
    } while (square < 0.05 || square > 1);
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double matrix[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                 {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                 {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(r, matrix, sizeof(matrix));
}

static void random_wall(wall_corners_t *corners, rng_t *rng)
{
    static const int sizes[5][2] = {{1280, 800}, {1920, 1080}, {3840, 2160}, {4096, 2160}, {640, 360}};
    const int *size = sizes[rng_int(rng, 0, 4)];
    *corners = (wall_corners_t){.panel_width = size[0], .panel_height = size[1]};
    double r[3][3], middle[3];
    random_rotation(r, rng);
    for (int k = 0; k < 3; k++)
        middle[k] = rng_double(rng, -9e6, 9e6);
    const double width = rng_double(rng, 1.2e6, 8e6), height = width * rng_double(rng, 0.4, 1.2);
    const bool keystoned = rng_int(rng, 0, 1) == 1;
    const int unknown = (int)rng_int(rng, 0, 7); /* often four are known */
    const double x[4] = {-0.5, 0.5, 0.5, -0.5}, y[4] = {-0.5, -0.5, 0.5, 0.5};
    for (int c = 0; c < 4; c++) {
        const double dx = (x[c] + (keystoned ? rng_double(rng, -0.12, 0.12) : 0)) * width;
        const double dy = (y[c] + (keystoned ? rng_double(rng, -0.12, 0.12) : 0)) * height;
        corners->corner_known[c] = c != unknown;
        for (int k = 0; k < 3; k++)
            corners->corner_um[c][k] = (int32_t)lround(middle[k] + r[k][0] * dx + r[k][1] * dy);
    }
}

/* A camera frame that looks along forward, rolled by any angle, as a quaternion. */
static void look_along(int32_t quaternion_q30[4], const double forward[3], rng_t *rng)
{
    double random[3][3], right[3], down[3], length = 0;
    random_rotation(random, rng);
    for (int k = 0; k < 3; k++)
        right[k] = forward[(k + 1) % 3] * random[(k + 2) % 3][0] - forward[(k + 2) % 3] * random[(k + 1) % 3][0];
    for (int k = 0; k < 3; k++)
        length += right[k] * right[k];
    for (int k = 0; k < 3; k++)
        right[k] /= sqrt(length);
    for (int k = 0; k < 3; k++)
        down[k] = forward[(k + 1) % 3] * right[(k + 2) % 3] - forward[(k + 2) % 3] * right[(k + 1) % 3];
    /* Columns right, down, forward; the largest of the four candidates is safe to divide by. */
    const double m[3][3] = {
        {right[0], down[0], forward[0]}, {right[1], down[1], forward[1]}, {right[2], down[2], forward[2]}};
    const double squares[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2],
                               1 - m[0][0] + m[1][1] - m[2][2], 1 - m[0][0] - m[1][1] + m[2][2]};
    int best = 0;
    for (int i = 1; i < 4; i++)
        best = squares[i] > squares[best] ? i : best;
    const double terms[4][4] = {{squares[0], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
                                {m[2][1] - m[1][2], squares[1], m[0][1] + m[1][0], m[0][2] + m[2][0]},
                                {m[0][2] - m[2][0], m[0][1] + m[1][0], squares[2], m[1][2] + m[2][1]},
                                {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], squares[3]}};
    const double scale = 0.5 / sqrt(squares[best]);
    for (int i = 0; i < 4; i++)
        quaternion_q30[i] = (int32_t)lround(terms[best][i] * scale * 1073741824.0);
}

void oracle_random_case(oracle_case_t *out, rng_t *rng)
{
    oracle_wall_t wall;
    random_wall(&out->corners, rng);
    oracle_wall(&wall, &out->corners);
    const int32_t width = (int32_t)rng_int(rng, 320, 4096), height = (int32_t)rng_int(rng, 240, 2160);
    out->camera = (camera_t){
        width,
        height,
        {(int64_t)(width * rng_double(rng, 0.4, 1.2) * 1e6), (int64_t)(width * rng_double(rng, 0.4, 1.2) * 1e6)},
        {(int64_t)(width * rng_double(rng, 0.4, 0.6) * 1e6), (int64_t)(height * rng_double(rng, 0.4, 0.6) * 1e6)}};

    /* The eye: a random direction off a random point of the wall, 0.3 m or more from its plane. */
    const long double u = (long double)(out->corners.panel_width * rng_double(rng, 0, 1));
    const long double v = (long double)(out->corners.panel_height * rng_double(rng, 0, 1));
    const long double weight = wall.weight[0] * u + wall.weight[1] * v + wall.weight[2];
    double r[3][3], forward[3], along = 0, length = 0;
    random_rotation(r, rng);
    for (int k = 0; k < 3; k++)
        along += r[k][0] * (double)wall.normal[k];
    const double tilt = rng_double(rng, 0, 83) / 57.29577951308232;
    const double away = rng_double(rng, 0.31, 1) * (rng_int(rng, 0, 3) == 0 ? 1 : 8);
    double sideways[3], side = 0;
    for (int k = 0; k < 3; k++) {
        sideways[k] = r[k][0] - along * (double)wall.normal[k];
        side += sideways[k] * sideways[k];
    }
    for (int k = 0; k < 3; k++) {
        const double target = (double)((wall.point[k][0] * u + wall.point[k][1] * v + wall.point[k][2]) / weight);
        const double offset = away * (double)wall.normal[k] + away * tan(tilt) * sideways[k] / sqrt(side);
        out->pose.eye_nm[k] = llround((target + offset) * 1e9);
        forward[k] = -offset / (away / cos(tilt)) + rng_double(rng, -0.5, 0.5);
        length += forward[k] * forward[k];
    }
    for (int k = 0; k < 3; k++)
        forward[k] /= sqrt(length);
    look_along(out->pose.quaternion_q30, forward, rng);
}
