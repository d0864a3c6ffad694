// SPDX-License-Identifier: Apache-2.0
// An HDMI receiver: what it offers to the source (EDID), what the source sends (DV timings), and when that changes.
#ifndef HAL_LINUX_CAMERA_V4L2_RECEIVER_H
#define HAL_LINUX_CAMERA_V4L2_RECEIVER_H

#include <linux/videodev2.h>
#include <stdbool.h>

#include "hal/linux/camera_source.h"
#include "hal/linux/edid.h"

/** @return Has the device, a video or a sub-device, timings that a source decides? */
bool camera_v4l2_is_receiver(int file);

/**
 * Show the source an EDID with the room's size and rate, unless that is shown already: a new one makes the source begin
 * anew. A receiver that takes none, as its own is fixed, is left as it is.
 *
 * @return false when the size and rate fit no EDID, or the receiver refuses it.
 */
bool camera_v4l2_offer(int file, const camera_wanted_t *wanted, char error[HAL_BOARD_ERROR_LENGTH]);

/** Be told of changes of the source: POLLPRI. A receiver that tells none is asked often instead. */
void camera_v4l2_watch_source(int file);

/** Take all events that wait. @return Did the source change? */
bool camera_v4l2_source_changed(int file);

/**
 * What the source sends now.
 *
 * @param[out] timings  Written only when true is returned.
 * @param[out] news     Else: why not, as that there is no signal, or that it is of another size.
 */
bool camera_v4l2_query(int file, const camera_wanted_t *wanted, struct v4l2_dv_timings *timings,
                       char news[HAL_BOARD_ERROR_LENGTH]);

/** Are two timings the same, but for a thousandth of the pixel clock, which is measured? */
bool camera_v4l2_same_timings(const struct v4l2_dv_timings *a, const struct v4l2_dv_timings *b);

#endif
