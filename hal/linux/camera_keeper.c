// SPDX-License-Identifier: Apache-2.0
// The thread that holds a camera open: see the header.
#include "hal/linux/camera_keeper.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "hal/linux/camera_clock.h"

enum { NAME_LENGTH = 160 };

struct hal_camera {
    const camera_source_t *source;
    void *device; /* of the source */
    camera_exchange_t exchange;
    char name[NAME_LENGTH];
    camera_told_t told;
    int wake;
    atomic_bool closing;
    pthread_t thread;
    pthread_mutex_t mutex; /* of the three below: how the first attempt ended */
    pthread_cond_t tried;
    bool has_tried, has_opened;
    char first_error[HAL_BOARD_ERROR_LENGTH];
};

static void poke(const hal_camera_t *camera)
{
    const uint64_t one = 1;
    /* It fails only when so many pokes wait already that the thread wakes anyway. */
    if (write(camera->wake, &one, sizeof one) < 0)
        return;
}

static void tell_first(hal_camera_t *camera, bool opened, const char *error)
{
    pthread_mutex_lock(&camera->mutex);
    camera->has_tried = true;
    camera->has_opened = opened;
    (void)snprintf(camera->first_error, sizeof camera->first_error, "%s", error);
    pthread_cond_signal(&camera->tried);
    pthread_mutex_unlock(&camera->mutex);
}

static void wait_to_retry(hal_camera_t *camera)
{
    const int64_t until_us = camera_now_us() + CAMERA_RETRY_MS * 1000;
    int64_t left_us = CAMERA_RETRY_MS * 1000;
    while (left_us > 0 && !atomic_load(&camera->closing)) {
        struct pollfd woken = {.fd = camera->wake, .events = POLLIN};
        uint64_t pokes;
        if (poll(&woken, 1, (int)((left_us + 999) / 1000)) > 0 && read(camera->wake, &pokes, sizeof pokes) < 0)
            return;
        left_us = until_us - camera_now_us();
    }
}

/* Until the device is lost, or the camera is closed. */
static void serve(hal_camera_t *camera)
{
    bool good = true;
    while (good && !atomic_load(&camera->closing)) {
        char news[HAL_BOARD_ERROR_LENGTH] = "";
        good = camera->source->serve(camera->device, news);
        if (news[0] != '\0')
            (void)camera_tell(&camera->told, camera->name, news);
        else if (camera->told.line[0] != '\0' && camera_exchange_is_here(&camera->exchange))
            (void)camera_tell(&camera->told, camera->name, "delivers pictures again");
    }
    camera_exchange_withdraw(&camera->exchange);
    camera->source->close(camera->device);
}

static void *keep(void *context)
{
    hal_camera_t *camera = context;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    const bool opened = camera->source->open(camera->device, error);
    tell_first(camera, opened, error);
    if (!opened)
        return NULL;
    serve(camera);
    wait_to_retry(camera);
    while (!atomic_load(&camera->closing)) {
        if (camera->source->open(camera->device, error))
            serve(camera);
        else
            (void)camera_tell(&camera->told, camera->name, error);
        wait_to_retry(camera);
    }
    return NULL;
}

/* On any core, of its own priority: a thread begins with those of the one that makes it, which may be the loop. */
static int start_thread(hal_camera_t *camera, int32_t priority)
{
    pthread_attr_t attributes;
    const struct sched_param param = {.sched_priority = priority};
    cpu_set_t every_core;
    memset(&every_core, 0xFF, sizeof every_core);
    sigset_t all, before;
    sigfillset(&all);
    int failure = pthread_attr_init(&attributes);
    if (failure != 0)
        return failure;
    pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attributes, priority == 0 ? SCHED_OTHER : SCHED_FIFO);
    failure = pthread_attr_setschedparam(&attributes, &param);
    pthread_attr_setaffinity_np(&attributes, sizeof every_core, &every_core);
    pthread_sigmask(SIG_SETMASK, &all, &before); /* signals are the main thread's; libraries' threads come from ours */
    if (failure == 0)
        failure = pthread_create(&camera->thread, &attributes, keep, camera);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    if (failure == 0)
        (void)pthread_setname_np(camera->thread, "camera");
    return failure;
}

static void free_camera(hal_camera_t *camera)
{
    if (camera->device != NULL)
        camera->source->destroy(camera->device);
    camera_exchange_end(&camera->exchange);
    pthread_cond_destroy(&camera->tried);
    pthread_mutex_destroy(&camera->mutex);
    close(camera->wake);
    free(camera);
}

/* @return Everything but the thread, or NULL. */
static hal_camera_t *make_camera(const camera_settings_t *settings, const camera_name_t *parsed,
                                 const camera_source_t *source)
{
    hal_camera_t *camera = calloc(1, sizeof *camera);
    if (camera == NULL)
        return NULL;
    camera->wake = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (camera->wake < 0 || !camera_exchange_init(&camera->exchange)) {
        if (camera->wake >= 0)
            close(camera->wake);
        free(camera);
        return NULL;
    }
    pthread_mutex_init(&camera->mutex, NULL);
    pthread_cond_init(&camera->tried, NULL);
    camera->source = source;
    (void)snprintf(camera->name, sizeof camera->name, "%s", settings->name);
    const camera_wanted_t wanted = {
        *parsed,           settings->width, settings->height, settings->rate_frames, settings->rate_seconds,
        &camera->exchange, camera->wake};
    camera->device = source->create(&wanted);
    if (camera->device == NULL) {
        free_camera(camera);
        return NULL;
    }
    return camera;
}

hal_status_t camera_keeper_open(hal_camera_t **camera, const camera_settings_t *settings, const camera_name_t *parsed,
                                const camera_source_t *source, char error[HAL_BOARD_ERROR_LENGTH])
{
    hal_camera_t *made = make_camera(settings, parsed, source);
    if (made == NULL) {
        (void)camera_fail(error, "camera %s: no memory or no file handle left for it; close other programs",
                          settings->name);
        return HAL_IO;
    }
    const int failure = start_thread(made, settings->priority);
    if (failure != 0) {
        (void)camera_fail(error,
                          "camera %s: can't start its thread with real-time priority %d: %s; run with "
                          "CAP_SYS_NICE or without a priority",
                          settings->name, settings->priority, strerror(failure));
        free_camera(made);
        return HAL_IO;
    }
    pthread_mutex_lock(&made->mutex);
    while (!made->has_tried)
        pthread_cond_wait(&made->tried, &made->mutex);
    const bool opened = made->has_opened;
    pthread_mutex_unlock(&made->mutex);
    if (!opened) {
        pthread_join(made->thread, NULL);
        (void)camera_fail(error, "camera %.80s: %.160s", settings->name, made->first_error);
        free_camera(made);
        return HAL_IO;
    }
    *camera = made;
    return HAL_OK;
}

void camera_keeper_close(hal_camera_t *camera)
{
    if (camera == NULL)
        return;
    atomic_store(&camera->closing, true);
    poke(camera);
    pthread_join(camera->thread, NULL);
    free_camera(camera);
}

hal_status_t hal_camera_take(hal_camera_t *camera, hal_camera_frame_t *frame)
{
    return camera_exchange_take(&camera->exchange, frame);
}

void hal_camera_release(hal_camera_t *camera, const hal_camera_frame_t *frame)
{
    camera_exchange_release(&camera->exchange, frame);
    poke(camera);
}
