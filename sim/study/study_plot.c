// SPDX-License-Identifier: Apache-2.0
// A study's plots, drawn by gnuplot from its CSV files.
#include "sim/files/gnuplot.h"
#include "sim/study/study_internal.h"

enum { WIDTH = 540, HEIGHT = 350 };

static void print_label(const gnuplot_t *plot, const char *what, const char *text, const char *offset)
{
    if (text == NULL)
        return;
    fprintf(plot->pipe, "set %s ", what);
    gnuplot_string(plot, text);
    fprintf(plot->pipe, " noenhanced tc rgb '#9aa8bd' %s\n", offset);
}

/* A value that is not finite is undefined to gnuplot, and interrupts the line; so does an empty field. */
static void print_line(const gnuplot_t *plot, const study_line_t *line, const char *path)
{
    gnuplot_string(plot, path);
    fprintf(plot->pipe,
            " skip 1 using (column(%d)):(v = column(%d), abs(v) < 1e300 ? v : NaN) with %s lc rgb colour[%d] ", line->x,
            line->y,
            line->marks    ? "points pt 7 ps 0.5"
            : line->dashed ? "lines lw 2 dt (6,4)"
                           : "lines lw 2",
            line->colour % GNUPLOT_COLOURS + 1);
    if (line->title == NULL) {
        fputs("notitle", plot->pipe);
        return;
    }
    fputs("title ", plot->pipe);
    gnuplot_string(plot, line->title);
    fputs(" noenhanced", plot->pipe);
}

void study_plot(study_t *study, const study_plot_t *plot)
{
    gnuplot_t gnuplot;
    char error[FILE_ERROR_LENGTH], path[FILE_ERROR_LENGTH];
    if (study_failed(study))
        return;
    if (!gnuplot_open(&gnuplot, error)) {
        study_fail(study, "%s", error);
        return;
    }
    gnuplot_output(&gnuplot, study->options.folder, plot->name, plot->width > 0 ? plot->width : WIDTH,
                   plot->height > 0 ? plot->height : HEIGHT);
    fputs("set datafile separator comma\nset key width -3 maxcols 3\n",
          gnuplot.pipe); /* as many columns of names as fit */
    print_label(&gnuplot, "title", plot->title, "");
    print_label(&gnuplot, "xlabel", plot->x_label, "offset 0,0.3");
    print_label(&gnuplot, "ylabel", plot->y_label, "");
    if (plot->setup != NULL)
        fputs(plot->setup, gnuplot.pipe);
    for (int l = 0; l < plot->lines; l++) {
        fputs(l == 0 ? "\nplot " : ", ", gnuplot.pipe);
        if (study_path(study, plot->line[l].csv, path) != NULL)
            print_line(&gnuplot, &plot->line[l], path);
    }
    fputc('\n', gnuplot.pipe);
    if (!gnuplot_close(&gnuplot, error))
        study_fail(study, "%s: %s", plot->name, error);
}
