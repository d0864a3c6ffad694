// SPDX-License-Identifier: Apache-2.0
// What authentic messages say of bus time: the least that it can be, which is what makes old messages old.
//
// A message was made when it says, so bus time is that or later when it comes. From the newest of such moments on it
// grows as the board's clock does, or AUTH_CLOCK_MAX_PPM slower. This is no bus time to go by (bus_time.h is), but
// nobody without the key can push it, it needs no master, and it is right within the shortest of the messages' delays.
#ifndef FIRMWARE_AUTH_CLOCK_H
#define FIRMWARE_AUTH_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_auth.h"

enum {
    AUTH_CLOCK_MAX_PPM = 500,     /**< between two clocks: as BUS_TIME_MAX_PPM */
    AUTH_CLOCK_PAST_US = 100000,  /**< a message that is older than this when it comes has been held back */
    AUTH_CLOCK_AHEAD_US = 100000, /**< bus time may be so much later than known, and after a silence AUTH_CLOCK_MAX_PPM
                                     of it twice more. Not more than PAST: one message that is stamped too early
                                     does not make later ones old */
    AUTH_CLOCK_FIRST_US = 2000000 /**< in place of AHEAD for the first message after auth_clock_begin(): what the
                                     command may have taken */
};

/** All zero: bus time 0 at the clock's 0. */
typedef struct {
    uint64_t bus_us;  /**< bus time was that, or later, */
    int64_t local_us; /**< when the board's clock showed this */
    bool begun;       /**< no message has come since auth_clock_begin() */
} auth_clock_t;

/** Forget all: bus time was that, or up to AUTH_CLOCK_FIRST_US more, at this moment. */
void auth_clock_begin(auth_clock_t *clock, uint64_t bus_us, int64_t local_us);

/** An authentic message of a time has come: later ones move the clock, earlier ones do not. */
void auth_clock_hear(auth_clock_t *clock, uint64_t bus_us, int64_t local_us);

/** @return The least that bus time can be at a moment of the board's clock. */
uint64_t auth_clock_least_us(const auth_clock_t *clock, int64_t local_us);

/** @return When a message that comes now must have been made. */
can_auth_window_t auth_clock_window(const auth_clock_t *clock, int64_t local_us);

/** @return The time to sign with: bus time, where that can be right; else the least that it can be. */
uint64_t auth_clock_sign_us(const auth_clock_t *clock, int64_t bus_us, int64_t local_us);

#endif
