// SPDX-License-Identifier: Apache-2.0
// The part of frame_clock.c that leads; for it alone.
#ifndef FIRMWARE_FRAME_LEAD_H
#define FIRMWARE_FRAME_LEAD_H

#include "firmware/frame_clock.h"

enum {
    FRAME_LEAD_OWN_LATE_US = 100000, /**< an announcement that gets out so late says nothing of now */
    FRAME_LEAD_PAST = 2,             /**< an epoch that holds is announced from so many refreshes ago */
    FRAME_LEAD_LAG_MOST_US = 65520   /**< as it is sent */
};

/** Follow a leader from now on, or be it. */
void frame_clock_follow(frame_clock_t *clock, uint8_t leader);

/** A change that was announced is off, as far as is known. */
void frame_clock_drop_change(frame_clock_t *clock);

/** Begin to lead when nobody does, cease to when nobody hears. */
void frame_lead_decide(frame_clock_t *clock, const frame_blank_t *blank);

/** As leader: watch the own panel and camera, which the room goes by, and announce. */
void frame_lead(frame_clock_t *clock, hal_can_t *can, const frame_step_t *step, const frame_blank_t *blank);

#endif
