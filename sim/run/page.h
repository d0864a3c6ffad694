// SPDX-License-Identifier: Apache-2.0
// The page of a run: index.html, which shows its pictures and plots.
#ifndef SIM_RUN_PAGE_H
#define SIM_RUN_PAGE_H

#include <stdbool.h>

#include "sim/files/file_io.h"
#include "sim/run/run_summary.h"

/** At most so many frames are on the page; of longer runs, evenly chosen ones. */
enum { PAGE_FRAMES = 600 };

/**
 * Write FOLDER/index.html: sim/run/page.html with one block of JSON for its data, and sim/run/page.js. It needs nothing
 * but the PNG and SVG files beside it.
 *
 * @return false with the reason in error when it can't be written.
 */
bool page_write(const run_summary_t *summary, char error[FILE_ERROR_LENGTH]);

#endif
