// SPDX-License-Identifier: Apache-2.0
// Bus time, camera and poses -> the picture and the pose that belong to this refresh, the same on all boards.
#ifndef FIRMWARE_FRAME_CHOICE_H
#define FIRMWARE_FRAME_CHOICE_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/bus_master.h"
#include "firmware/frame_clock.h"
#include "firmware/frame_tag.h"
#include "firmware/picture_lag.h"
#include "firmware/pose_for_frame.h"
#include "firmware/pose_from_can.h"
#include "hal/hal_camera.h"
#include "hal/hal_gpio.h"

enum {
    FRAME_CHOICE_HOUSE_US = 200000,   /**< without an edge for so long there is no house signal */
    FRAME_CHOICE_CAMERA_US = 1000000, /**< without a picture for so long there is no camera, for which others wait */
    FRAME_CHOICE_TIME_US = 250, /**< bus time must be right to this, so that boards say nearly the same of a picture */
    FRAME_CHOICE_WAITING = HAL_CAMERA_LENT - 1, /**< pictures that may be captured, but not due yet */
    FRAME_CHOICE_EDGE_US = 500 /**< a picture captured so near to the limit may be another board's next one */
};

/** A picture of the camera, kept. */
typedef struct {
    bool any;
    hal_camera_frame_t frame; /**< lent by the camera */
    int64_t capture_us;       /**< bus time, as it was known when the picture came */
    bool tagged;
    frame_tag_t tag;
} kept_picture_t;

/** All zero bytes but for what frame_choice_init() sets. */
typedef struct {
    frame_clock_t clock;
    pose_for_frame_rule_t rule;
    int32_t hidden_px;  /**< rows of every picture that hold the tag, and are not shown; 0 without tags */
    kept_picture_t now; /**< shown now */
    kept_picture_t waiting[FRAME_CHOICE_WAITING]; /**< captured, but not due yet, oldest first; */
    int32_t waiting_count;                        /**< so many */
    int64_t interval_us;                          /**< between the newest two pictures; 0: unknown */
    picture_lag_t lag;
    int32_t wanted_ms; /**< what an operator wants of this board (frame_latency.h); the caller's to set */
    bool house_any;    /**< an edge of the house signal has come: */
    int64_t house_us;  /**< the newest, on the board's clock */

    frame_step_t step;      /**< this refresh */
    bool genlocked;         /**< and there is a house signal */
    bool picture_certain;   /**< `now` is certain to be every board's picture */
    pose_history_t history; /**< the poses that count for this refresh */
    bool pose_certain;      /**< and the newest of them is every board's */
    uint32_t tags_lost;     /**< pictures whose tag could not be read, when tags are expected */
} frame_choice_t;

/** How the room wants it. */
typedef struct {
    frame_clock_settings_t clock;
    pose_for_frame_rule_t rule;
    int32_t width, height; /**< of the camera's pictures */
} frame_choice_settings_t;

/** @return false when tags are asked for and pictures of this size have no room for them. */
bool frame_choice_init(frame_choice_t *choice, const frame_choice_settings_t *settings, int64_t now_us);

/**
 * Keep a picture that the camera has lent; it is shown when it is due.
 *
 * @param frame     Not GRAY8, of the settings' size. Only when frame_choice_wants_picture().
 * @param blank_us  The newest vertical blank, on the board's clock: the first one that the picture was here at.
 */
void frame_choice_keep(frame_choice_t *choice, const hal_camera_frame_t *frame, const bus_master_t *time,
                       int64_t blank_us);

/** @return Is there room for another picture? */
bool frame_choice_wants_picture(const frame_choice_t *choice);

/** @return The picture that was kept last; its `any` is false before the first. */
const kept_picture_t *frame_choice_newest(const frame_choice_t *choice);

/** Take the edges of the house signal that have come. Only the newest counts. @return false when the line fails. */
bool frame_choice_take_edges(frame_choice_t *choice, hal_gpio_t *gpio);

/**
 * Number this refresh, and choose for it. To be called once a blank, after the bus and the camera were read.
 *
 * A picture that is not shown any more goes back to the camera.
 *
 * @param blank_us  The newest vertical blank, on the board's clock.
 */
void frame_choice_step(frame_choice_t *choice, const can_poses_t *poses, const bus_master_t *time, hal_can_t *can,
                       hal_camera_t *camera, int64_t blank_us);

/**
 * The pose, and the camera for it, to map the picture with.
 *
 * @param camera  The room's.
 * @return false while there is no pose.
 */
bool frame_choice_pose(pose_for_frame_t *chosen, const frame_choice_t *choice, const can_poses_t *poses,
                       const camera_t *camera);

/** @return Bus time of the middle of the next refresh, which shows what is drawn now, as it is seen on the wall. */
int64_t frame_choice_shown_us(const frame_choice_t *choice);

/** @return The picture to be shown, without the rows of a tag. Only when choice->now.any. */
picture_t frame_choice_picture(const frame_choice_t *choice);

/** @return What this board shows, for its Step message; node and counter are the caller's. */
can_step_t frame_choice_report(const frame_choice_t *choice);

/** @return What keeps picture and pose of this refresh from being certain to be every board's. */
can_step_fault_t frame_choice_fault(const frame_choice_t *choice);

#endif
