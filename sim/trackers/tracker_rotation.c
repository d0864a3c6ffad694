// SPDX-License-Identifier: Apache-2.0
// Orientations as the protocols write them -> quaternions: the one place where angles become a rotation.
#include "sim/trackers/tracker_rotation.h"

#include <math.h>
#include <string.h>

static const double matrix_tolerance = 0.01;

void tracker_rotation_multiply(double c[4], const double a[4], const double b[4])
{
    const double product[4] = {
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    };
    memcpy(c, product, sizeof product);
}

void tracker_rotation_apply(double out[3], const double quaternion[4], const double vector[3])
{
    const double pure[4] = {0.0, vector[0], vector[1], vector[2]};
    const double back[4] = {quaternion[0], -quaternion[1], -quaternion[2], -quaternion[3]};
    double turned[4];
    tracker_rotation_multiply(turned, quaternion, pure);
    tracker_rotation_multiply(turned, turned, back);
    memcpy(out, &turned[1], 3 * sizeof *out);
}

void tracker_rotation_from_angles(double quaternion[4], const char axes[3], const double degrees[3])
{
    double total[4] = {1.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 3; i++) {
        /* of full turns nothing is left, and sin() stays exact for the largest angles */
        const double half = remainder(degrees[i], 720.0) * M_PI / 360.0;
        double turn[4] = {cos(half), 0.0, 0.0, 0.0};
        turn[1 + axes[i] - 'x'] = sin(half);
        tracker_rotation_multiply(total, total, turn);
    }
    memcpy(quaternion, total, sizeof total);
}

void tracker_rotation_from_vector(double quaternion[4], const double radians[3])
{
    const double angle = hypot(hypot(radians[0], radians[1]), radians[2]);
    /* sin(a / 2) / a, which is 1 / 2 at 0; not a division by it */
    const double scale = angle < 1e-9 ? 0.5 : sin(angle / 2.0) / angle;
    quaternion[0] = cos(angle / 2.0);
    for (int i = 0; i < 3; i++)
        quaternion[1 + i] = radians[i] * scale;
}

static double column_product(const double matrix[3][3], int a, int b)
{
    return matrix[0][a] * matrix[0][b] + matrix[1][a] * matrix[1][b] + matrix[2][a] * matrix[2][b];
}

static bool is_rotation(const double m[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b <= a; b++)
            if (!(fabs(column_product(m, a, b) - (a == b)) <= matrix_tolerance))
                return false;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) >
           0.0;
}

bool tracker_rotation_from_matrix(double quaternion[4], const double matrix[3][3])
{
    if (!is_rotation(matrix))
        return false;
    /* Four times the squares of the components: the largest is at least 1, and the others follow from it. */
    const double xx = matrix[0][0], yy = matrix[1][1], zz = matrix[2][2];
    const double squares[4] = {1.0 + xx + yy + zz, 1.0 + xx - yy - zz, 1.0 - xx + yy - zz, 1.0 - xx - yy + zz};
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (squares[i] > squares[largest])
            largest = i;
    const double wx = matrix[2][1] - matrix[1][2], wy = matrix[0][2] - matrix[2][0], wz = matrix[1][0] - matrix[0][1];
    const double xy = matrix[1][0] + matrix[0][1], zx = matrix[0][2] + matrix[2][0], yz = matrix[2][1] + matrix[1][2];
    const double rows[4][4] = {
        {squares[0], wx, wy, wz}, {wx, squares[1], xy, zx}, {wy, xy, squares[2], yz}, {wz, zx, yz, squares[3]}};
    const double *row = rows[largest];
    double length = 0.0;
    for (int i = 0; i < 4; i++)
        length = hypot(length, row[i]);
    for (int i = 0; i < 4; i++)
        quaternion[i] = row[i] / (row[0] < 0.0 ? -length : length);
    return true;
}
