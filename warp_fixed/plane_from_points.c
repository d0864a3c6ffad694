// SPDX-License-Identifier: Apache-2.0
// Measured points -> the least-squares plane through them (paper, eq 1).
#include "warp_fixed/plane_from_points.h"

#include "warp_fixed/real_vector.h"

enum { JACOBI_SWEEPS = 16 };

/* One Jacobi rotation that clears covariance[p][q]; the columns of vectors turn with it. */
static void jacobi_rotate(real_t covariance[3][3], real_t vectors[3][3], int p, int q)
{
    if (real_sign(covariance[p][q]) == 0)
        return;
    const real_t one = real_from_int(1, 0);
    const real_t theta = real_div(real_sub(covariance[q][q], covariance[p][p]), real_scale(covariance[p][q], 1));
    const real_t root = real_sqrt(real_add(real_mul(theta, theta), one));
    real_t t = real_div(one, real_add(real_abs(theta), root));
    if (real_sign(theta) < 0)
        t = real_neg(t);
    const real_t c = real_div(one, real_sqrt(real_add(real_mul(t, t), one)));
    const real_t s = real_mul(t, c);

    for (int k = 0; k < 3; k++) {
        const real_t kp = covariance[k][p], kq = covariance[k][q];
        covariance[k][p] = real_sub(real_mul(c, kp), real_mul(s, kq));
        covariance[k][q] = real_add(real_mul(s, kp), real_mul(c, kq));
    }
    for (int k = 0; k < 3; k++) {
        const real_t pk = covariance[p][k], qk = covariance[q][k];
        covariance[p][k] = real_sub(real_mul(c, pk), real_mul(s, qk));
        covariance[q][k] = real_add(real_mul(s, pk), real_mul(c, qk));
    }
    for (int k = 0; k < 3; k++) {
        const real_t kp = vectors[k][p], kq = vectors[k][q];
        vectors[k][p] = real_sub(real_mul(c, kp), real_mul(s, kq));
        vectors[k][q] = real_add(real_mul(s, kp), real_mul(c, kq));
    }
}

static void mean_and_covariance(real_t mean[3], real_t covariance[3][3], const cloud_t *cloud)
{
    const real_t count = real_from_int(cloud->count, 0);
    for (int a = 0; a < 3; a++) {
        real_t sum = real_from_int(0, 0);
        for (int i = 0; i < cloud->count; i++)
            sum = real_add(sum, cloud->at[i][a]);
        mean[a] = real_div(sum, count);
    }
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            real_t sum = real_from_int(0, 0);
            for (int i = 0; i < cloud->count; i++)
                sum = real_add(sum, real_mul(real_sub(cloud->at[i][a], mean[a]), real_sub(cloud->at[i][b], mean[b])));
            covariance[a][b] = sum;
        }
    }
}

bool plane_from_points(plane_t *plane, const cloud_t *cloud)
{
    real_t covariance[3][3], vectors[3][3];
    mean_and_covariance(plane->mean, covariance, cloud);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            vectors[a][b] = real_from_int(a == b, 0);
    for (int sweep = 0; sweep < JACOBI_SWEEPS; sweep++) { /* converges quadratically: 6 sweeps reach 2^-62 */
        jacobi_rotate(covariance, vectors, 0, 1);
        jacobi_rotate(covariance, vectors, 0, 2);
        jacobi_rotate(covariance, vectors, 1, 2);
    }

    int order[3] = {0, 1, 2}; /* of falling variance */
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < 2; k++) {
            if (real_less(covariance[order[k]][order[k]], covariance[order[k + 1]][order[k + 1]])) {
                const int swap = order[k];
                order[k] = order[k + 1];
                order[k + 1] = swap;
            }
        }
    }
    const real_t first = covariance[order[0]][order[0]], second = covariance[order[1]][order[1]];
    if (real_sign(first) <= 0 || real_less(real_mul(second, real_from_int(1000000, 0)), first))
        return false;
    for (int a = 0; a < 3; a++) {
        plane->x[a] = vectors[a][order[0]];
        plane->y[a] = vectors[a][order[1]];
    }
    vector_cross(plane->n, plane->x, plane->y);
    return true;
}

void plane_coordinates(real_t xy[2], const plane_t *plane, const real_t at[3])
{
    real_t offset[3];
    vector_sub(offset, at, plane->mean);
    xy[0] = vector_dot(offset, plane->x);
    xy[1] = vector_dot(offset, plane->y);
}

void plane_residuals(int32_t *rms, int32_t *worst, const plane_t *plane, const cloud_t *cloud)
{
    real_t squares = real_from_int(0, 0), largest = squares;
    for (int i = 0; i < cloud->count; i++) {
        real_t offset[3];
        vector_sub(offset, cloud->at[i], plane->mean);
        const real_t distance = real_abs(vector_dot(offset, plane->n));
        squares = real_add(squares, real_mul(distance, distance));
        if (real_less(largest, distance))
            largest = distance;
    }
    *rms = (int32_t)real_to_fixed(real_sqrt(real_div(squares, real_from_int(cloud->count, 0))), 0, INT32_MAX);
    *worst = (int32_t)real_to_fixed(largest, 0, INT32_MAX);
}
