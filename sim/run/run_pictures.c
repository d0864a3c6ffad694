// SPDX-License-Identifier: Apache-2.0
// Two threads that make and write the pictures of a run while the boards go on; a bounded queue before them.
#include "sim/run/run_pictures.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "sim/devices/sim_picture.h"

typedef enum { JOB_FREE, JOB_BORROWED, JOB_READY, JOB_AT_WORK } job_state_t;

struct run_pictures {
    const run_draw_config_t *config;
    pthread_t thread[RUN_PICTURES_THREADS];
    int threads;
    pthread_mutex_t lock; /**< of everything below but the pixels */
    pthread_cond_t changed;
    run_job_t job[RUN_PICTURES_JOBS];
    job_state_t state[RUN_PICTURES_JOBS];
    run_record_t judged; /**< only its psnr */
    bool over, failed;
    char error[FILE_ERROR_LENGTH];
};

/* The job in that state with the lowest frame number, or -1. */
static int find_job(const run_pictures_t *pictures, job_state_t state)
{
    int found = -1;
    for (int i = 0; i < RUN_PICTURES_JOBS; i++)
        if (pictures->state[i] == state && (found < 0 || pictures->job[i].frame < pictures->job[found].frame))
            found = i;
    return found;
}

static void finish_job(run_pictures_t *pictures, int index, bool ok, const char *error)
{
    if (!ok && !pictures->failed) {
        pictures->failed = true;
        memcpy(pictures->error, error, FILE_ERROR_LENGTH);
    }
    pictures->state[index] = JOB_FREE;
    pthread_cond_broadcast(&pictures->changed);
}

/* Called with the lock held, and gives it back for as long as the job takes. */
static void do_job(run_pictures_t *pictures, int index, const image_t *viewer)
{
    run_psnr_t psnr[ROOM_MAX_BOARDS];
    int32_t psnrs = 0;
    char error[FILE_ERROR_LENGTH] = "out of memory";
    pthread_mutex_unlock(&pictures->lock);
    bool ok = viewer->data != NULL && run_draw(pictures->config, &pictures->job[index], viewer, psnr, &psnrs, error);
    pthread_mutex_lock(&pictures->lock);
    for (int32_t i = 0; ok && i < psnrs; i++)
        ok = run_record_add_psnr(&pictures->judged, &psnr[i]);
    finish_job(pictures, index, ok, error);
}

static void *work(void *context)
{
    run_pictures_t *pictures = context;
    image_t viewer = {.data = NULL};
    (void)run_draw_viewer(&viewer, &pictures->config->room->camera); /* without memory do_job() fails */
    pthread_mutex_lock(&pictures->lock);
    for (;;) {
        const int index = find_job(pictures, JOB_READY);
        if (index >= 0) {
            pictures->state[index] = JOB_AT_WORK;
            do_job(pictures, index, &viewer);
        } else if (pictures->over) {
            break;
        } else {
            pthread_cond_wait(&pictures->changed, &pictures->lock);
        }
    }
    pthread_mutex_unlock(&pictures->lock);
    free(viewer.data);
    return NULL;
}

static bool make_image(image_t *image, int32_t width, int32_t height)
{
    const int32_t stride = width * (int32_t)IMAGE_XRGB8888;
    uint8_t *data = calloc((size_t)height, (size_t)stride);
    *image = (image_t){data, width, height, stride, IMAGE_XRGB8888};
    return data != NULL;
}

static bool make_job(run_job_t *job, const room_t *room)
{
    bool ok = make_image(&job->picture, room->camera.width, room->camera.height);
    for (int32_t i = 0; i < room->board_count; i++)
        ok &= make_image(&job->shown[i], room->board[i].wall.panel_width, room->board[i].wall.panel_height);
    return ok;
}

run_pictures_t *run_pictures_start(const run_draw_config_t *config, char error[FILE_ERROR_LENGTH])
{
    run_pictures_t *pictures = calloc(1, sizeof *pictures);
    bool ok = pictures != NULL;
    if (ok) {
        pictures->config = config;
        pthread_mutex_init(&pictures->lock, NULL);
        pthread_cond_init(&pictures->changed, NULL);
    }
    for (int i = 0; ok && i < RUN_PICTURES_JOBS; i++)
        ok = make_job(&pictures->job[i], config->room);
    while (ok && pictures->threads < RUN_PICTURES_THREADS) {
        ok = pthread_create(&pictures->thread[pictures->threads], NULL, work, pictures) == 0;
        pictures->threads += ok;
    }
    if (ok)
        return pictures;
    run_record_t none = {.boards = 0};
    (void)run_pictures_finish(pictures, &none, error);
    run_record_free(&none);
    file_error(error, "pictures", "out of memory");
    return NULL;
}

bool run_pictures_ready(run_pictures_t *pictures)
{
    pthread_mutex_lock(&pictures->lock);
    const bool ready = pictures->failed || find_job(pictures, JOB_FREE) >= 0;
    pthread_mutex_unlock(&pictures->lock);
    return ready;
}

run_job_t *run_pictures_borrow(run_pictures_t *pictures)
{
    run_job_t *job = NULL;
    pthread_mutex_lock(&pictures->lock);
    while (!pictures->failed && job == NULL) {
        const int index = find_job(pictures, JOB_FREE);
        if (index >= 0) {
            pictures->state[index] = JOB_BORROWED;
            job = &pictures->job[index];
        } else {
            pthread_cond_wait(&pictures->changed, &pictures->lock);
        }
    }
    pthread_mutex_unlock(&pictures->lock);
    return job;
}

void run_pictures_submit(run_pictures_t *pictures, run_job_t *job)
{
    pthread_mutex_lock(&pictures->lock);
    pictures->state[job - pictures->job] = JOB_READY;
    pthread_cond_broadcast(&pictures->changed);
    pthread_mutex_unlock(&pictures->lock);
}

static void free_jobs(run_pictures_t *pictures)
{
    for (int i = 0; i < RUN_PICTURES_JOBS; i++) {
        free(pictures->job[i].picture.data);
        for (int b = 0; b < ROOM_MAX_BOARDS; b++)
            free(pictures->job[i].shown[b].data);
    }
}

bool run_pictures_finish(run_pictures_t *pictures, run_record_t *record, char error[FILE_ERROR_LENGTH])
{
    if (pictures == NULL)
        return true;
    pthread_mutex_lock(&pictures->lock);
    pictures->over = true;
    pthread_cond_broadcast(&pictures->changed);
    pthread_mutex_unlock(&pictures->lock);
    for (int i = 0; i < pictures->threads; i++)
        pthread_join(pictures->thread[i], NULL);
    bool ok = !pictures->failed;
    if (!ok)
        memcpy(error, pictures->error, FILE_ERROR_LENGTH);
    for (int32_t i = 0; ok && i < pictures->judged.psnrs; i++)
        if (!run_record_add_psnr(record, &pictures->judged.psnr[i]))
            ok = file_error(error, "pictures", "out of memory");
    run_record_sort(record);
    run_record_free(&pictures->judged);
    free_jobs(pictures);
    pthread_mutex_destroy(&pictures->lock);
    pthread_cond_destroy(&pictures->changed);
    free(pictures);
    return ok;
}

void run_pictures_copy(const image_t *to, const picture_t *from)
{
    if (from != NULL)
        sim_picture_to_xrgb(to, from);
    for (int32_t y = 0; from == NULL && y < to->height; y++)
        memset(image_row(to, y), 0, (size_t)to->width * IMAGE_XRGB8888);
}
