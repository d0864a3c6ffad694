// SPDX-License-Identifier: Apache-2.0
// The plots of a run: its figures, piped to gnuplot.
#include "sim/run/plots.h"

#include <inttypes.h>
#include <math.h>

#include "sim/files/gnuplot.h"

enum { PLOT_POINTS = 2000, WIDTH = 420, HEIGHT = 270, TRUTH_WIDTH = 620, TRUTH_HEIGHT = 330 };

/* A value as gnuplot reads it; what is not finite is left out of the line. */
static void print_value(FILE *plot, double value)
{
    if (isfinite(value))
        fprintf(plot, " %.6g", value);
    else
        fputs(" nan", plot);
}

static double seconds(const run_summary_t *summary, int32_t frame)
{
    return (double)summary->record->frame[frame].time_us / 1e6;
}

/* $walls0, $walls1, ...: time, k, ms. $bus: time, load. $psnr0, ...: time and the four in dB. */
static void print_data(FILE *plot, const run_summary_t *summary)
{
    const run_record_t *record = summary->record;
    const int32_t stride = (record->frames + PLOT_POINTS - 1) / PLOT_POINTS;
    for (int32_t board = 0; board < record->boards; board++) {
        fprintf(plot, "$walls%" PRId32 " << EOD\n", board);
        for (int32_t n = 0; n < record->frames; n += stride) {
            const run_wall_t *wall = &record->wall[n * record->boards + board];
            const bool drawn = wall->report.corrected && wall->report.warp.k_in_q16 > 0;
            fprintf(plot, "%.6f", seconds(summary, n));
            print_value(plot, drawn ? wall->report.warp.k_in_q16 / 65536.0 : (double)NAN);
            fprintf(plot, " %.3f\n", (double)wall->step_time_us / 1000);
        }
        fprintf(plot, "EOD\n$psnr%" PRId32 " << EOD\n", board);
        for (int32_t i = 0; i < record->psnrs; i++) {
            if (record->psnr[i].board != board)
                continue;
            fprintf(plot, "%.6f", seconds(summary, record->psnr[i].frame));
            for (int kind = 0; kind < RUN_DBS; kind++)
                print_value(plot, record->psnr[i].db[kind]);
            fputc('\n', plot);
        }
        fputs("EOD\n", plot);
    }
    fputs("$bus << EOD\n", plot);
    for (int32_t n = 0; n < record->frames; n += stride)
        fprintf(plot, "%.6f %.4f\n", seconds(summary, n), record->frame[n].bus_load_ppm / 1e4);
    fputs("EOD\n", plot);
}

static bool has_value(const run_summary_t *summary, int32_t board, int kind)
{
    for (int32_t i = 0; i < summary->record->psnrs; i++)
        if (summary->record->psnr[i].board == board && isfinite(summary->record->psnr[i].db[kind]))
            return true;
    return false;
}

/* gnuplot takes a plot without any point for an error. */
static void end_plot(FILE *plot, int32_t lines)
{
    fputs(lines > 0 ? "\nset yrange [*:*]\n" : " [][0:1] NaN notitle\nset yrange [*:*]\n", plot);
}

/* One truth: a line for each board, its limit dashed beneath. */
static void plot_truth(const gnuplot_t *gnuplot, const run_summary_t *summary, const char *name, int kind)
{
    FILE *plot = gnuplot->pipe;
    int32_t lines = 0;
    gnuplot_output(gnuplot, summary->folder, name, TRUTH_WIDTH, TRUTH_HEIGHT);
    fprintf(plot,
            "set ylabel 'PSNR, dB' tc rgb '#9aa8bd'\nset title 'Truth: %s (dashed: the limit)' tc rgb '#c6d0de'\n"
            "plot",
            kind == RUN_DB_PSNR ? "the picture itself" : "the finer original");
    for (int32_t board = 0; board < summary->record->boards; board++) {
        const int32_t colour = board % GNUPLOT_COLOURS + 1;
        if (!has_value(summary, board, kind))
            continue;
        fprintf(plot, "%s $psnr%" PRId32 " using 1:%d with lines lw 1.5 dt (4,4) lc rgb colour[%" PRId32 "] notitle",
                lines++ > 0 ? "," : "", board, kind + 3, colour);
        fprintf(plot,
                ", $psnr%" PRId32 " using 1:%d with linespoints pt 7 ps 0.45 lw 2 lc rgb colour[%" PRId32
                "] title '%s'",
                board, kind + 2, colour, summary->room->board[board].name);
    }
    end_plot(plot, lines);
    fputs("unset title\n", plot);
}

static void plot_steps(const gnuplot_t *gnuplot, const run_summary_t *summary)
{
    FILE *plot = gnuplot->pipe;
    int32_t lines = 0;
    gnuplot_output(gnuplot, summary->folder, "step.svg", WIDTH, HEIGHT);
    fputs("set ylabel 'step k' tc rgb '#9aa8bd'\nset yrange [0:*]\nplot", plot);
    for (int32_t board = 0; board < summary->record->boards; board++)
        if (run_record_board(summary->record, board, &summary->room->board[board].wall).drawn)
            fprintf(plot, "%s $walls%" PRId32 " using 1:2 with lines lw 2 lc rgb colour[%" PRId32 "] title '%s'",
                    lines++ > 0 ? "," : "", board, board % GNUPLOT_COLOURS + 1, summary->room->board[board].name);
    end_plot(plot, lines);
}

static void plot_times(const gnuplot_t *gnuplot, const run_summary_t *summary)
{
    FILE *plot = gnuplot->pipe;
    gnuplot_output(gnuplot, summary->folder, "time.svg", WIDTH, HEIGHT);
    fputs("set ylabel 'ms a step' tc rgb '#9aa8bd'\nset yrange [0:*]\nplot", plot);
    for (int32_t board = 0; board < summary->record->boards; board++)
        fprintf(plot, "%s $walls%" PRId32 " using 1:3 with lines lw 1.5 lc rgb colour[%" PRId32 "] title '%s'",
                board > 0 ? "," : "", board, board % GNUPLOT_COLOURS + 1, summary->room->board[board].name);
    end_plot(plot, summary->record->boards);
}

static void plot_bus(const gnuplot_t *gnuplot, const run_summary_t *summary)
{
    FILE *plot = gnuplot->pipe;
    gnuplot_output(gnuplot, summary->folder, "bus.svg", WIDTH, HEIGHT);
    fputs("set ylabel 'load, %' tc rgb '#9aa8bd'\nset yrange [0:*]\n"
          "plot $bus using 1:2 with steps lw 1.5 lc rgb colour[7] title 'bus load from frame to frame'\n",
          plot);
}

bool plots_write(const run_summary_t *summary, char error[FILE_ERROR_LENGTH])
{
    if (summary->record->frames == 0)
        return true;
    gnuplot_t gnuplot;
    if (!gnuplot_open(&gnuplot, error))
        return false;
    fprintf(gnuplot.pipe, "set xlabel 'time, s' tc rgb '#9aa8bd' offset 0,0.3\nset xrange [0:%.6f]\n",
            seconds(summary, summary->record->frames - 1) + 0.5 / summary->rate_hz);
    print_data(gnuplot.pipe, summary);
    if (summary->record->psnrs > 0)
        plot_truth(&gnuplot, summary, "psnr.svg", RUN_DB_PSNR);
    if (summary->record->psnrs > 0 && summary->original_name != NULL)
        plot_truth(&gnuplot, summary, "psnr_original.svg", RUN_DB_ORIGINAL_PSNR);
    plot_steps(&gnuplot, summary);
    plot_times(&gnuplot, summary);
    plot_bus(&gnuplot, summary);
    return gnuplot_close(&gnuplot, error);
}
