// SPDX-License-Identifier: Apache-2.0
// The picture of what was measured.
#ifndef TESTS_BENCH_X86_PLOT_H
#define TESTS_BENCH_X86_PLOT_H

#include "sim/files/file_io.h"
#include "tests/bench/x86_row.h"

/** Draw FOLDER/bench.svg: bars of the rows of one thread. @return false with the reason in error. */
bool x86_plot(const x86_row_t *rows, int count, const char *folder, char error[FILE_ERROR_LENGTH]);

#endif
