// SPDX-License-Identifier: Apache-2.0
// The fixed-point surface against the float definition: any size, step, weights; pictures made to be the worst.
#include "warp_fixed/ls_fit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/png_file.h"
#include "tests/support/ls_oracle.h"
#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"

enum { LARGEST = 300, POINTS = 4000 };

static ls_t ls;
static ls_oracle_t across, down;
static ls_weights_t weights;

/* The worst differences, of the surface and of pixels: by the number of axes along which a point is beyond the sites.
 */
typedef struct {
    double surface[3], rms;
    int levels[3];
} deviation_t;

/* Coefficients of the float surface; the caller frees them. */
static double *float_surface(const image_t *picture)
{
    const int m = across.coefficients, width = picture->width, height = picture->height;
    double *rows = malloc(sizeof(double) * (size_t)m * (size_t)height), *line = malloc(sizeof(double) * (size_t)width);
    double *surface = malloc(sizeof(double) * (size_t)m * (size_t)down.coefficients);
    assert_true(rows != NULL && line != NULL && surface != NULL);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++)
            line[x] = image_row(picture, y)[x];
        ls_oracle_fit(&across, rows + y * m, 1, line, 1);
    }
    for (int j = 0; j < m; j++)
        ls_oracle_fit(&down, surface + j, m, rows + j, m);
    free(rows);
    free(line);
    return surface;
}

static double value_at(const double *coefficients, int stride, const int first[2], const double wx[4],
                       const double wy[4])
{
    double value = 0;
    for (int v = 0; v < 4; v++)
        for (int u = 0; u < 4; u++)
            value += wy[v] * wx[u] * coefficients[(first[1] + v) * stride + first[0] + u];
    return value;
}

static double fixed_at(const ls_surface_t *surface, int32_t x_q18, int32_t y_q18)
{
    const ls_taps_t x = ls_axis_taps(surface->x, x_q18), y = ls_axis_taps(surface->y, y_q18);
    double value = 0;
    for (int v = 0; v < 4; v++)
        for (int u = 0; u < 4; u++)
            value += ldexp(y.weight[v], -30) * ldexp(x.weight[u], -30) *
                     ldexp(surface->coefficients[(y.first + v) * surface->x->coefficients + x.first + u],
                           -surface->fraction_bits);
    return value;
}

static int32_t random_phase(rng_t *rng, const ls_axis_t *axis)
{
    const int32_t near = axis->phases < 2 * PHASES ? axis->phases : 2 * PHASES;
    const int kind = (int)rng_int(rng, 0, 3);
    const int32_t phase = (int32_t)rng_int(rng, 0, kind < 2 ? axis->phases : near);
    return kind == 3 ? axis->phases - phase : phase;
}

/* Compare at random phases of both axes, many of them near the picture's edge. */
static deviation_t compare(const image_t *picture, const ls_surface_t *surface, const double *expected, uint64_t seed)
{
    deviation_t worst = {{0}, 0, {0}};
    rng_t rng = {seed};
    for (int n = 0; n < POINTS; n++) {
        const double x = (double)random_phase(&rng, surface->x) * picture->width / surface->x->phases;
        const double y = (double)random_phase(&rng, surface->y) * picture->height / surface->y->phases;
        const int32_t x_q18 = (int32_t)lround(ldexp(x, 18)), y_q18 = (int32_t)lround(ldexp(y, 18));
        const int beyond = (x < 0.5 || x > picture->width - 0.5) + (y < 0.5 || y > picture->height - 0.5);
        double wx[4], wy[4];
        const int first[2] = {ls_oracle_basis(&across, x, wx), ls_oracle_basis(&down, y, wy)};
        const double exact = value_at(expected, across.coefficients, first, wx, wy);
        const double off = fabs(fixed_at(surface, x_q18, y_q18) - exact);
        uint8_t pixel;
        resample_ls_fn *evaluate = warp_kernels_scalar.ls_gray;
        const patch_t patch = {&pixel, 0, &x_q18, &y_q18, 1, 1};
        evaluate(&patch, surface);
        const int level = abs(pixel - (int)floor(fmin(255, fmax(0, exact)) + 0.5));
        worst.surface[beyond] = fmax(worst.surface[beyond], off);
        worst.levels[beyond] = level > worst.levels[beyond] ? level : worst.levels[beyond];
        worst.rms += beyond == 0 ? off * off / POINTS : 0;
    }
    worst.rms = sqrt(worst.rms);
    return worst;
}

static deviation_t deviation(const image_t *picture, double k, uint64_t seed)
{
    const int32_t k_q16 = (int32_t)lround(k * 65536);
    static double wx[IMAGE_MAX_WIDTH], wy[IMAGE_MAX_WIDTH];
    for (int x = 0; x < picture->width; x++)
        wx[x] = fmax(weights.x[x], LS_WEIGHT_MIN) / LS_WEIGHT_ONE;
    for (int y = 0; y < picture->height; y++)
        wy[y] = fmax(weights.y[y], LS_WEIGHT_MIN) / LS_WEIGHT_ONE;
    ls_oracle(&across, picture->width, k_q16 / 65536.0, wx);
    ls_oracle(&down, picture->height, k_q16 / 65536.0, wy);
    double *expected = float_surface(picture);
    const ls_surface_t surface = ls_fit(&ls, &warp_kernels_scalar, picture, k_q16);
    assert_int_equal(surface.x->coefficients, across.coefficients);
    assert_int_equal(surface.y->coefficients, down.coefficients);
    const deviation_t worst = compare(picture, &surface, expected, seed);
    free(expected);
    return worst;
}

typedef enum { BLACK, WHITE, CHECKERBOARD, NOISE, BITS, WORST, PAINTINGS } painting_t;

static void paint(const image_t *picture, painting_t painting, double k, rng_t *rng)
{
    static double wx[LARGEST], wy[LARGEST];
    if (painting == WORST) {
        ls_oracle(&across, picture->width, k, NULL);
        ls_oracle(&down, picture->height, k, NULL);
        const int late = (int)rng_int(rng, 0, 1);
        (void)ls_oracle_worst(&across, late ? across.coefficients - 1 : 0, wx);
        (void)ls_oracle_worst(&down, (int)rng_int(rng, 0, down.coefficients - 1), wy);
    }
    for (int y = 0; y < picture->height; y++) {
        for (int x = 0; x < picture->width; x++) {
            const int value[PAINTINGS] = {0,
                                          255,
                                          (x + y) % 2 * 255,
                                          (int)rng_int(rng, 0, 255),
                                          (int)rng_int(rng, 0, 1) * 255,
                                          painting == WORST && wx[x] * wy[y] > 0 ? 255 : 0};
            image_row(picture, y)[x] = (uint8_t)value[painting];
        }
    }
}

/* Length of a piece; interpolation is as harmless as long ones. */
static double piece_length(const ls_oracle_t *axis)
{
    return axis->interpolates || axis->size <= 4 ? 3 : (double)axis->size / (axis->coefficients - 3);
}

/*
 * Bounds of the surface, in levels: inside, beyond the last site along one axis, and along both. Away from the guard
 * Q4 is all there is; near it the fit itself reaches 10^5 levels in the outermost half pixel, 10^8 in the corner.
 */
static void check(const deviation_t *d, double k, const image_t *picture, painting_t painting, uint64_t seed)
{
    const double length = fmin(piece_length(&across), piece_length(&down));
    const bool near_guard = length < 1.35, quite_near = length < 1.6;
    const double inside = near_guard ? 8 : 0.05, edge = near_guard ? 60 : quite_near ? 0.3 : 0.05;
    const double corner = near_guard ? 300 : quite_near ? 1 : 0.05;
    if (d->surface[0] > inside || d->surface[1] > edge || d->surface[2] > corner || d->levels[0] > 1 ||
        d->levels[1] > (near_guard ? 4 : 1) || d->levels[2] > (near_guard ? 16 : 1))
        fail_msg("seed %lu, %d x %d, k %f, picture %d: off by %.3f, %.3f, %.3f, in levels %d, %d, %d",
                 (unsigned long)seed, picture->width, picture->height, k, painting, d->surface[0], d->surface[1],
                 d->surface[2], d->levels[0], d->levels[1], d->levels[2]);
}

static void surfaces_are_the_float_ones(void **state)
{
    (void)state;
    static const double ks[16] = {0.05, 1,  1 + 1 / 65536.0, 1.2, 1.25, 1.27, 1.3, 1.4, 1.5, 1.7, 2, 3.3, 5, 16,
                                  64,   700};
    static uint8_t pixels[LARGEST * LARGEST];
    ls_weights_init(&weights);
    ls_init(&ls);
    for (uint64_t seed = 1; seed <= 900; seed++) {
        rng_t rng = {seed};
        const int most = seed % 30 == 0 ? LARGEST : 45;
        const int width = (int)rng_int(&rng, 1, most), height = (int)rng_int(&rng, 1, most);
        const image_t picture = {pixels, width, height, width, IMAGE_GRAY8};
        const double k = ks[rng_int(&rng, 0, 15)];
        const painting_t painting = (painting_t)rng_int(&rng, 0, PAINTINGS - 1);
        paint(&picture, painting, k, &rng);
        const deviation_t d = deviation(&picture, k, seed);
        check(&d, k, &picture, painting, seed);
    }
}

static void fits_of_lines_are_the_float_ones(void **state)
{
    (void)state;
    static uint8_t pixels[LARGEST];
    ls_weights_init(&weights);
    ls_init(&ls);
    for (int size = 1; size <= LARGEST; size += size < 40 ? 1 : 23) {
        for (double k = 1.25; k < 2; k += 0.05) {
            rng_t rng = {(uint64_t)size};
            const image_t lines[2] = {{pixels, size, 1, size, IMAGE_GRAY8}, {pixels, 1, size, 1, IMAGE_GRAY8}};
            for (int n = 0; n < 2; n++) {
                paint(&lines[n], WORST, k, &rng);
                const deviation_t d = deviation(&lines[n], k, 1);
                check(&d, k, &lines[n], WORST, (uint64_t)size);
            }
        }
    }
}

/* k 2 and more: whatever the weights, each piece has pixels of its own. */
static void weights_are_obeyed(void **state)
{
    (void)state;
    static uint8_t pixels[120 * 90];
    const image_t picture = {pixels, 120, 90, 120, IMAGE_GRAY8};
    ls_init(&ls);
    for (uint64_t seed = 1; seed <= 60; seed++) {
        rng_t rng = {seed};
        const double k = rng_double(&rng, 2, 9);
        for (int i = 0; i < 120; i++)
            weights.x[i] =
                (uint16_t)(seed % 3 == 0 ? rng_int(&rng, 0, 1) * LS_WEIGHT_ONE : rng_int(&rng, 0, LS_WEIGHT_ONE));
        for (int j = 0; j < 90; j++)
            weights.y[j] = (uint16_t)(seed % 3 == 1 ? LS_WEIGHT_ONE >> (j / 6) : LS_WEIGHT_ONE);
        weights.x[7] = LS_WEIGHT_ONE;
        ls_set_weights(&ls, &weights);
        paint(&picture, NOISE, k, &rng);
        const deviation_t d = deviation(&picture, k, seed);
        if (d.surface[0] > 0.2 || d.levels[0] > 1 || d.levels[1] > 2)
            fail_msg("seed %lu, k %f: off by %.3f, %.3f, %.3f, in levels %d, %d, %d", (unsigned long)seed, k,
                     d.surface[0], d.surface[1], d.surface[2], d.levels[0], d.levels[1], d.levels[2]);
    }
}

/* Weights and pictures made to break it: any answer will do, but not undefined behaviour; see `make sanitize`. */
static void nothing_overflows(void **state)
{
    (void)state;
    static uint8_t pixels[LARGEST * LARGEST];
    for (uint64_t seed = 1; seed <= 400; seed++) {
        rng_t rng = {seed};
        const int width = (int)rng_int(&rng, 1, 60), height = (int)rng_int(&rng, 1, 60);
        const image_t picture = {pixels, width, height, width, IMAGE_GRAY8};
        const int period = (int)rng_int(&rng, 1, 20), light = (int)rng_int(&rng, 0, 20);
        for (int i = 0; i < LARGEST; i++)
            weights.x[i] = weights.y[i] = i % period < light ? 0 : LS_WEIGHT_ONE;
        ls_init(&ls);
        ls_set_weights(&ls, &weights);
        const double k = rng_double(&rng, 0.9, 3);
        paint(&picture, seed % 2 == 0 ? WORST : BITS, k, &rng);
        const deviation_t d = deviation(&picture, k, seed);
        assert_true(d.rms >= 0);
    }
}

static void photographs_are_fitted(void **state)
{
    (void)state;
    static const char *names[3] = {"studio_480x270.png", "coffee_510x290.png", "astronaut_510x290.png"};
    static const double ks[6] = {1, 1.25, 1.3, 1.5, 2, 5};
    ls_weights_init(&weights);
    ls_init(&ls);
    for (int n = 0; n < 3; n++) {
        char path[64], error[512];
        image_t picture;
        snprintf(path, sizeof path, "tests/images/%s", names[n]);
        if (!png_file_load(path, IMAGE_GRAY8, &picture, error))
            fail_msg("%s", error);
        for (int i = 0; i < 6; i++) {
            const deviation_t d = deviation(&picture, ks[i], 1);
            printf("%s, k %.2f: off by %.3f levels (rms %.3f), beyond the last site %.3f, in the corner %.3f\n",
                   names[n], ks[i], d.surface[0], d.rms, d.surface[1], d.surface[2]);
            check(&d, ks[i], &picture, PAINTINGS, 1);
            assert_true(d.rms < 0.02);
        }
        free(picture.data);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_are_the_float_ones), cmocka_unit_test(fits_of_lines_are_the_float_ones),
        cmocka_unit_test(weights_are_obeyed),          cmocka_unit_test(nothing_overflows),
        cmocka_unit_test(photographs_are_fitted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
