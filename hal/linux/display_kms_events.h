// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of vertical blanks: flips done, and blanks that were asked for.
#ifndef HAL_LINUX_DISPLAY_KMS_EVENTS_H
#define HAL_LINUX_DISPLAY_KMS_EVENTS_H

#include <stdint.h>

enum { KMS_EVENTS = 8 };

typedef struct {
    uint64_t token;    /**< of the request that it answers */
    int64_t time_ns;   /**< of the blank, CLOCK_MONOTONIC */
    uint32_t sequence; /**< the blank's number, modulo 2^32; 0 always from a driver that does not count them */
} kms_event_t;

/**
 * Take what is there, without blocking and without the heap. Events of other kinds are dropped.
 *
 * @param card  Open and non-blocking.
 * @return How many were written; 0 when there is none for now, or the card is gone.
 */
int32_t kms_events_take(kms_event_t events[KMS_EVENTS], int card);

#endif
