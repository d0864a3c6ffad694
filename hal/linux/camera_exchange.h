// SPDX-License-Identifier: Apache-2.0
// Hands pictures from the thread that captures them to the firmware's loop, and back.
#ifndef HAL_LINUX_CAMERA_EXCHANGE_H
#define HAL_LINUX_CAMERA_EXCHANGE_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal/hal_camera.h"

enum {
    CAMERA_BUFFERS = HAL_CAMERA_LENT + 4, /**< to ask a driver for: those lent, the newest, and three to be filled */
    CAMERA_BUFFERS_MIN = HAL_CAMERA_LENT + 2,
    CAMERA_BUFFERS_MAX = HAL_CAMERA_LENT + 8,
    CAMERA_NO_BUFFER = -1
};

/** Memory from mmap(). */
typedef struct {
    void *address;
    size_t length; /**< bytes; 0: none */
} camera_map_t;

typedef enum {
    CAMERA_BUFFER_AWAY,    /**< with the driver, or not there */
    CAMERA_BUFFER_READY,   /**< the newest picture */
    CAMERA_BUFFER_LENT,    /**< with the loop */
    CAMERA_BUFFER_RETURNED /**< for the driver to fill again */
} camera_buffer_state_t;

typedef struct {
    camera_buffer_state_t state;
    camera_map_t map[PICTURE_MAX_PLANES]; /**< the memory of its picture */
    hal_camera_frame_t frame;             /**< while it is READY or LENT */
} camera_buffer_t;

/** Touched by its functions alone. */
typedef struct {
    pthread_mutex_t mutex; /**< of all below; lends the holder the priority of who waits */
    camera_buffer_t buffer[CAMERA_BUFFERS_MAX];
    camera_buffer_t kept[HAL_CAMERA_LENT]; /**< LENT, of a device that is gone, or RETURNED */
    bool here;                             /**< the source delivers */
    uint32_t sequence, sequence_first;     /**< the last one given out; what is added to the source's own */
    bool sequence_begun;                   /**< the source's own is under way since it came */
} camera_exchange_t;

/** @return false when the system has no such lock. */
bool camera_exchange_init(camera_exchange_t *exchange);

/** Unmap all, lent pictures too. */
void camera_exchange_end(camera_exchange_t *exchange);

/** hal_camera_take() and hal_camera_release(): for the loop. */
hal_status_t camera_exchange_take(camera_exchange_t *exchange, hal_camera_frame_t *frame);
void camera_exchange_release(camera_exchange_t *exchange, const hal_camera_frame_t *frame);

/** @return Does the source deliver: has there been a picture since it came? */
bool camera_exchange_is_here(camera_exchange_t *exchange);

/** The others are for the capturing thread. Buffers count from 0 to CAMERA_BUFFERS_MAX - 1. */

/** Give a buffer its memory, before its first picture. From now on the exchange unmaps it. */
void camera_exchange_map(camera_exchange_t *exchange, int buffer, const camera_map_t map[PICTURE_MAX_PLANES]);

/** @return The memory of one plane of it. */
camera_map_t camera_exchange_memory(const camera_exchange_t *exchange, int buffer, int plane);

/**
 * Make a filled buffer the newest picture. The source is here from now on.
 *
 * @param frame  Its sequence is the source's own, which may begin anew after camera_exchange_withdraw(): the loop is
 *               given one that goes on, with a gap.
 * @return The buffer with the newest picture until now, which nobody took and the driver can fill again; or
 *         CAMERA_NO_BUFFER.
 */
int camera_exchange_put(camera_exchange_t *exchange, int buffer, const hal_camera_frame_t *frame);

/** @return A buffer given back by the loop, to be filled again; or CAMERA_NO_BUFFER. Call it until there is none. */
int camera_exchange_collect(camera_exchange_t *exchange);

/**
 * The source is gone (HAL_IO from now on) or begins anew: take all memory out of use. Pictures that are lent stay where
 * they are, with their pixels, as private copies: a device stays busy as long as its memory is mapped, and the loop
 * holds the last picture for as long as no other comes. All else is unmapped, and every buffer is away.
 *
 * The copy takes its address in one step (mremap), so that other threads may read it meanwhile. Where there is no
 * memory for one, the device's own stays mapped until the picture is released.
 */
void camera_exchange_withdraw(camera_exchange_t *exchange);

#endif
