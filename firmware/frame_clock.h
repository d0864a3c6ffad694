// SPDX-License-Identifier: Apache-2.0
// The same frame on all walls: numbers of refreshes that all boards share, and which picture and pose belong to each.
//
// Bus time says when, to 0.1 ms. That is not enough to choose the same pose sample on every board: one that was
// captured just then would be taken by one board and left by another. So a refresh begins at a time that is computed,
// not measured, from numbers that all boards have:
//
//   start(n) = n periods + phase        bus time, whole microseconds; the period is the room's refresh_hz
//   n of a refresh is the one whose start is nearest to the vertical blank that the board has seen
//   it shows content c = n - held:
//   pose     the newest sample captured up to start(c) - pose_delay
//   picture  the newest one captured up to start(c) - lag + period / 4
//
// The lag is that of the slowest board's camera. Projectors differ in what they take from a board's blank to the wall.
// As long as the target is 0, each board shows each content as soon as it can: held is 0. With a target a board holds
// contents back for as many whole refreshes, FRAME_CLOCK_MOST_HELD at most, as bring what its projector takes nearest
// to it: then all walls change within a period of each other, and when projectors differ by whole refreshes, at once.
// The target is what the slowest projector takes, or more when an operator wants more, and 0 unless one wants it so:
// see frame_latency.h.
//
// Phase, lag and target are an epoch. One board leads, at first the one with the lowest node number: it announces the
// epoch at the first blank after each CAN_FRAME_CLOCK_PERIOD_MS, and a new one (panels run faster or slower than bus
// time, video slides past the panels, a board needs more time) FRAME_CLOCK_AHEAD_US before it holds, so that no board
// misses it. A content belongs to the epoch that held for the refresh of its number. Who has heard nothing
// for FRAME_CLOCK_PROOF_US, whose own announcements do not get out, or whose panel is more than a quarter of a period
// off, is not in step, and says so.
//
// Where the leader has a house signal (genlock), refreshes begin at its edges; else at the leader's own blanks.
//
// When nobody has led for FRAME_CLOCK_SILENT_US and FRAME_CLOCK_TURN_US times its own number, a board begins to, with
// the epoch that it knows: no number changes. Of two leaders the one stays that has a change under way, else the one
// with the lower number; a change that was announced by a leader who goes is off. A leader that comes back after
// bus-off, or whose announcements did not get out, listens first.
//
// Integers only, no pointers inside, constant time.
#ifndef FIRMWARE_FRAME_CLOCK_H
#define FIRMWARE_FRAME_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_frame_clock.h"
#include "firmware/frame_rate.h"
#include "firmware/room_latency.h"
#include "hal/hal_camera.h"
#include "hal/hal_can.h"

enum {
    FRAME_CLOCK_SILENT_US = 150000,
    FRAME_CLOCK_TURN_US = 50000, /**< more than a refresh at 24 Hz: by then the one before has been heard */
    FRAME_CLOCK_AHEAD_US = 1500000,
    FRAME_CLOCK_PROOF_US = 1000000, /**< less than AHEAD: who has heard something since cannot have missed a change */
    FRAME_CLOCK_DRIFT_US = 300, /**< the house signal, or else the leader's panel, so far off on average: a new epoch */
    FRAME_CLOCK_LAG_REFRESHES = 30, /**< a lag or target that is wrong for so many refreshes in a row: one too */
    FRAME_CLOCK_MOST_HELD =
        HAL_CAMERA_LENT - 1 /**< pictures that wait are lent by the camera, and so is the one shown */
};

/** What holds from one refresh on. */
typedef struct {
    bool any;
    uint8_t number; /**< modulo CAN_EPOCHS */
    int64_t from;   /**< number of its first refresh */
    int32_t phase_us, lag_us;
    int32_t target_ms; /**< see can_frame_clock_t */
} frame_epoch_t;

/** One refresh, as frame_clock_step() found it. Times in bus time. */
typedef struct {
    bool in_step;             /**< these are certain to be every board's; else the best that is known */
    can_step_fault_t fault;   /**< and why they are not */
    int64_t number;           /**< of the refresh, counted from bus time 0 on */
    int64_t content;          /**< of what it shows, the same on all boards */
    int32_t held;             /**< number - content */
    frame_epoch_t epoch;      /**< of the content */
    int64_t start_us;         /**< of the refresh of the content's number */
    int64_t pose_limit_us;    /**< the pose sample is the newest one captured up to here */
    int64_t picture_limit_us; /**< the picture likewise */
    int32_t off_us;           /**< by how much the board's blank was later than its refresh's start */
} frame_step_t;

/** How the room and this board are set up. */
typedef struct {
    uint8_t node;          /**< 1 to CAN_MAX_NODE */
    frame_rate_t rate;     /**< below 15.3 Hz nobody leads, and so nobody is in step */
    int32_t pose_delay_us; /**< 0 to 50000: from capture to arrival of a pose at every board, and a quarter of the time
                                between two more */
    int32_t display_us;    /**< from the board's blank to the wall, 0 to 200 ms; rounded to what Latency
                                says */
} frame_clock_settings_t;

typedef struct {
    uint8_t node;
    frame_rate_t rate;
    int32_t pose_delay_us, display_us;
    frame_epoch_t now, next; /**< next.any: announced, does not hold yet */
    frame_epoch_t before;    /**< any: held until now.from */
    frame_epoch_t doubt;     /**< any: was dropped; others may take it, unless a leader is heard since */
    room_latency_t room;     /**< what all boards ask for */
    bool leading;
    uint8_t leader;   /**< whom it follows, or followed last; 0: nobody yet */
    uint32_t changes; /**< of the leader, after the first one */
    uint32_t missed;  /**< changes of the epoch that were noticed only when they held already */

    hal_can_frame_t say[2]; /**< announcements sent in the newest step: what bus_auth_sign() signs, */
    int said;               /**< and how many */

    int64_t quiet_since_us; /**< the module's own from here on: nobody has led since, on the board's clock */
    int64_t proven_us;      /**< newest announcement heard, or own one that got out */
    bool proven;
    int64_t led_since_us, sent_us, due_us;
    int64_t own_us, own_since_us; /**< own announcements got out, at last and without a gap since */
    uint8_t counter;

    int32_t off_q8;    /**< as leader: mean of how late the house signal, or else the panel, is */
    int32_t off_count; /**< refreshes in it */
    int32_t wrong;     /**< refreshes in a row with a wrong lag or target */
} frame_clock_t;

/** What the board has measured at a vertical blank. */
typedef struct {
    int64_t now_us;      /**< on the board's clock */
    int64_t blank_us;    /**< bus time of the blank */
    bool bus_time_known; /**< else the board neither leads nor is in step */
    bool genlocked;      /**< a house signal is there: */
    int64_t house_us;    /**< bus time of its newest edge, the begin of a frame */
    int32_t lag_us;      /**< what the board's camera needs, see picture_lag.h; 0: there are no pictures */
    int32_t wanted_ms;   /**< what an operator wants of this board, see frame_latency.h; 0: nothing */
} frame_blank_t;

/** Begin to listen. */
void frame_clock_init(frame_clock_t *clock, const frame_clock_settings_t *settings, int64_t now_us);

/**
 * Take a received frame, or one of its own that hal_can_receive() hands back.
 *
 * @param now_bus_us  Bus time; a refresh off does not matter.
 * @return CAN_CHECK_OTHER when it is neither FrameClock nor Latency; CAN_CHECK_OK; or what is wrong: it is ignored.
 */
can_check_t frame_clock_hear(frame_clock_t *clock, const hal_can_frame_t *frame, int64_t now_us, int64_t now_bus_us);

/** Number this refresh; lead, announce and begin epochs when it is this board's turn. Call it once a blank. */
frame_step_t frame_clock_step(frame_clock_t *clock, hal_can_t *can, const frame_blank_t *blank);

/** @return Bus time at which a refresh begins. */
int64_t frame_clock_start_us(const frame_clock_t *clock, int64_t number);

/** @return By how much a moment of bus time is later than the refresh of the present epoch that begins nearest to it.
 */
int32_t frame_clock_off_us(const frame_clock_t *clock, int64_t bus_us);

/** @return Number of the first content of this epoch that has a picture captured then: its own one without a tag. */
int64_t frame_clock_picture_number(const frame_clock_t *clock, const frame_epoch_t *epoch, int64_t capture_bus_us);

#endif
