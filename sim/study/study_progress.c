// SPDX-License-Identifier: Apache-2.0
// How far a study is, and how long it will still take, on stderr.
#include "sim/study/study_progress.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"

enum { DURATION_LENGTH = 32 };

static double cost_s(const study_progress_t *progress, int experiment)
{
    const study_experiment_t *row = &progress->options->experiment[experiment];
    return progress->machine * (progress->options->quick ? row->quick_s : row->full_s);
}

double study_progress_left_s(const study_progress_t *progress, int64_t now_us, int32_t done, int32_t count)
{
    const double table_s = cost_s(progress, progress->current) - (double)(now_us - progress->started_us) / 1e6;
    const double pace_s = done > 0 ? (double)(now_us - progress->call_us) / 1e6 * (count - done) / done : 0.0;
    double left_s = fmax(fmax(table_s, pace_s), 0.0);
    for (int e = progress->current + 1; e < progress->options->experiments; e++)
        left_s += cost_s(progress, e);
    return left_s;
}

static void print_duration(char text[DURATION_LENGTH], double seconds)
{
    const int minutes = (int)lround(seconds / 60.0);
    if (seconds < 90.0)
        snprintf(text, DURATION_LENGTH, "%d s", (int)ceil(seconds));
    else if (minutes < 90)
        snprintf(text, DURATION_LENGTH, "%d min", minutes);
    else
        snprintf(text, DURATION_LENGTH, "%d h %02d min", minutes / 60, minutes % 60);
}

void study_progress_begin(study_progress_t *progress, const study_options_t *options, double standard_s)
{
    *progress = (study_progress_t){
        .options = options, .machine = standard_s / study_standard_s, .terminal = isatty(STDERR_FILENO) == 1};
    double all_s = 0.0;
    for (int e = 0; e < options->experiments; e++)
        all_s += cost_s(progress, e);
    char text[DURATION_LENGTH];
    print_duration(text, all_s);
    fprintf(stderr, "%d experiments, about %s on this machine\n", options->experiments, text);
}

void study_progress_next(study_progress_t *progress, int current)
{
    progress->current = current;
    progress->started_us = progress->call_us = sim_clock_monotonic_us();
    study_progress_show(progress, 0, 0);
    if (progress->terminal)
        return;
    char text[DURATION_LENGTH];
    print_duration(text, study_progress_left_s(progress, progress->started_us, 0, 0));
    fprintf(stderr, "[%d/%d] %s, about %s left\n", current + 1, progress->options->experiments,
            progress->options->experiment[current].name, text);
}

void study_progress_show(const study_progress_t *progress, int32_t done, int32_t count)
{
    if (!progress->terminal)
        return;
    char text[DURATION_LENGTH], pieces[64] = "";
    print_duration(text, study_progress_left_s(progress, sim_clock_monotonic_us(), done, count));
    if (count > 0)
        snprintf(pieces, sizeof pieces, ": %d of %d", done, count);
    fprintf(stderr, "\r\033[K[%d/%d] %s%s, about %s left", progress->current + 1, progress->options->experiments,
            progress->options->experiment[progress->current].name, pieces, text);
}

void study_progress_end(const study_progress_t *progress)
{
    if (progress->terminal)
        fputs("\r\033[K", stderr);
}
