// SPDX-License-Identifier: Apache-2.0
// What was measured of one case: a line of CSV, and the figures that are asked for.
#include "tests/bench/x86_row.h"

#include <stdlib.h>
#include <string.h>

static int order(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Between two sorted values where the quartile falls between them. */
static double quartile(const double *sorted, int count, int quarters)
{
    const int place = (count - 1) * quarters, low = place / 4;
    const double part = place % 4 / 4.0;
    return part == 0 ? sorted[low] : sorted[low] + part * (sorted[low + 1] - sorted[low]);
}

x86_spread_t x86_spread_of(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, order);
    return (x86_spread_t){quartile(values, count, 2), quartile(values, count, 3) - quartile(values, count, 1)};
}

void x86_print_header(FILE *csv)
{
    fputs("case,format,pose,threads,neon_ns_per_px,neon_iqr,opencv,opencv_ns_per_px,opencv_iqr,ratio,ratio_iqr,"
          "memcpy_ns_per_px,memcpy_iqr,scalar_ns_per_px,scalar_iqr,psnr_db\n",
          csv);
}

void x86_print_row(FILE *csv, const x86_row_t *row)
{
    const x86_spread_t *time = row->ns_per_px;
    fprintf(csv, "%s,%s,%s,%d,", row->work->name, row->format, row->pose, row->threads);
    fprintf(csv, "%.3f,%.3f,", time[X86_NEON].median, time[X86_NEON].iqr);
    fprintf(csv, "%s,%.3f,%.3f,", row->work->opencv_name, time[X86_OPENCV].median, time[X86_OPENCV].iqr);
    fprintf(csv, "%.2f,%.2f,", row->ratio.median, row->ratio.iqr);
    fprintf(csv, "%.3f,%.3f,", time[X86_MEMCPY].median, time[X86_MEMCPY].iqr);
    fprintf(csv, "%.3f,%.3f,", time[X86_SCALAR].median, time[X86_SCALAR].iqr);
    if (row->work->at_least_db > 0)
        fprintf(csv, "%.1f", row->psnr_db);
    fputc('\n', csv);
    fflush(csv);
}

void x86_print_figures(FILE *text, const x86_row_t *rows, int count)
{
    static const struct {
        const char *work, *format;
        double at_least;
    } figures[] = {
        {"linear", "xrgb", 2.5},   {"cubic", "xrgb", 2.5},    {"area", "gray", 1},  {"area", "xrgb", 1},
        {"mean+cubic", "gray", 1}, {"mean+cubic", "xrgb", 1}, {"gauss", "gray", 1}, {"gauss", "xrgb", 1},
    };
    for (size_t f = 0; f < sizeof figures / sizeof *figures; f++) {
        for (int r = 0; r < count; r++) {
            const x86_row_t *row = &rows[r];
            if (row->threads != 1 || strcmp(row->pose, "strong") != 0 ||
                strcmp(row->work->name, figures[f].work) != 0 || strcmp(row->format, figures[f].format) != 0)
                continue;
            fprintf(text, "bench: %-11s %s strong: %.2f times as fast as OpenCV's %s, at least %.1f wanted: %s\n",
                    row->work->name, row->format, row->ratio.median, row->work->opencv_name, figures[f].at_least,
                    row->ratio.median >= figures[f].at_least ? "reached" : "NOT REACHED");
        }
    }
}
