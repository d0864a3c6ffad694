// SPDX-License-Identifier: Apache-2.0
// The methods' definitions in floating point: what the fixed-point ones are measured against.
#include "tests/support/float_methods.h"

#include <math.h>
#include <stdlib.h>

#include "warp_fixed/fixed.h"

static double bessel_i0(double x)
{
    double term = 1, sum = 1;
    for (int m = 1; m < 40; m++) {
        term *= x * x / 4 / m / m;
        sum += term;
    }
    return sum;
}

/* Weight n of the filter before it is normalised: fir_design.h. */
static double float_tap(warp_filter_t filter, double k, int n)
{
    if (filter == WARP_FILTER_GAUSS) {
        const double sigma = k * sqrt(log(2)) / M_PI;
        return exp(-n * n / (2 * sigma * sigma));
    }
    if (filter == WARP_FILTER_KAISER) {
        const double part = n / ceil(6 * k), sinc = n == 0 ? 1 : sin(M_PI * n / k) / (M_PI * n / k);
        return sinc * bessel_i0(5 * sqrt(fmax(0, 1 - part * part))) / bessel_i0(5);
    }
    double sum = 0; /* the inverse Fourier integral of |H|, by the midpoint rule */
    enum { STEPS = 8192 };
    for (int i = 0; i < STEPS; i++) {
        const double f = (i + 0.5) / STEPS / 2;
        sum += cos(2 * M_PI * f * n) / sqrt(1 + pow(2 * k * f, 8));
    }
    return sum / STEPS;
}

int float_taps(double taps[PREFILTER_MAX_RADIUS + 1], warp_filter_t filter, double k)
{
    const double radii[4] = {0, floor(4 * k * sqrt(log(2)) / M_PI), ceil(6 * k), ceil(8 * k)};
    const int radius = (int)radii[filter];
    double total = 0;
    for (int n = 0; n <= radius; n++) {
        taps[n] = float_tap(filter, k, n);
        total += n == 0 ? taps[n] : 2 * taps[n];
    }
    for (int n = 0; n <= radius; n++)
        taps[n] /= total;
    return radius;
}

/* Running integral of the kernel from 0 to t. */
static double integral(warp_resampler_t resampler, double t)
{
    if (resampler == WARP_AREA)
        return fmax(-0.5, fmin(0.5, t));
    const double a = fmin(fabs(t), 2);
    if (warp_splines(resampler)) {
        const double part = a < 1 ? a * a * a * a / 8 - a * a * a / 3 + 2 * a / 3 : 0.5 - pow(2 - a, 4) / 24;
        return t < 0 ? -part : part;
    }
    const double size = a < 1 ? 0.375 * a * a * a * a - 2.5 / 3 * a * a * a + a
                              : -0.125 * a * a * a * a + 2.5 / 3 * a * a * a - 2 * a * a + 2 * a - 1.0 / 6;
    return t < 0 ? -size : size;
}

static double kernel(warp_resampler_t resampler, double t)
{
    const double a = fabs(t);
    if (resampler == WARP_AREA)
        return t >= -0.5 && t < 0.5;
    if (resampler == WARP_LINEAR)
        return fmax(0, 1 - a);
    if (warp_splines(resampler))
        return a < 1 ? a * a * a / 2 - a * a + 2.0 / 3 : a < 2 ? pow(2 - a, 3) / 6 : 0;
    return a < 1 ? 1.5 * a * a * a - 2.5 * a * a + 1 : a < 2 ? -0.5 * a * a * a + 2.5 * a * a - 4 * a + 2 : 0;
}

double float_weight(warp_resampler_t resampler, double t, double side)
{
    if (side == 0)
        return kernel(resampler, t);
    return (integral(resampler, t + side / 2) - integral(resampler, t - side / 2)) / side;
}

double float_side(int32_t side)
{
    return side < 64 ? side / 64.0 : (1 + (side - 64) % 32 / 32.0) * (1 << (side - 64) / 32);
}

/* One axis of the interpolating spline's coefficients, from its closed form; count values, `step` apart. */
static void coefficients_along(double *values, int count, int step)
{
    enum { REACH = 40 }; /* 0.27^40 is nothing */
    double in[IMAGE_MAX_WIDTH], weight[2 * REACH + 1];
    for (int m = -REACH; m <= REACH; m++)
        weight[REACH + m] = sqrt(3) * pow(2 - sqrt(3), abs(m)) * (m % 2 == 0 ? 1 : -1);
    for (int n = 0; n < count; n++)
        in[n] = values[n * step];
    for (int n = 0; n < count; n++) {
        double sum = 0;
        for (int m = -REACH; m <= REACH; m++)
            sum += weight[REACH + m] * in[mirror_index(n + m, count)];
        values[n * step] = sum;
    }
}

void float_spline_coefficients(double *values, int width, int height)
{
    for (int y = 0; y < height; y++)
        coefficients_along(values + y * width, width, 1);
    for (int x = 0; x < width; x++)
        coefficients_along(values + x, height, width);
}
