// SPDX-License-Identifier: Apache-2.0
// The picture of what was measured.
#include "tests/bench/x86_plot.h"

#include <string.h>

#include "sim/files/gnuplot.h"

enum { WIDTH = 1360, HEIGHT = 900 };

/* A block of data per plot: case, ours, what OpenCV's is called, its time, ratio, memcpy. */
static void print_data(const gnuplot_t *plot, const x86_row_t *rows, int count, const char *format, const char *pose)
{
    fprintf(plot->pipe, "$%s_%s << END\n", format, pose);
    for (int r = 0; r < count; r++) {
        const x86_row_t *row = &rows[r];
        if (row->threads != 1 || strcmp(row->format, format) != 0 || strcmp(row->pose, pose) != 0)
            continue;
        const bool same = row->work->at_least_db > 0;
        fprintf(plot->pipe, "\"%s%s%s\" %f %f %f \"%.1fx\"\n", row->work->name, same ? "" : "\\nbeside ",
                same ? "" : row->work->opencv_name, row->ns_per_px[X86_NEON].median, row->ns_per_px[X86_OPENCV].median,
                row->ns_per_px[X86_MEMCPY].median, row->ratio.median);
    }
    fputs("END\n", plot->pipe);
}

bool x86_plot(const x86_row_t *rows, int count, const char *folder, char error[FILE_ERROR_LENGTH])
{
    gnuplot_t plot;
    if (!gnuplot_open(&plot, error))
        return false;
    gnuplot_output(&plot, folder, "bench.svg", WIDTH, HEIGHT);
    fputs("set multiplot layout 2,2\n"
          "set boxwidth 0.32\nset style fill solid 0.9 noborder\nset yrange [0:*]\nset offsets 0.1,0.1,0,0\n"
          "set bmargin 4\nset xtics noenhanced font ',12'\nset ylabel 'ns per pixel, one thread' tc rgb '#9aa8bd'\n",
          plot.pipe);
    for (int f = 0; f < BENCH_FORMATS; f++) {
        for (int p = 0; p < BENCH_POSES; p++) {
            const char *format = bench_formats[f].name, *pose = bench_poses[p].name;
            print_data(&plot, rows, count, format, pose);
            fprintf(plot.pipe,
                    "set title '%s, %s pose' tc rgb '#c6d0de'\n"
                    "plot $%s_%s using ($0-0.18):2 with boxes lc rgb colour[1] title 'wallwarp', "
                    "'' using ($0+0.18):3 with boxes lc rgb colour[2] title 'OpenCV', "
                    "'' using ($0):4 with lines lw 2 lc rgb colour[8] title 'memcpy', "
                    "'' using ($0):($2>$3?$2:$3):5:xtic(1) with labels offset 0,0.6 tc rgb '#c6d0de' notitle\n",
                    format, pose, format, pose);
        }
    }
    fputs("unset multiplot\n", plot.pipe);
    return gnuplot_close(&plot, error);
}
