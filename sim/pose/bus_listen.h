// SPDX-License-Identifier: Apache-2.0
// Hears a bus for some time, frame by frame.
#ifndef SIM_POSE_BUS_LISTEN_H
#define SIM_POSE_BUS_LISTEN_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"
#include "sim/pose/pose_link.h"

typedef struct {
    int64_t length_us;                 /**< how long; 0: until stopped or the bus is gone */
    const volatile sig_atomic_t *stop; /**< ends it when it becomes non-zero; looked at every 100 ms */
    /** Hears every frame. @return false to end. */
    bool (*frame)(void *context, const hal_can_frame_t *frame);
    /** Called about every 100 ms, also when the bus is silent. NULL: not called. */
    void (*tick)(void *context);
    /** Called for every bus error that the controller reports. NULL: not called. */
    void (*bus_error)(void *context);
    void *context;
} bus_listen_t;

/** How it came to its end. */
typedef enum {
    BUS_LISTEN_DONE,  /**< its time is over, it was stopped, or frame() ended it */
    BUS_LISTEN_ENDED, /**< the bus is gone: a simulation's end, or an interface that went away */
    BUS_LISTEN_FAILED /**< there was no bus to hear */
} bus_listen_end_t;

/**
 * Open a bus, hear it, and close it.
 *
 * @param      bus    As pose_link_open() takes it.
 * @param[out] error  For BUS_LISTEN_ENDED and BUS_LISTEN_FAILED: one line without newline.
 */
bus_listen_end_t bus_listen(const char *bus, const bus_listen_t *listen, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
