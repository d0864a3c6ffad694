// SPDX-License-Identifier: Apache-2.0
// CSV files with one column per method, and plots of chosen methods from them.
#ifndef SIM_STUDY_STUDY_MESH_CURVES_H
#define SIM_STUDY_STUDY_MESH_CURVES_H

#include <stdio.h>

#include "sim/study/study_mesh.h"

/**
 * Begin a CSV file whose last columns are all methods, in the order of warp_methods[].
 *
 * @param first  Names of the columns before them: "angle_deg,limit".
 * @return As study_csv_begin().
 */
FILE *study_curves_begin(study_t *study, const char *name, const char *first);

/** End a row with the methods' values. */
void study_curves_print(FILE *csv, const double value[WARP_METHODS]);

/** One plot with its caption on the page. Methods have their own colours by place in the list; ls is grey.
    Those that the build lacks are left out. */
typedef struct {
    const char *svg, *csv;
    const char *x_label, *y_label, *caption;
    const char *setup;         /**< as in study_plot_t */
    int x, before;             /**< column of x, from 1; how many columns come before the methods */
    const char *const *method; /**< at most 7 names and ls, or 6 and ls beside extra; NULL at the end */
    const char *extra;         /**< name of one more column, dashed; NULL for none */
    int extra_column;
} study_curves_t;

void study_curves_plot(study_t *study, const study_curves_t *curves);

/**
 * PSNR of every place of a sweep as EXPERIMENT_PICTURE.csv, and plots of the first one, one for each filter: its four
 * interpolators, ls, area, mean+cubic and the limit. The other places have one plot, for the Kaiser filter.
 *
 * @param experiment  "fig10".
 */
void study_curves_by_filter(study_t *study, const char *experiment, const study_mesh_sweep_t *sweep);

#endif
