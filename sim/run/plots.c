// SPDX-License-Identifier: Apache-2.0
// The plots of a run: its figures, piped to gnuplot.
#include "sim/run/plots.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <sys/wait.h>

enum { PLOT_POINTS = 2000, COLOURS = 8, NOT_FOUND = 127 };

static const char style[] =
    "set encoding utf8\n"
    "set border 3 lc rgb '#46536a'\n"
    "set tics nomirror scale 0.5 tc rgb '#9aa8bd'\n"
    "set grid lc rgb '#263042' lw 1 dt 1\n"
    "set key outside top center horizontal samplen 1.6 tc rgb '#c6d0de'\n"
    "set xlabel 'time, s' tc rgb '#9aa8bd' offset 0,0.3\n"
    "set datafile missing 'nan'\n"
    "array colour[8] = ['#6cb6ff','#f5a65b','#7fdca0','#c99bff','#ff8fa3','#e8d56b','#5fd3d3','#b9c3d0']\n";

static void begin_plot(FILE *plot, const run_summary_t *summary, const char *name, const char *size)
{
    fprintf(plot, "set terminal svg size %s dynamic font 'Inter,Helvetica,Arial,sans-serif,13' background '#121926'\n",
            size);
    /* gnuplot reads '' within single quotes as one quote */
    fputs("set output '", plot);
    for (const char *c = summary->folder; *c != '\0'; c++)
        fputs(*c == '\'' ? "''" : (char[]){*c, '\0'}, plot);
    fprintf(plot, "/%s'\n", name);
}

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
static void plot_truth(FILE *plot, const run_summary_t *summary, const char *name, int kind)
{
    int32_t lines = 0;
    begin_plot(plot, summary, name, "620,330");
    fprintf(plot,
            "set ylabel 'PSNR, dB' tc rgb '#9aa8bd'\nset title 'Truth: %s (dashed: the limit)' tc rgb '#c6d0de'\n"
            "plot",
            kind == RUN_DB_PSNR ? "the picture itself" : "the finer original");
    for (int32_t board = 0; board < summary->record->boards; board++) {
        const int32_t colour = board % COLOURS + 1;
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

static void plot_steps(FILE *plot, const run_summary_t *summary)
{
    int32_t lines = 0;
    begin_plot(plot, summary, "step.svg", "420,270");
    fputs("set ylabel 'step k' tc rgb '#9aa8bd'\nset yrange [0:*]\nplot", plot);
    for (int32_t board = 0; board < summary->record->boards; board++)
        if (run_record_board(summary->record, board, &summary->room->board[board].wall).drawn)
            fprintf(plot, "%s $walls%" PRId32 " using 1:2 with lines lw 2 lc rgb colour[%" PRId32 "] title '%s'",
                    lines++ > 0 ? "," : "", board, board % COLOURS + 1, summary->room->board[board].name);
    end_plot(plot, lines);
}

static void plot_times(FILE *plot, const run_summary_t *summary)
{
    begin_plot(plot, summary, "time.svg", "420,270");
    fputs("set ylabel 'ms a step' tc rgb '#9aa8bd'\nset yrange [0:*]\nplot", plot);
    for (int32_t board = 0; board < summary->record->boards; board++)
        fprintf(plot, "%s $walls%" PRId32 " using 1:3 with lines lw 1.5 lc rgb colour[%" PRId32 "] title '%s'",
                board > 0 ? "," : "", board, board % COLOURS + 1, summary->room->board[board].name);
    end_plot(plot, summary->record->boards);
}

static void plot_bus(FILE *plot, const run_summary_t *summary)
{
    begin_plot(plot, summary, "bus.svg", "420,270");
    fputs("set ylabel 'load, %' tc rgb '#9aa8bd'\nset yrange [0:*]\n"
          "plot $bus using 1:2 with steps lw 1.5 lc rgb colour[7] title 'bus load from frame to frame'\n",
          plot);
}

bool plots_write(const run_summary_t *summary, char error[FILE_ERROR_LENGTH])
{
    if (summary->record->frames == 0)
        return true;
    FILE *plot = popen("command -v gnuplot >/dev/null || exit 127; exec gnuplot", "w");
    if (plot == NULL)
        return file_error(error, "gnuplot", "can't be started");
    void (*const before)(int) = signal(SIGPIPE, SIG_IGN); /* it may not be there to read */
    fputs(style, plot);
    fprintf(plot, "set xrange [0:%.6f]\n", seconds(summary, summary->record->frames - 1) + 0.5 / summary->rate_hz);
    print_data(plot, summary);
    if (summary->record->psnrs > 0)
        plot_truth(plot, summary, "psnr.svg", RUN_DB_PSNR);
    if (summary->record->psnrs > 0 && summary->original_name != NULL)
        plot_truth(plot, summary, "psnr_original.svg", RUN_DB_ORIGINAL_PSNR);
    plot_steps(plot, summary);
    plot_times(plot, summary);
    plot_bus(plot, summary);
    const int status = pclose(plot);
    signal(SIGPIPE, before);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
        return file_error(error, "gnuplot", "is not installed, so the plots are missing: apt-get install gnuplot-nox");
    return file_error(error, "gnuplot", "has failed, so plots are missing: see its message above");
}
