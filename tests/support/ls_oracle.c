// SPDX-License-Identifier: Apache-2.0
// The least-squares spline of ls_knots.h and ls_axis.h along one axis in floating point: normal equations.
//
// Their condition is 2e6 at most, times 4096 with weights: the 19 digits of long double leave 9.
#include "tests/support/ls_oracle.h"

#include <math.h>
#include <string.h>

/* Cox and de Boor, straight from the definition: B-spline j of a degree. The last piece contains its end. */
static double b_spline(const ls_oracle_t *o, int j, int degree, double x)
{
    const double *t = o->knot;
    if (degree == 0)
        return t[j] < t[j + 1] && t[j] <= x && (x < t[j + 1] || (x == o->size && t[j + 1] == x));
    double value = 0;
    if (t[j + degree] > t[j])
        value += (x - t[j]) / (t[j + degree] - t[j]) * b_spline(o, j, degree - 1, x);
    if (t[j + degree + 1] > t[j + 1])
        value += (t[j + degree + 1] - x) / (t[j + degree + 1] - t[j + 1]) * b_spline(o, j + 1, degree - 1, x);
    return value;
}

int ls_oracle_basis(const ls_oracle_t *o, double x, double value[4])
{
    int piece = 0;
    while (piece < o->coefficients - 4 && x >= o->knot[piece + 4])
        piece++;
    for (int t = 0; t < 4; t++)
        value[t] = b_spline(o, piece + t, 3, x);
    return piece;
}

static void place_knots(ls_oracle_t *o, double k)
{
    const int size = o->size, most = size > 4 ? size - 3 : 1;
    o->interpolates = k <= 1 && size >= 4;
    const double wanted = floor(size / fmax(k, 1.25) + 0.5);
    const int pieces = o->interpolates ? most : (int)fmin(fmax(wanted, 1), most);
    o->coefficients = pieces + 3;
    for (int j = 0; j < pieces + 7; j++) {
        const int piece = j - 3;
        o->knot[j] = piece <= 0        ? 0
                     : piece >= pieces ? size
                     : o->interpolates ? piece + 1.5
                                       : (double)piece * size / pieces;
    }
}

static void add_row(ls_oracle_t *o, int first, const double row[4], double weight)
{
    for (int t = 0; t < 4; t++)
        for (int u = t; u < 4; u++)
            o->band[first + t][u - t] += (long double)weight * (long double)row[t] * (long double)row[u];
}

/* L D L^T in place: band[j][0] = D, band[j][u] = L of row j + u. */
static void factor(ls_oracle_t *o)
{
    for (int j = 0; j < o->coefficients; j++) {
        long double *pivot = o->band[j];
        for (int t = 1; t < 4 && j + t < o->coefficients; t++)
            for (int u = t; u < 4; u++)
                o->band[j + t][u - t] -= pivot[t] * pivot[u] / pivot[0];
        for (int t = 1; t < 4; t++)
            pivot[t] /= pivot[0];
    }
}

void ls_oracle(ls_oracle_t *o, int size, double k, const double *weight)
{
    static const double difference[4][4] = {{0}, {-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}};
    memset(o->band, 0, sizeof o->band);
    o->size = size;
    place_knots(o, k);
    for (int i = 0; i < size; i++) {
        double row[4];
        const int first = ls_oracle_basis(o, i + 0.5, row);
        o->weight[i] = weight == NULL ? 1 : weight[i];
        add_row(o, first, row, o->weight[i]);
    }
    for (int i = 0; i < 4 - size; i++) {
        double row[4] = {0};
        memcpy(row + i, difference[size], sizeof(double) * (size_t)(size + 1));
        add_row(o, 0, row, 1);
    }
    factor(o);
}

void ls_oracle_fit(const ls_oracle_t *o, double *coefficients, int coefficient_stride, const double *data,
                   int data_stride)
{
    long double c[LS_ORACLE_MAX_SIZE + 4] = {0};
    for (int i = 0; i < o->size; i++) {
        double row[4];
        const int first = ls_oracle_basis(o, i + 0.5, row);
        for (int t = 0; t < 4; t++)
            c[first + t] += (long double)o->weight[i] * (long double)row[t] * (long double)data[i * data_stride];
    }
    for (int j = 0; j < o->coefficients; j++)
        for (int t = 1; t < 4 && j + t < o->coefficients; t++)
            c[j + t] -= o->band[j][t] * c[j];
    for (int j = o->coefficients - 1; j >= 0; j--) {
        c[j] /= o->band[j][0];
        for (int t = 1; t < 4 && j + t < o->coefficients; t++)
            c[j] -= o->band[j][t] * c[j + t];
        coefficients[j * coefficient_stride] = (double)c[j];
    }
}

double ls_oracle_worst(const ls_oracle_t *o, int j, double *data)
{
    static double unit[LS_ORACLE_MAX_SIZE], c[LS_ORACLE_MAX_SIZE + 4];
    double sum = 0;
    for (int i = 0; i < o->size; i++) {
        unit[i] = 1;
        ls_oracle_fit(o, c, 1, unit, 1);
        unit[i] = 0;
        data[i] = c[j] < 0 ? -1 : 1;
        sum += fabs(c[j]);
    }
    return sum;
}
