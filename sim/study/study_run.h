// SPDX-License-Identifier: Apache-2.0
// One run of a list of experiments, from an empty folder to its page.
#ifndef SIM_STUDY_STUDY_RUN_H
#define SIM_STUDY_STUDY_RUN_H

#include "sim/study/study.h"

typedef void study_experiment_fn(study_t *study);

/** One row of the table of experiments. */
typedef struct {
    const char *name; /**< as progress and --only call it: "fig 10" */
    study_experiment_fn *run;
    double quick_s, full_s; /**< how long it takes on the machine of study_standard_s (study_progress.h), seconds */
} study_experiment_t;

typedef struct {
    const char *folder; /**< made if it is missing */
    bool quick;
    const study_experiment_t *experiment; /**< in the order of the page */
    int experiments;
} study_options_t;

/**
 * Run the experiments one after the other and write FOLDER/index.html. An old page there is deleted first, so that a
 * failed run leaves none. Progress, and how long it will take, goes to stderr. Uses the heap and threads.
 *
 * @param[out] error  On failure: one line, the first thing that went wrong.
 */
bool study_run(const study_options_t *options, char error[FILE_ERROR_LENGTH]);

#endif
