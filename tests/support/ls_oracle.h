// SPDX-License-Identifier: Apache-2.0
// The least-squares spline of ls_knots.h and ls_axis.h along one axis in floating point: what the fixed-point fit is
// measured against.
#ifndef TESTS_SUPPORT_LS_ORACLE_H
#define TESTS_SUPPORT_LS_ORACLE_H

#include <stdbool.h>

enum { LS_ORACLE_MAX_SIZE = 4096 };

typedef struct {
    int size, coefficients;
    bool interpolates;
    double knot[LS_ORACLE_MAX_SIZE + 8];         /**< of B-spline j: j to j + 4 */
    double weight[LS_ORACLE_MAX_SIZE];           /**< w_i */
    long double band[LS_ORACLE_MAX_SIZE + 4][4]; /**< normal equations, factored: diagonal first */
} ls_oracle_t;

/**
 * @param k       The step.
 * @param weight  `size` numbers above 0, or NULL for uniform ones.
 */
void ls_oracle(ls_oracle_t *oracle, int size, double k, const double *weight);

/** Fit one line. Coefficients and data have strides of their own. */
void ls_oracle_fit(const ls_oracle_t *oracle, double *coefficients, int coefficient_stride, const double *data,
                   int data_stride);

/** The four B-splines that are not zero at x. @return The first one's number. */
int ls_oracle_basis(const ls_oracle_t *oracle, double x, double value[4]);

/** Write the data of -1 and 1 that make coefficient j largest; also the sum of the operator's row. */
double ls_oracle_worst(const ls_oracle_t *oracle, int j, double *data);

#endif
