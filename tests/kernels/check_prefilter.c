// SPDX-License-Identifier: Apache-2.0
// Both passes of every filter, with the weights that are in use.
#include <stdbool.h>

#include "tests/kernels/check.h"
#include "warp_fixed/fir_design.h"
#include "warp_fixed/fixed.h"

enum { ROWS = 3, MAX_BYTES = CHECK_MAX_COUNT + 3, EDGE = 4 * PREFILTER_MAX_RADIUS };

static outputs_t outputs[FILTER_ROWS];
static fenced_t sources[ROWS], sums;

/* What a source row must hold, at distance d from the middle, for the largest sum (or the smallest). */
static int extreme(int32_t weight, int smallest)
{
    return (weight > 0) != smallest;
}

static void check_columns(const warp_kernels_t *tested, const fir_t *fir, const char *name)
{
    static const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + FILTER_ROWS];
    rng_t rng = {(uint64_t)fir->radius};
    for (int kind = 0; kind < CHECK_FILLS + 2; kind++) {
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            const int at_begin = count % 2;
            uint8_t *memory[ROWS];
            for (int i = 0; i < ROWS; i++) {
                memory[i] = fenced_place(&sources[i], (size_t)count, at_begin);
                check_fill(memory[i], (size_t)count, kind < CHECK_FILLS ? kind : i % 2, &rng);
            }
            for (int32_t i = 0; i < 2 * fir->radius + FILTER_ROWS; i++) {
                const int32_t d = i - fir->radius - count % FILTER_ROWS, distance = d < 0 ? -d : d;
                const int32_t weight = distance <= fir->radius ? fir->weight[distance] : 0;
                rows[i] = kind < CHECK_FILLS ? memory[rng_int(&rng, 0, ROWS - 1)]
                                             : memory[extreme(weight, kind - CHECK_FILLS)];
            }
            check_case("filter_columns, %s, radius %d, fill %d, count %d", name, fir->radius, kind, count);
            int16_t *expected[FILTER_ROWS], *found[FILTER_ROWS];
            for (int i = 0; i < FILTER_ROWS; i++) {
                outputs_begin(&outputs[i], (size_t)count * sizeof(int16_t));
                expected[i] = outputs[i].expected;
                found[i] = outputs[i].found;
            }
            warp_kernels_scalar.filter_columns(expected, rows, fir, count);
            tested->filter_columns(found, rows, fir, count);
            for (int i = 0; i < FILTER_ROWS; i++)
                outputs_compare(&outputs[i]);
        }
    }
}

/* The first pass's largest and smallest sum. */
static void range_of(const fir_t *fir, int32_t range[2])
{
    for (int largest = 0; largest < 2; largest++) {
        int32_t sum = 0;
        for (int32_t d = -fir->radius; d <= fir->radius; d++) {
            const int32_t weight = fir->weight[d < 0 ? -d : d];
            sum += extreme(weight, !largest) ? 255 * weight : 0;
        }
        range[largest] = (sum >> (FILTER_SUM_LOG2 - FILTER_FIRST_BITS)) - (COEFFICIENT_MIDDLE << FILTER_FIRST_BITS);
    }
}

static int32_t readable_radius(const fir_t *fir)
{
    return fir->radius < FILTER_SLACK ? FILTER_SLACK : fir->radius;
}

/* Sums of the first pass: random ones, or those that make the first output the largest or smallest. */
static void fill_sums(int16_t *v, const fir_t *fir, int32_t count, int32_t channels, int kind, rng_t *rng)
{
    int32_t range[2];
    range_of(fir, range);
    for (int32_t i = 0; i < count + 2 * readable_radius(fir) * channels; i++) {
        const int32_t d = i / channels - readable_radius(fir), distance = d < 0 ? -d : d;
        const int32_t weight = distance <= fir->radius ? fir->weight[distance] : 0;
        v[i] = (int16_t)(kind == 0   ? rng_int(rng, range[0], range[1])
                         : kind == 1 ? range[rng_int(rng, 0, 1)]
                                     : range[extreme(weight, kind == 2)]);
    }
}

static void check_rows(const warp_kernels_t *tested, const fir_t *fir, bool bytes, const char *name)
{
    rng_t rng = {(uint64_t)fir->radius};
    for (int kind = 0; kind < 4; kind++) {
        for (int32_t count = 0; count <= CHECK_MAX_COUNT; count++) {
            const int32_t channels = count % 4 == 0   ? 4
                                     : count % 4 == 2 ? 2
                                                      : 1,
                          edge = readable_radius(fir) * channels;
            int16_t *v = fenced_place(&sums, (size_t)(count + 2 * edge) * sizeof *v, count % 3 == 0);
            fill_sums(v, fir, count, channels, kind, &rng);
            check_case("%s, %s, radius %d, fill %d, count %d", bytes ? "filter_row_bytes" : "filter_row", name,
                       fir->radius, kind, count);
            outputs_begin(outputs, (size_t)count * (bytes ? 1 : sizeof(int16_t)));
            if (bytes) {
                warp_kernels_scalar.filter_row_bytes(outputs->expected, v + edge, fir, count, channels);
                tested->filter_row_bytes(outputs->found, v + edge, fir, count, channels);
            } else {
                warp_kernels_scalar.filter_row(outputs->expected, v + edge, fir, count, channels);
                tested->filter_row(outputs->found, v + edge, fir, count, channels);
            }
            outputs_compare(outputs);
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

static void check_filter(const warp_kernels_t *tested, const fir_t *fir, const char *name)
{
    check_columns(tested, fir, name);
    check_rows(tested, fir, false, name);
    check_rows(tested, fir, true, name);
}

/* Any weights whose absolute values sum to `size` and that sum to 1: one of each side is negative. */
static void made_up(fir_t *fir, int32_t radius, int32_t size, rng_t *rng)
{
    const int32_t one = 1 << FILTER_SUM_LOG2, negative = -((size - one) / 4);
    int32_t rest = one - 2 * negative;
    fir->radius = radius;
    for (int32_t d = 1; d < radius; d++) {
        fir->weight[d] = (int16_t)rng_int(rng, 0, rest / (2 * radius));
        rest -= 2 * fir->weight[d];
    }
    fir->weight[radius] = (int16_t)negative;
    fir->weight[0] = (int16_t)rest;
}

void check_filters(const warp_kernels_t *tested)
{
    static const int32_t ks_q16[] = {65600, 80000, 89784, 180000, 300000, 64 << 16};
    static const char *const names[] = {"none", "gauss", "kaiser", "butter"};
    static fir_t fir;
    take_memory();
    for (warp_filter_t filter = WARP_FILTER_NONE; filter <= WARP_FILTER_BUTTER; filter++) {
        for (size_t n = 0; n < sizeof ks_q16 / sizeof *ks_q16; n++) {
            const bool splines = n % 2 == 1;
            if (filter == WARP_FILTER_NONE && n != 1)
                continue;
            fir_design(&fir, filter, ks_q16[n], splines);
            check_filter(tested, &fir, names[filter]);
        }
    }
    /* Two sums of equal distance fit 16 bits while the absolute weights sum to less than twice 1. */
    static const int32_t sizes[] = {1 << FILTER_SUM_LOG2, 2 * (1 << FILTER_SUM_LOG2) - 4, 2 * (1 << FILTER_SUM_LOG2),
                                    3 * (1 << FILTER_SUM_LOG2) - 8};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        rng_t rng = {seed};
        made_up(&fir, 1 + (int32_t)(seed / 4 % 10), sizes[seed % 4], &rng);
        check_filter(tested, &fir, "made up");
    }
}
