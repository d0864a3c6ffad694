// SPDX-License-Identifier: Apache-2.0
// The workers (hal/hal_workers.h) as POSIX threads; the simulator has them too.
#include <pthread.h>
#include <sched.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/hal_workers.h"

typedef struct {
    hal_workers_t *all;
    int32_t part;
    pthread_t thread;
} helper_t;

/* Under the mutex: everything but settings and the helpers' own parts. */
struct hal_workers {
    hal_workers_settings_t settings;
    helper_t helper[HAL_WORKERS_MAX]; /* [0] is the thread that opened them, and not used */
    int32_t started;                  /* threads, the first one included */
    pthread_mutex_t mutex;
    pthread_cond_t begin, end;
    uint64_t run;    /* counts them */
    int32_t working; /* helpers that have not ended the present run */
    bool closing;
    hal_work_fn *work;
    void *context;
};

static hal_status_t refused(char error[HAL_WORKERS_ERROR_LENGTH], hal_status_t status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static hal_status_t refused(char error[HAL_WORKERS_ERROR_LENGTH], hal_status_t status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error, HAL_WORKERS_ERROR_LENGTH, format, arguments);
    va_end(arguments);
    return status;
}

static void *help(void *context)
{
    const helper_t *helper = context;
    hal_workers_t *w = helper->all;
    uint64_t done = 0;
    pthread_mutex_lock(&w->mutex);
    while (true) {
        while (w->run == done && !w->closing)
            pthread_cond_wait(&w->begin, &w->mutex);
        if (w->closing)
            break;
        done = w->run;
        pthread_mutex_unlock(&w->mutex);
        w->work(w->context, helper->part, w->settings.count);
        pthread_mutex_lock(&w->mutex);
        if (--w->working == 0)
            pthread_cond_signal(&w->end);
    }
    pthread_mutex_unlock(&w->mutex);
    return NULL;
}

/* Pin a thread and give it its priority, as the settings want. */
static hal_status_t schedule(const hal_workers_settings_t *settings, int32_t part, pthread_t thread,
                             char error[HAL_WORKERS_ERROR_LENGTH])
{
    if (settings->first_core != HAL_WORKERS_ANY_CORE) {
        cpu_set_t cores;
        CPU_ZERO(&cores);
        CPU_SET((unsigned)(settings->first_core + part), &cores);
        const int failure = pthread_setaffinity_np(thread, sizeof cores, &cores);
        if (failure != 0)
            return refused(error, HAL_IO,
                           "workers: can't pin worker %d to core %d: %s; choose cores that this board has and this "
                           "process may use",
                           part, settings->first_core + part, strerror(failure));
    }
    if (settings->priority != 0) {
        const struct sched_param param = {.sched_priority = settings->priority};
        const int failure = pthread_setschedparam(thread, SCHED_FIFO, &param);
        if (failure != 0)
            return refused(
                error, HAL_IO,
                "workers: can't give worker %d real-time priority %d: %s; run with CAP_SYS_NICE or without a priority",
                part, settings->priority, strerror(failure));
    }
    return HAL_OK;
}

static hal_status_t start(hal_workers_t *w, char error[HAL_WORKERS_ERROR_LENGTH])
{
    for (int32_t part = 1; part < w->settings.count; part++) {
        helper_t *helper = &w->helper[part];
        *helper = (helper_t){.all = w, .part = part};
        const int failure = pthread_create(&helper->thread, NULL, help, helper);
        if (failure != 0)
            return refused(error, HAL_IO, "workers: can't start worker %d: %s", part, strerror(failure));
        w->started++;
        const hal_status_t status = schedule(&w->settings, part, helper->thread, error);
        if (status != HAL_OK)
            return status;
    }
    return schedule(&w->settings, 0, pthread_self(), error);
}

hal_status_t hal_workers_open(hal_workers_t **workers, const hal_workers_settings_t *settings,
                              char error[HAL_WORKERS_ERROR_LENGTH])
{
    if (settings->count < 1 || settings->count > HAL_WORKERS_MAX)
        return refused(error, HAL_BAD_CALL, "workers: found %d, expected 1 to %d", settings->count, HAL_WORKERS_MAX);
    if (settings->first_core < HAL_WORKERS_ANY_CORE || settings->first_core > CPU_SETSIZE - settings->count)
        return refused(error, HAL_BAD_CALL, "workers: first core %d, expected 0 to %d, or %d for any",
                       settings->first_core, CPU_SETSIZE - settings->count, HAL_WORKERS_ANY_CORE);
    if (settings->priority < 0 || settings->priority > 99)
        return refused(error, HAL_BAD_CALL, "workers: priority %d, expected 1 to 99, or 0 for none",
                       settings->priority);
    hal_workers_t *w = calloc(1, sizeof *w);
    if (w == NULL)
        return refused(error, HAL_IO, "workers: out of memory");
    w->settings = *settings;
    w->started = 1;
    pthread_mutex_init(&w->mutex, NULL);
    pthread_cond_init(&w->begin, NULL);
    pthread_cond_init(&w->end, NULL);
    const hal_status_t status = start(w, error);
    if (status != HAL_OK) {
        hal_workers_close(w);
        return status;
    }
    *workers = w;
    return HAL_OK;
}

void hal_workers_run(hal_workers_t *w, hal_work_fn *work, void *context)
{
    if (w == NULL || w->settings.count == 1) {
        work(context, 0, 1);
        return;
    }
    pthread_mutex_lock(&w->mutex);
    w->work = work;
    w->context = context;
    w->working = w->settings.count - 1;
    w->run++;
    pthread_cond_broadcast(&w->begin);
    pthread_mutex_unlock(&w->mutex);
    work(context, 0, w->settings.count);
    pthread_mutex_lock(&w->mutex);
    while (w->working > 0)
        pthread_cond_wait(&w->end, &w->mutex);
    pthread_mutex_unlock(&w->mutex);
}

void hal_workers_close(hal_workers_t *w)
{
    if (w == NULL)
        return;
    pthread_mutex_lock(&w->mutex);
    w->closing = true;
    pthread_cond_broadcast(&w->begin);
    pthread_mutex_unlock(&w->mutex);
    for (int32_t part = 1; part < w->started; part++)
        pthread_join(w->helper[part].thread, NULL);
    pthread_cond_destroy(&w->end);
    pthread_cond_destroy(&w->begin);
    pthread_mutex_destroy(&w->mutex);
    free(w);
}
