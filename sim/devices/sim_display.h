// SPDX-License-Identifier: Apache-2.0
// The display in the simulator (hal/hal_display.h): pictures in memory, blanks of a common time, faults on demand.
#ifndef SIM_DEVICES_SIM_DISPLAY_H
#define SIM_DEVICES_SIM_DISPLAY_H

#include <stdint.h>

#include "hal/hal_display.h"
#include "hal/hal_time.h"
#include "sim/devices/sim_rate.h"
#include "sim/files/file_io.h"

/**
 * Three buffers: one on the wall, one presented, one drawn into. A picture presented while another still waits for
 * the same blank takes its place. Borrowing again without presenting gives the same buffer again.
 */
typedef struct {
    int32_t width, height;   /**< of the panel, pixels */
    picture_format_t format; /**< NV12 or YUYV: taken besides XRGB8888; XRGB8888: no other is */
    hal_time_t *clock;       /**< the board's; must outlive the display */
    sim_rate_t
        blanks; /**< vertical blanks, in the simulation's time: rate and phase; the HAL tells them on the clock */

    /**
     * With a real clock: called by hal_display_wait_vblank() before it sleeps, so that a program without a simulator
     * around the loop can move its other devices between two steps. May be NULL, and is not called in virtual time.
     */
    void (*while_waiting)(void *context);
    void *context;
} sim_display_settings_t;

/** What goes wrong. All 0: nothing. */
typedef struct {
    int64_t unplugged_until_us; /**< until then, in the simulation's time, the wall is dark, calls return HAL_IO,
                                   nothing is flipped; 0: never */
    uint32_t refuse_next;       /**< refuse this many presented pictures with HAL_IO; counts down */
    uint32_t late_next;         /**< this many flips come late; counts down */
    uint32_t late_blanks;       /**< by how many blanks a late flip is late; 0 stands for 1 */
    uint32_t drawing_us;        /**< a slow board: a virtual clock moves on by this as each back buffer is borrowed */
} sim_display_faults_t;

typedef struct {
    uint64_t flips;    /**< pictures that reached the wall */
    uint64_t missed;   /**< blanks since the first flip that brought no new picture */
    uint64_t replaced; /**< pictures presented but replaced by a newer one before their blank */
    uint64_t refused;  /**< pictures refused because of a fault */
} sim_display_counts_t;

/** @return A display, or NULL with the reason in error: a bad setting, or no memory. Uses the heap. */
hal_display_t *sim_display_create(const sim_display_settings_t *settings, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_display_destroy(hal_display_t *display);

/**
 * Let time pass: perform every blank up to and including now_us. The HAL calls do the same for the clock's time, so a
 * picture presented after a blank never counts for it.
 *
 * @param now_us  In the simulation's time; a time before that of the last call changes nothing.
 */
void sim_display_advance(hal_display_t *display, int64_t now_us);

/**
 * @return The picture on the wall since the last blank, as XRGB8888, until the next call; NULL while the wall is dark:
 *         nothing shown yet, or unplugged.
 */
const image_t *sim_display_shown(hal_display_t *display);

/** @return The same picture as it is scanned out, in its own format. */
const picture_t *sim_display_scanned(const hal_display_t *display);

/** @return The faults, to be set and cleared at any time between the firmware's steps. */
sim_display_faults_t *sim_display_faults(hal_display_t *display);

/** @return What has happened so far. */
sim_display_counts_t sim_display_counts(const hal_display_t *display);

#endif
