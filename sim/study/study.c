// SPDX-License-Identifier: Apache-2.0
// A study: its settings, its first failure, its files and its run.
#include "sim/study/study.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/files/folder.h"
#include "sim/files/gnuplot.h"
#include "sim/study/study_internal.h"

bool study_quick(const study_t *study)
{
    return study->options.quick;
}

bool study_failed(const study_t *study)
{
    return atomic_load(&study->failed);
}

void study_fail(study_t *study, const char *format, ...)
{
    pthread_mutex_lock(&study->lock);
    if (!study_failed(study)) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(study->error, FILE_ERROR_LENGTH, format, arguments);
        va_end(arguments);
        atomic_store(&study->failed, true);
    }
    pthread_mutex_unlock(&study->lock);
}

void *study_memory(study_t *study, size_t size)
{
    void *memory = study_failed(study) ? NULL : calloc(1, size);
    if (memory == NULL)
        study_fail(study, "out of memory");
    return memory;
}

study_verdict_t study_verdict(int64_t held, int64_t cases)
{
    return held == 0 ? STUDY_FAILS : held < cases ? STUDY_PARTLY : STUDY_HOLDS;
}

const char *study_path(study_t *study, const char *name, char path[FILE_ERROR_LENGTH])
{
    const int length = snprintf(path, FILE_ERROR_LENGTH, "%s/%s", study->options.folder, name);
    if (length >= 0 && length < FILE_ERROR_LENGTH)
        return path;
    study_fail(study, "%.100s...: the name is too long, expected at most %d bytes with %s", study->options.folder,
               FILE_ERROR_LENGTH - 1, name);
    return NULL;
}

FILE *study_csv_begin(study_t *study, const char *name, const char *header)
{
    char error[FILE_ERROR_LENGTH];
    if (study_failed(study))
        return study->nowhere;
    FILE *csv = folder_create_file(study->options.folder, name, error);
    if (csv == NULL) {
        study_fail(study, "%s", error);
        return study->nowhere;
    }
    fprintf(csv, "%s\n", header);
    return csv;
}

void study_csv_end(study_t *study, FILE *csv)
{
    char error[FILE_ERROR_LENGTH];
    if (csv != study->nowhere && !folder_close_file(csv, study->options.folder, error))
        study_fail(study, "%s", error);
}

static bool gnuplot_is_there(char error[FILE_ERROR_LENGTH])
{
    gnuplot_t plot;
    return gnuplot_open(&plot, error) && gnuplot_close(&plot, error);
}

/* The folder, without the page of an earlier study. */
static bool make_folder(study_t *study, char error[FILE_ERROR_LENGTH])
{
    char path[FILE_ERROR_LENGTH];
    if (!folder_make(study->options.folder, error) || study_path(study, "index.html", path) == NULL)
        return false;
    if (unlink(path) == 0 || errno == ENOENT)
        return true;
    return file_error(error, path, "the old page can't be deleted: %s", strerror(errno));
}

static void run_all(study_t *study)
{
    const double standard_s = study_standard_work(study);
    study_progress_begin(&study->progress, &study->options, standard_s);
    for (int e = 0; e < study->options.experiments && !study_failed(study); e++) {
        study_progress_next(&study->progress, e);
        study->options.experiment[e].run(study);
    }
    study_progress_end(&study->progress);
}

bool study_run(const study_options_t *options, char error[FILE_ERROR_LENGTH])
{
    study_t study = {.options = *options, .lock = PTHREAD_MUTEX_INITIALIZER};
    char reason[FILE_ERROR_LENGTH] = "";
    study_page_open(&study);
    study.nowhere = fopen("/dev/null", "wb");
    if (study.nowhere == NULL)
        study_fail(&study, "/dev/null: %s", strerror(errno));
    if (!make_folder(&study, reason) || !gnuplot_is_there(reason))
        study_fail(&study, "%s", reason);
    if (!study_failed(&study))
        run_all(&study);
    study_page_write(&study);
    study_page_close(&study);
    if (study.nowhere != NULL)
        fclose(study.nowhere);
    pthread_mutex_destroy(&study.lock);
    if (!study_failed(&study))
        return true;
    memcpy(error, study.error, FILE_ERROR_LENGTH);
    return false;
}
