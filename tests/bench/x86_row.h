// SPDX-License-Identifier: Apache-2.0
// What was measured of one case: a line of CSV, and the figures that are asked for.
#ifndef TESTS_BENCH_X86_ROW_H
#define TESTS_BENCH_X86_ROW_H

#include <stdio.h>

#include "tests/bench/x86_work.h"

/** Of one value of all rounds. */
typedef struct {
    double median;
    double iqr; /**< from the first quartile to the third */
} x86_spread_t;

typedef struct {
    const x86_case_t *work;
    const char *format, *pose;
    int threads;
    x86_spread_t ns_per_px[X86_WAYS];
    x86_spread_t ratio; /**< how many times as fast as OpenCV, in each round */
    double psnr_db;     /**< between ours and OpenCV's; of no meaning where work->at_least_db is 0 */
} x86_row_t;

/** @param values  count of them, 1 or more; sorted here. */
x86_spread_t x86_spread_of(double *values, int count);

void x86_print_header(FILE *csv);
void x86_print_row(FILE *csv, const x86_row_t *row);

/** Say of each speed that is asked for whether it was reached. One thread, pose strong. */
void x86_print_figures(FILE *text, const x86_row_t *rows, int count);

#endif
