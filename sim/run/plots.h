// SPDX-License-Identifier: Apache-2.0
// The plots of a run, as SVG files that its page shows.
#ifndef SIM_RUN_PLOTS_H
#define SIM_RUN_PLOTS_H

#include <stdbool.h>

#include "sim/files/file_io.h"
#include "sim/run/run_summary.h"

/**
 * Write psnr.svg and psnr_original.svg (as far as something was judged), step.svg, time.svg and bus.svg into the run's
 * folder, with gnuplot.
 *
 * @param[out] error  On failure: gnuplot is missing, which Debian's package gnuplot-nox has, or it has failed.
 */
bool plots_write(const run_summary_t *summary, char error[FILE_ERROR_LENGTH]);

#endif
