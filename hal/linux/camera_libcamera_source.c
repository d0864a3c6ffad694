// SPDX-License-Identifier: Apache-2.0
// Video through libcamera: see the header.
#include "hal/linux/camera_libcamera_source.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_libcamera_choice.h"
#include "hal/linux/camera_unplugged.h"

enum { POLL_MS = 500, LOST_US = 5000000, BUFFERS_MIN = 4 /* some pipelines have no more */ };

/* From the library's threads to ours. */
typedef struct {
    pthread_mutex_t mutex; /* of all below */
    int filled[CAMERA_BUFFERS_MAX];
    int count;
    bool gone; /* unplugged, as the library says */
} events_t;

typedef struct {
    camera_wanted_t wanted;
    events_t events;
    libcamera_session_t *session; /* NULL: closed */
    camera_places_t places;       /* of its devices */
    bool stuck;                   /* unplugged, and the library does not know */
    bool back;                    /* plugged in again after that */
    libcamera_buffer_t buffer[CAMERA_BUFFERS_MAX];
    picture_t picture;  /* without data */
    int64_t picture_us; /* when the last one came, or the device began */
} device_t;

static void wake(const device_t *device)
{
    const uint64_t one = 1;
    if (write(device->wanted.wake, &one, sizeof one) < 0)
        return; /* so many wait that it wakes anyway */
}

/* ---- on the library's threads ---- */

static void on_filled(void *context, int buffer)
{
    device_t *device = context;
    pthread_mutex_lock(&device->events.mutex);
    if (device->events.count < CAMERA_BUFFERS_MAX)
        device->events.filled[device->events.count++] = buffer;
    pthread_mutex_unlock(&device->events.mutex);
    wake(device);
}

static void on_gone(void *context)
{
    device_t *device = context;
    pthread_mutex_lock(&device->events.mutex);
    device->events.gone = true;
    pthread_mutex_unlock(&device->events.mutex);
    wake(device);
}

/* ---- open ---- */

static bool choose(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const int camera = camera_libcamera_find(device->session, device->wanted.name.which, error);
    if (camera < 0)
        return false;
    int failure = libcamera_acquire(device->session, camera);
    if (failure < 0)
        return camera_fail(error, failure == -EBUSY ? "is used by another program; close that" : "can't be had: %s",
                           strerror(-failure));
    if (!camera_libcamera_fit(device->session, camera, &device->wanted, &device->picture, error))
        return false;
    uint32_t stride = 0;
    failure = libcamera_configure(device->session, &stride);
    if (failure < 0)
        return camera_fail(error, "can't be configured: %s; see LIBCAMERA_LOG_LEVELS=*:DEBUG", strerror(-failure));
    device->picture.stride[0] = device->picture.stride[1] = stride > INT32_MAX ? 0 : (int32_t)stride;
    return picture_is_valid(&device->picture) ||
           camera_fail(error, "gives rows of %u bytes, which no picture has", stride);
}

/* @return How many buffers there are; 0 with the reason. */
static int make_buffers(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const int count = libcamera_make_buffers(device->session, device->buffer, CAMERA_BUFFERS_MAX);
    if (count < BUFFERS_MIN || count > CAMERA_BUFFERS_MAX) {
        (void)camera_fail(error, "has %d buffers, expected %d to %d; give it more memory (cma= of the kernel)",
                          count < 0 ? 0 : count, BUFFERS_MIN, CAMERA_BUFFERS_MAX);
        return 0;
    }
    for (int i = 0; i < count; i++)
        if (!camera_dmabuf_map(device->wanted.exchange, i, device->buffer[i].piece, device->buffer[i].count,
                               &device->picture, error))
            return 0;
    return count;
}

static bool start(device_t *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const camera_wanted_t *wanted = &device->wanted;
    const libcamera_events_t events = {on_filled, on_gone, device};
    const int count = make_buffers(device, error);
    if (count == 0)
        return false;
    const int failure =
        libcamera_start(device->session, &events, (int64_t)1000000 * wanted->rate_seconds / wanted->rate_frames);
    if (failure < 0)
        return camera_fail(error, "does not start: %s; see `dmesg`", strerror(-failure));
    device->picture_us = camera_now_us();
    for (int i = 0; i < count; i++)
        if (libcamera_queue(device->session, i) < 0)
            return camera_fail(error, "does not take its buffers; see LIBCAMERA_LOG_LEVELS=*:DEBUG");
    return true;
}

/* ---- serve ---- */

static bool queue_again(device_t *device, int buffer)
{
    for (size_t i = 0; i < device->buffer[buffer].count; i++)
        camera_dmabuf_end_read(device->buffer[buffer].piece[i].file);
    return libcamera_queue(device->session, buffer) >= 0;
}

/* Hand the picture in a buffer to the loop, or the buffer back to the camera when it has none. */
static bool deliver(device_t *device, int number)
{
    const libcamera_buffer_t *buffer = &device->buffer[number];
    libcamera_result_t result;
    libcamera_result(device->session, number, &result);
    for (size_t i = 0; i < buffer->count; i++)
        camera_dmabuf_begin_read(buffer->piece[i].file);
    if (!result.good)
        return queue_again(device, number);
    hal_camera_frame_t frame = {
        .picture = device->picture,
        .capture_time_us = camera_stamp_us(result.stamp_us, camera_now_us(), camera_clock_us(CLOCK_BOOTTIME)),
        .sequence = result.sequence,
    };
    camera_dmabuf_place(&frame.picture, device->wanted.exchange, number, buffer->piece, buffer->count);
    device->picture_us = camera_now_us();
    const int older = camera_exchange_put(device->wanted.exchange, number, &frame);
    return older == CAMERA_NO_BUFFER || queue_again(device, older);
}

/* @return false when the camera failed. */
static bool serve_once(device_t *device)
{
    int filled[CAMERA_BUFFERS_MAX];
    pthread_mutex_lock(&device->events.mutex);
    const int count = device->events.count;
    memcpy(filled, device->events.filled, sizeof filled);
    device->events.count = 0;
    pthread_mutex_unlock(&device->events.mutex);
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++) {
        const int returned = camera_exchange_collect(device->wanted.exchange);
        if (returned == CAMERA_NO_BUFFER)
            break;
        if (!queue_again(device, returned))
            return false;
    }
    for (int i = 0; i < count; i++)
        if (!deliver(device, filled[i]))
            return false;
    return true;
}

static bool is_gone(device_t *device)
{
    pthread_mutex_lock(&device->events.mutex);
    const bool gone = device->events.gone;
    pthread_mutex_unlock(&device->events.mutex);
    return gone;
}

/* ---- camera_source_t ---- */

static void *create(const camera_wanted_t *wanted)
{
    device_t *device = calloc(1, sizeof *device);
    if (device == NULL)
        return NULL;
    device->wanted = *wanted;
    pthread_mutex_init(&device->events.mutex, NULL);
    return device;
}

/*
 * The library ends the program when it stops a camera that is no longer there, unless its pipeline knows of unplugging:
 * USB's alone does. Such a camera is left as it is.
 */
static void close_device(void *source)
{
    device_t *device = source;
    camera_exchange_withdraw(device->wanted.exchange);
    if (device->session == NULL)
        return;
    if (device->stuck && !is_gone(device)) {
        libcamera_abandon(device->session);
        return;
    }
    libcamera_close(device->session);
    device->session = NULL;
    device->events.count = 0;
    device->events.gone = device->stuck = false;
}

static bool open_device(void *source, char error[HAL_BOARD_ERROR_LENGTH])
{
    device_t *device = source;
    if (!camera_libcamera_start(&device->session, error))
        return false;
    if (!choose(device, error) || !start(device, error)) {
        close_device(device);
        return false;
    }
    camera_places_note(&device->places);
    if (!camera_places_have_usb(&device->places))
        camera_udev_silence(); /* at the news that a sensor is back the library would end the program */
    return true;
}

/* Devices that the library does not know to be gone are kept from it. */
static void notice_unplugging(device_t *device)
{
    device->stuck = camera_unplugged();
    if (device->stuck && !camera_places_have_usb(&device->places))
        camera_unplugged_drop();
}

/* The safe picture is on the wall meanwhile. A new process can have what this one can't; told before it is done. */
static void wait_for_return(device_t *device, char news[HAL_BOARD_ERROR_LENGTH])
{
    if (device->back)
        (void)kill(getpid(), SIGTERM);
    camera_exchange_withdraw(device->wanted.exchange);
    device->back = device->back || camera_places_are_taken(&device->places);
    (void)camera_fail(news, "%s",
                      device->back
                          ? "is back; this program ends, to be started anew by its service, or by you"
                          : "is gone, and libcamera can't have it back; this program ends when it is here again");
}

static bool serve(void *source, char news[HAL_BOARD_ERROR_LENGTH])
{
    device_t *device = source;
    struct pollfd waits = {.fd = device->wanted.wake, .events = POLLIN};
    (void)poll(&waits, 1, POLL_MS);
    camera_wake_clear(device->wanted.wake);
    const bool good = device->stuck || serve_once(device);
    const int64_t silent_us = camera_now_us() - device->picture_us;
    if (is_gone(device))
        return camera_fail(news, "is gone; plug it in again");
    if (!device->stuck && (!good || silent_us > 1000 * POLL_MS))
        notice_unplugging(device);
    if (device->stuck) {
        wait_for_return(device, news);
        return true;
    }
    if (!good)
        return camera_fail(news, "failed; see `dmesg`");
    return silent_us <= LOST_US || camera_fail(news, "gave no picture for %d s; see `dmesg`", LOST_US / 1000000);
}

static void destroy(void *source)
{
    device_t *device = source;
    if (device->stuck)
        return; /* events may still come */
    pthread_mutex_destroy(&device->events.mutex);
    free(device);
}

const camera_source_t camera_libcamera = {create, open_device, serve, close_device, destroy};
