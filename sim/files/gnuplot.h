// SPDX-License-Identifier: Apache-2.0
// gnuplot at the other end of a pipe, drawing SVG files in the dark style of this project's pages.
#ifndef SIM_FILES_GNUPLOT_H
#define SIM_FILES_GNUPLOT_H

#include "sim/files/file_io.h"

enum { GNUPLOT_COLOURS = 8 };

typedef struct {
    FILE *pipe; /**< commands are printed here; colour[1] to colour[GNUPLOT_COLOURS] are the style's colours */
    void (*before)(int);
} gnuplot_t;

/** Start it. @return false with the reason in error. SIGPIPE is ignored until gnuplot_close(). */
bool gnuplot_open(gnuplot_t *plot, char error[FILE_ERROR_LENGTH]);

/**
 * End it, and wait until the files are there.
 *
 * @return false with the reason in error: gnuplot is missing, which Debian's package gnuplot-nox has, or it has failed
 *         and said why on stderr.
 */
bool gnuplot_close(gnuplot_t *plot, char error[FILE_ERROR_LENGTH]);

/** The next plot goes to FOLDER/NAME. @param width, height  Of the SVG, pixels. */
void gnuplot_output(const gnuplot_t *plot, const char *folder, const char *name, int width, int height);

/** Print a text as gnuplot's string: whatever it holds, in single quotes and unformatted. */
void gnuplot_string(const gnuplot_t *plot, const char *text);

#endif
