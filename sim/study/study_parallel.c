// SPDX-License-Identifier: Apache-2.0
// A study's work on all cores, and the piece of it that measures the machine.
#include <errno.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/study/study_internal.h"
#include "sim/study/study_scene.h"

enum { MAX_THREADS = 256, SHOW_EVERY_NS = 100000000, NS_PER_S = 1000000000, STANDARD_TASKS = 16 };

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

/* A corrected panel and its PSNR: what most experiments spend their time on. */
static void standard_task(void *context, int32_t index)
{
    study_t *study = context;
    const study_sizes_t sizes = {480, 270, 480, 270};
    study_scene_t scene;
    image_t picture, panel;
    char error[FILE_ERROR_LENGTH];
    mesh_t mesh;
    homography_t homography;
    double_homography_t seen;
    const pose_t pose = study_pose(3 * index);
    study_scene(&scene, &sizes);
    warp_t *warp = malloc(sizeof *warp);
    if (warp == NULL || !study_image(STUDY_NOISE, 480, 270, 1, &picture, NULL)) {
        study_fail(study, "out of memory");
        free(warp);
        return;
    }
    if (homography_from_pose(&homography, &scene.camera, &scene.wall, &pose) &&
        study_image(STUDY_NOISE, 480, 270, 1, &panel, NULL)) {
        study_warp(warp, warp_method_default(), &homography, &picture, &panel);
        double_homography_from_fixed(&seen, &homography);
        if (mesh_sample(&mesh, &seen, &picture, 4, error))
            mesh_free(&mesh);
        free(panel.data);
    }
    free(picture.data);
    free(warp);
}

double study_standard_work(study_t *study)
{
    const int64_t began_us = sim_clock_monotonic_us();
    study_parallel(study, STANDARD_TASKS, standard_task, study);
    return (double)(sim_clock_monotonic_us() - began_us) / 1e6;
}
