// SPDX-License-Identifier: Apache-2.0
// A study's work on all cores.
#include <errno.h>
#include <time.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"
#include "sim/study/study_internal.h"

enum { MAX_THREADS = 256, SHOW_EVERY_NS = 100000000, NS_PER_S = 1000000000 };

/* What the threads of one call share. */
typedef struct {
    study_t *study;
    study_task_fn *task;
    void *context;
    int32_t count;
    atomic_int_fast32_t next, done;
} crew_t;

static void *work(void *shared)
{
    crew_t *crew = shared;
    while (!study_failed(crew->study)) {
        const int_fast32_t index = atomic_fetch_add(&crew->next, 1);
        if (index >= crew->count)
            break;
        crew->task(crew->context, (int32_t)index);
        atomic_fetch_add(&crew->done, 1);
    }
    return NULL;
}

static void wait_for(pthread_t thread, crew_t *crew)
{
    for (;;) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += SHOW_EVERY_NS;
        if (until.tv_nsec >= NS_PER_S) {
            until.tv_nsec -= NS_PER_S;
            until.tv_sec++;
        }
        if (pthread_timedjoin_np(thread, NULL, &until) != ETIMEDOUT)
            return;
        study_progress_show(&crew->study->progress, (int32_t)atomic_load(&crew->done), crew->count);
    }
}

void study_parallel(study_t *study, int32_t count, study_task_fn *task, void *context)
{
    crew_t crew = {.study = study, .task = task, .context = context, .count = count};
    pthread_t thread[MAX_THREADS];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    study->progress.call_us = sim_clock_monotonic_us();
    while (started < cores && started < count && started < MAX_THREADS &&
           pthread_create(&thread[started], NULL, work, &crew) == 0)
        started++;
    if (started == 0)
        work(&crew); /* no thread to be had: this one will do */
    for (int t = 0; t < started; t++)
        wait_for(thread[t], &crew);
}
