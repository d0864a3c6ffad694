// SPDX-License-Identifier: Apache-2.0
// What was measured of one case: a line of CSV, and the figures that are asked for.
#ifndef TESTS_BENCH_X86_ROW_H
#define TESTS_BENCH_X86_ROW_H

#include <stdio.h>

#include "tests/bench/x86_work.h"

/** Of all rounds. */
typedef struct {
    double median_ns_per_px;
    double iqr_ns_per_px; /**< from the first quartile to the third */
} x86_time_t;

typedef struct {
    const x86_case_t *work;
    const char *format, *pose;
    int threads;
    x86_time_t time[X86_WAYS];
    double psnr_db; /**< between ours and OpenCV's; of no meaning where work->at_least_db is 0 */
} x86_row_t;

/** @param ns_per_px  count times, 1 or more; sorted here. */
x86_time_t x86_time_of(double *ns_per_px, int count);

/** @return How many times as fast as OpenCV. */
double x86_ratio(const x86_row_t *row);

void x86_print_header(FILE *csv);
void x86_print_row(FILE *csv, const x86_row_t *row);

/** Say of each speed that is asked for whether it was reached. One thread, pose strong. */
void x86_print_figures(FILE *text, const x86_row_t *rows, int count);

#endif
