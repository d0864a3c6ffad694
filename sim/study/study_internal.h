// SPDX-License-Identifier: Apache-2.0
// What a study is made of; for the files that implement study.h only.
#ifndef SIM_STUDY_STUDY_INTERNAL_H
#define SIM_STUDY_STUDY_INTERNAL_H

#include <pthread.h>
#include <stdatomic.h>

#include "sim/study/study_progress.h"

/** What the page's parts grow in, until it is written. */
typedef struct {
    FILE *file; /**< open_memstream() */
    char *text; /**< valid after fflush() */
    size_t length;
} study_buffer_t;

struct study {
    study_options_t options;
    study_progress_t progress;
    study_buffer_t contents, headlines, claims, sections;
    int section_count;
    int claims_of[STUDY_VERDICTS]; /**< by verdict */
    bool figures_open;             /**< a row of figures has begun */
    FILE *nowhere;                 /**< takes the rows of CSV files after a failure */
    pthread_mutex_t lock;
    atomic_bool failed;
    char error[FILE_ERROR_LENGTH]; /**< written under lock */
};

/** @return A path in the study's folder: the caller's buffer, or NULL when it is too long (a failure). */
const char *study_path(study_t *study, const char *name, char path[FILE_ERROR_LENGTH]);

/** Open the page's buffers. A failure is the study's. */
void study_page_open(study_t *study);

/** Give back the page's memory. */
void study_page_close(study_t *study);

/** Write FOLDER/index.html. */
void study_page_write(study_t *study);

/** Do the standard piece of work. @return How long it took, seconds. */
double study_standard_work(study_t *study);

#endif
