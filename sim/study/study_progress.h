// SPDX-License-Identifier: Apache-2.0
// How far a study is, and how long it will still take, on stderr.
#ifndef SIM_STUDY_STUDY_PROGRESS_H
#define SIM_STUDY_STUDY_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/study/study_run.h"

/** What study_standard_work() takes on the machine on which the table of experiments was timed, seconds. */
static const double study_standard_s = 0.265;

typedef struct {
    const study_options_t *options;
    int current;        /**< index of the running experiment */
    double machine;     /**< time here over time on the table's machine */
    int64_t started_us; /**< the running experiment */
    int64_t call_us;    /**< its running study_parallel() */
    bool terminal;      /**< stderr is one: rewrite one line */
} study_progress_t;

/** Begin. @param standard_s  How long the standard piece of work took here. */
void study_progress_begin(study_progress_t *progress, const study_options_t *options, double standard_s);

/** The next experiment begins. Prints a line where stderr is no terminal. */
void study_progress_next(study_progress_t *progress, int current);

/** done of count pieces of the running study_parallel() are finished. Rewrites the line of a terminal. */
void study_progress_show(const study_progress_t *progress, int32_t done, int32_t count);

/** All is done: clears the line of a terminal. */
void study_progress_end(const study_progress_t *progress);

/**
 * The seconds that are left: what the table says for all that follows, and for the running experiment the longer of
 * what the table leaves it and what the pace of its running call promises.
 */
double study_progress_left_s(const study_progress_t *progress, int64_t now_us, int32_t done, int32_t count);

#endif
