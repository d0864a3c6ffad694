// SPDX-License-Identifier: Apache-2.0
// A run of a whole room: from a pose list in virtual time, or in real time with the bus open on a port.
#ifndef SIM_RUN_SIM_RUN_H
#define SIM_RUN_SIM_RUN_H

#include <signal.h>
#include <stdint.h>

#include "sim/run/house_signal.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/method.h"
#include "warp_fixed/picture.h"

enum { SIM_RUN_JUDGE_USUAL = -1, SIM_RUN_NO_BUS = -1, SIM_RUN_MAX_FRAMES = 1000000 };

/** As on the command line. */
typedef struct {
    const char *room, *video;
    const char *poses;             /**< pose list: virtual time; NULL with a port */
    int bus_port;                  /**< 0 (any free one) to 65535: real time; SIM_RUN_NO_BUS with a pose list */
    const char *out;               /**< folder; made if it is missing; run_clean() deletes what a run before has left */
    int32_t frames;                /**< 0: as long as the list, or until *stop */
    const warp_method_t *method;   /**< of every board; NULL for the room's */
    const warp_kernels_t *kernels; /**< of every board; NULL for the fastest */
    picture_format_t camera;       /**< what the cameras deliver; any but GRAY8 */
    picture_format_t display;      /**< what the displays take besides XRGB8888: NV12, YUYV or XRGB8888 */
    double rate_hz; /**< refresh, in place of the room's; 0: the room's, else the list's up to 60 Hz, or 60 Hz */
    house_signal_options_t house; /**< genlock */
    const char *original;         /**< PNG, q times as wide and high as the camera's picture; NULL for none */
    const char *key;              /**< file of the room's key; NULL: it has none */
    int32_t judge; /**< measure PSNR of every so many frames; 0 none; SIM_RUN_JUDGE_USUAL: 8 of the run */
} sim_run_options_t;

/**
 * Do it: write pictures, tables, plots and the page, print the short table on stdout; progress and errors on stderr.
 *
 * Virtual time: step n is made (n + 1/2) / rate after the list's first pose, so that with a list at the refresh rate
 * frame n is drawn for pose n. Without a number of frames the run ends with the list.
 *
 * Real time: "bus on 127.0.0.1:PORT (socketcand, channel can0)" on stdout, at once. Refreshes that this machine can't
 * hold are skipped and counted; every frame that is made has its pictures.
 *
 * What can't be written, as on a full disk, ends the run; tables, plots and page are then made of the frames so far.
 *
 * @param stop  When it becomes non-zero the run ends after the present frame, as if it were the last; in virtual time
 *              stderr then says how many frames are missing.
 * @return The exit status: 0; 1 after an error message, after a stop before the end of a run in virtual time, or when
 *         stdout did not take the table.
 */
int sim_run(const sim_run_options_t *options, const volatile sig_atomic_t *stop);

#endif
