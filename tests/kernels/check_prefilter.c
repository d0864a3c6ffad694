// SPDX-License-Identifier: Apache-2.0
// Both passes of the prefilter and of the filter that makes spline coefficients, with the weights they are given.
#include <string.h>

#include "tests/kernels/check.h"
#include "warp_fixed/fir_design.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/spline.h"

enum { ROWS = 3, MAX_BYTES = CHECK_MAX_COUNT + 3, EDGE = 4 * PREFILTER_MAX_RADIUS };

static outputs_t outputs;
static fenced_t sources[ROWS], sums;

/* What a source row must hold, at distance d from the middle, for the largest sum (or the smallest). */
static int extreme(int32_t weight, int smallest)
{
    return (weight > 0) != smallest;
}

static void check_columns(const warp_kernels_t *tested, const fir_t *fir, const char *name)
{
    static const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + 1];
    rng_t rng = {(uint64_t)fir->radius};
    for (int kind = 0; kind < CHECK_FILLS + 2; kind++) {
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            const int at_begin = count % 2;
            uint8_t *memory[ROWS];
            for (int i = 0; i < ROWS; i++) {
                memory[i] = fenced_place(&sources[i], (size_t)count, at_begin);
                check_fill(memory[i], (size_t)count, kind < CHECK_FILLS ? kind : i % 2, &rng);
            }
            for (int32_t d = -fir->radius; d <= fir->radius; d++)
                rows[d + fir->radius] = kind < CHECK_FILLS
                                            ? memory[rng_int(&rng, 0, ROWS - 1)]
                                            : memory[extreme(fir->first[d < 0 ? -d : d], kind - CHECK_FILLS)];
            check_case("prefilter_columns, %s, radius %d, fill %d, count %d", name, fir->radius, kind, count);
            outputs_begin(&outputs, (size_t)count * sizeof(int16_t));
            warp_kernels_scalar.prefilter_columns(outputs.expected, rows, fir, count);
            tested->prefilter_columns(outputs.found, rows, fir, count);
            outputs_compare(&outputs);
        }
    }
}

/* The first pass's largest and smallest sum. */
static void range_of(const fir_t *fir, int32_t range[2])
{
    for (int largest = 0; largest < 2; largest++) {
        int32_t sum = 0;
        for (int32_t d = -fir->radius; d <= fir->radius; d++) {
            const int32_t weight = fir->first[d < 0 ? -d : d];
            sum += extreme(weight, !largest) ? 255 * weight : 0;
        }
        range[largest] = ((sum + ((1 << fir->first_shift) >> 1)) >> fir->first_shift) - fir->offset;
    }
}

/* Sums of the first pass: random ones, or those that make the first output the largest or smallest. */
static void fill_sums(int16_t *v, const fir_t *fir, int32_t count, int32_t channels, int kind, rng_t *rng)
{
    int32_t range[2];
    range_of(fir, range);
    for (int32_t i = 0; i < count + 2 * fir->radius * channels; i++) {
        const int32_t d = i / channels - fir->radius, distance = d < 0 ? -d : d;
        const int32_t weight = distance <= fir->radius ? fir->second[distance] : 0;
        v[i] = (int16_t)(kind == 0   ? rng_int(rng, range[0], range[1])
                         : kind == 1 ? range[rng_int(rng, 0, 1)]
                                     : range[extreme(weight, kind == 2)]);
    }
}

static void check_rows(const warp_kernels_t *tested, const fir_t *fir, int splines, const char *name)
{
    rng_t rng = {(uint64_t)fir->radius};
    for (int kind = 0; kind < 4; kind++) {
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            const int32_t channels = count % 4 == 0 ? 4 : 1, edge = fir->radius * channels;
            int16_t *v = fenced_place(&sums, (size_t)(count + 2 * edge) * sizeof *v, count % 3 == 0);
            fill_sums(v, fir, count, channels, kind, &rng);
            check_case("%s, %s, radius %d, fill %d, count %d", splines ? "spline_row" : "prefilter_row", name,
                       fir->radius, kind, count);
            outputs_begin(&outputs, (size_t)count * (splines ? sizeof(int16_t) : 1));
            if (splines) {
                warp_kernels_scalar.spline_row(outputs.expected, v + edge, fir, count, channels);
                tested->spline_row(outputs.found, v + edge, fir, count, channels);
            } else {
                warp_kernels_scalar.prefilter_row(outputs.expected, v + edge, fir, count, channels);
                tested->prefilter_row(outputs.found, v + edge, fir, count, channels);
            }
            outputs_compare(&outputs);
        }
    }
}

static void take_memory(void)
{
    for (int i = 0; i < ROWS; i++)
        if (sources[i].begin == NULL)
            sources[i] = fenced_new(MAX_BYTES);
    if (sums.begin == NULL)
        sums = fenced_new((MAX_BYTES + 2 * EDGE) * sizeof(int16_t));
}

void check_prefilter(const warp_kernels_t *tested)
{
    static const int32_t ks_q16[] = {65600, 80000, 89784, 130000, 180000, 300000, 1 << 20, 64 << 16};
    static const char *const names[] = {"none", "gauss", "kaiser", "butter"};
    static fir_t fir;
    take_memory();
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        for (size_t n = 0; n < sizeof ks_q16 / sizeof *ks_q16; n++) {
            fir_design(&fir, filter, ks_q16[n]);
            check_columns(tested, &fir, names[filter]);
            check_rows(tested, &fir, 0, names[filter]);
        }
    }
}

static fir_t seen;

static void see_filter(int16_t *restrict v, const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    warp_kernels_scalar.prefilter_columns(v, rows, fir, count);
    seen = *fir;
}

void check_spline_row(const warp_kernels_t *tested)
{
    static spline_t spline;
    static uint8_t pixel;
    const image_t picture = {&pixel, 1, 1, 1, IMAGE_GRAY8};
    warp_kernels_t seeing = warp_kernels_scalar;
    seeing.prefilter_columns = see_filter;
    spline_begin(&spline);
    spline_coefficients(&spline, &seeing, &picture, 0, 0);
    take_memory();
    check_columns(tested, &seen, "spline");
    check_rows(tested, &seen, 1, "spline");
}
