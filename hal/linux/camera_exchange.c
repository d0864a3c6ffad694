// SPDX-License-Identifier: Apache-2.0
// Hands pictures from the thread that captures them to the firmware's loop, and back: see the header.
#include "hal/linux/camera_exchange.h"

#include <assert.h>
#include <string.h>
#include <sys/mman.h>

bool camera_exchange_init(camera_exchange_t *exchange)
{
    *exchange = (camera_exchange_t){.here = false};
    pthread_mutexattr_t attributes;
    if (pthread_mutexattr_init(&attributes) != 0)
        return false;
    const bool done = pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT) == 0 &&
                      pthread_mutex_init(&exchange->mutex, &attributes) == 0;
    pthread_mutexattr_destroy(&attributes);
    return done;
}

static void unmap(camera_buffer_t *buffer)
{
    for (int plane = 0; plane < PICTURE_MAX_PLANES; plane++)
        if (buffer->map[plane].length != 0)
            (void)munmap(buffer->map[plane].address, buffer->map[plane].length);
    *buffer = (camera_buffer_t){.state = CAMERA_BUFFER_AWAY};
}

void camera_exchange_end(camera_exchange_t *exchange)
{
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++)
        unmap(&exchange->buffer[i]);
    for (int i = 0; i < HAL_CAMERA_LENT; i++)
        unmap(&exchange->kept[i]);
    pthread_mutex_destroy(&exchange->mutex);
}

static int find(const camera_buffer_t *buffers, int count, camera_buffer_state_t state)
{
    for (int i = 0; i < count; i++)
        if (buffers[i].state == state)
            return i;
    return CAMERA_NO_BUFFER;
}

static int count_lent(const camera_exchange_t *exchange)
{
    int lent = 0;
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++)
        lent += exchange->buffer[i].state == CAMERA_BUFFER_LENT;
    for (int i = 0; i < HAL_CAMERA_LENT; i++)
        lent += exchange->kept[i].state == CAMERA_BUFFER_LENT;
    return lent;
}

hal_status_t camera_exchange_take(camera_exchange_t *exchange, hal_camera_frame_t *frame)
{
    hal_status_t status = HAL_IO;
    pthread_mutex_lock(&exchange->mutex);
    if (exchange->here) {
        const int newest = find(exchange->buffer, CAMERA_BUFFERS_MAX, CAMERA_BUFFER_READY);
        if (count_lent(exchange) >= HAL_CAMERA_LENT) {
            status = HAL_FULL;
        } else if (newest == CAMERA_NO_BUFFER) {
            status = HAL_EMPTY;
        } else {
            exchange->buffer[newest].state = CAMERA_BUFFER_LENT;
            *frame = exchange->buffer[newest].frame;
            status = HAL_OK;
        }
    }
    pthread_mutex_unlock(&exchange->mutex);
    return status;
}

static bool give_back(camera_buffer_t *buffers, int count, const hal_camera_frame_t *frame)
{
    for (int i = 0; i < count; i++) {
        if (buffers[i].state == CAMERA_BUFFER_LENT && buffers[i].frame.picture.data[0] == frame->picture.data[0]) {
            buffers[i].state = CAMERA_BUFFER_RETURNED;
            return true;
        }
    }
    return false;
}

void camera_exchange_release(camera_exchange_t *exchange, const hal_camera_frame_t *frame)
{
    pthread_mutex_lock(&exchange->mutex);
    const bool was_lent =
        give_back(exchange->buffer, CAMERA_BUFFERS_MAX, frame) || give_back(exchange->kept, HAL_CAMERA_LENT, frame);
    pthread_mutex_unlock(&exchange->mutex);
    assert(was_lent);
    (void)was_lent;
}

bool camera_exchange_is_here(camera_exchange_t *exchange)
{
    pthread_mutex_lock(&exchange->mutex);
    const bool here = exchange->here;
    pthread_mutex_unlock(&exchange->mutex);
    return here;
}

void camera_exchange_map(camera_exchange_t *exchange, int buffer, const camera_map_t map[PICTURE_MAX_PLANES])
{
    pthread_mutex_lock(&exchange->mutex);
    assert(exchange->buffer[buffer].map[0].length == 0);
    memcpy(exchange->buffer[buffer].map, map, sizeof exchange->buffer[buffer].map);
    pthread_mutex_unlock(&exchange->mutex);
}

camera_map_t camera_exchange_memory(const camera_exchange_t *exchange, int buffer, int plane)
{
    return exchange->buffer[buffer].map[plane]; /* changed by the calling thread alone */
}

int camera_exchange_put(camera_exchange_t *exchange, int buffer, const hal_camera_frame_t *frame)
{
    pthread_mutex_lock(&exchange->mutex);
    if (!exchange->sequence_begun) {
        exchange->sequence_first = exchange->sequence + 2 - frame->sequence;
        exchange->sequence_begun = true;
    }
    const int older = find(exchange->buffer, CAMERA_BUFFERS_MAX, CAMERA_BUFFER_READY);
    if (older != CAMERA_NO_BUFFER)
        exchange->buffer[older].state = CAMERA_BUFFER_AWAY;
    assert(exchange->buffer[buffer].state == CAMERA_BUFFER_AWAY);
    exchange->buffer[buffer].frame = *frame;
    exchange->sequence = exchange->sequence_first + frame->sequence;
    exchange->buffer[buffer].frame.sequence = exchange->sequence;
    exchange->buffer[buffer].state = CAMERA_BUFFER_READY;
    exchange->here = true;
    pthread_mutex_unlock(&exchange->mutex);
    return older;
}

/* Unmap the copies that were given back; not under the mutex, as it can take milliseconds: RETURNED is ours alone. */
static void drop_kept(camera_exchange_t *exchange)
{
    for (int i = 0; i < HAL_CAMERA_LENT; i++) {
        pthread_mutex_lock(&exchange->mutex);
        camera_buffer_t returned = exchange->kept[i];
        if (returned.state == CAMERA_BUFFER_RETURNED)
            exchange->kept[i] = (camera_buffer_t){.state = CAMERA_BUFFER_AWAY};
        pthread_mutex_unlock(&exchange->mutex);
        if (returned.state == CAMERA_BUFFER_RETURNED)
            unmap(&returned);
    }
}

int camera_exchange_collect(camera_exchange_t *exchange)
{
    drop_kept(exchange);
    pthread_mutex_lock(&exchange->mutex);
    const int buffer = find(exchange->buffer, CAMERA_BUFFERS_MAX, CAMERA_BUFFER_RETURNED);
    if (buffer != CAMERA_NO_BUFFER)
        exchange->buffer[buffer].state = CAMERA_BUFFER_AWAY;
    pthread_mutex_unlock(&exchange->mutex);
    return buffer;
}

/* Put a private copy in the place of the memory. */
static void replace_by_copy(const camera_map_t *map)
{
    if (map->length == 0)
        return;
    void *copy = mmap(NULL, map->length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (copy == MAP_FAILED)
        return;
    memcpy(copy, map->address, map->length);
    if (mremap(copy, map->length, map->length, MREMAP_MAYMOVE | MREMAP_FIXED, map->address) == MAP_FAILED)
        (void)munmap(copy, map->length);
}

void camera_exchange_withdraw(camera_exchange_t *exchange)
{
    pthread_mutex_lock(&exchange->mutex);
    exchange->here = false;
    exchange->sequence_begun = false;
    pthread_mutex_unlock(&exchange->mutex);
    drop_kept(exchange);
    /* None is taken any more, and what had come back is dropped: there is a place for each that is lent. */
    camera_buffer_t gone[CAMERA_BUFFERS_MAX];
    camera_map_t still_lent[HAL_CAMERA_LENT][PICTURE_MAX_PLANES] = {{{0}}};
    pthread_mutex_lock(&exchange->mutex);
    memcpy(gone, exchange->buffer, sizeof gone);
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++) {
        if (gone[i].state == CAMERA_BUFFER_LENT) {
            const int place = find(exchange->kept, HAL_CAMERA_LENT, CAMERA_BUFFER_AWAY);
            assert(place != CAMERA_NO_BUFFER);
            exchange->kept[place] = gone[i];
            memcpy(still_lent[place], gone[i].map, sizeof gone[i].map);
            memset(gone[i].map, 0, sizeof gone[i].map);
        }
        exchange->buffer[i] = (camera_buffer_t){.state = CAMERA_BUFFER_AWAY};
    }
    pthread_mutex_unlock(&exchange->mutex);
    /* Of one that is given back at this moment a copy does no harm: only this thread unmaps. */
    for (int i = 0; i < HAL_CAMERA_LENT; i++)
        for (int plane = 0; plane < PICTURE_MAX_PLANES; plane++)
            replace_by_copy(&still_lent[i][plane]);
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++)
        unmap(&gone[i]);
}
