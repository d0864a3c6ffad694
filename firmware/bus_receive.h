// SPDX-License-Identifier: Apache-2.0
// The one place where the firmware reads the bus: every frame goes to whom it is for.
#ifndef FIRMWARE_BUS_RECEIVE_H
#define FIRMWARE_BUS_RECEIVE_H

#include "firmware/bus_auth.h"
#include "firmware/bus_master.h"
#include "firmware/frame_clock.h"
#include "firmware/isotp.h"
#include "firmware/pose_from_can.h"
#include "hal/hal_can.h"

enum { BUS_RECEIVE_FRAMES = 256 /**< taken per call at most */ };

/** Who hears. */
typedef struct {
    can_poses_t *poses;
    bus_master_t *time;   /**< NULL: Sync and FollowUp are ignored */
    frame_clock_t *clock; /**< NULL: FrameClock is ignored; else time is not NULL */
    isotp_t *commands;    /**< NULL: requests are ignored */
    can_faults_t *faults; /**< counted up */
    bus_auth_t *auth;     /**< says which frames are believed; NULL: all are */
} bus_receivers_t;

/**
 * Take what the controller has received, oldest first, at most BUS_RECEIVE_FRAMES frames. Never blocks.
 *
 * A controller found bus-off is told to restart. Frames that it lost are counted.
 */
void bus_receive(const bus_receivers_t *to, hal_can_t *can);

#endif
