// SPDX-License-Identifier: Apache-2.0
// One projector: all its state in one struct, and the loop body.
#ifndef FIRMWARE_PROJECTOR_H
#define FIRMWARE_PROJECTOR_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/bus_auth.h"
#include "firmware/can_protocol.h"
#include "firmware/commands.h"
#include "firmware/degrade.h"
#include "firmware/event_watch.h"
#include "firmware/frame_choice.h"
#include "firmware/ladder.h"
#include "firmware/pose_from_can.h"
#include "firmware/room.h"
#include "firmware/safe_picture.h"
#include "firmware/stage_times.h"
#include "firmware/telemetry.h"
#include "firmware/update.h"
#include "hal/hal_board.h"
#include "warp_fixed/warp.h"

typedef struct projector projector_t;

enum {
    PROJECTOR_HOLD_AFTER_US = 100000,  /**< no pose for so long: holding the last one */
    PROJECTOR_SAFE_AFTER_US = 1000000, /**< and for so long: safe picture */
    PROJECTOR_JUDGED_LIT = 8, /**< a picture that lights less than 1 / 8 of the panel says little of a method */
    PROJECTOR_CAMERA_LOST_US = 1000000 /**< no new picture from the camera for so long: fault, safe picture */
};

/** Faults of the board's own devices, counted since start; those of the bus are in can_faults_t. */
typedef struct {
    uint32_t camera;       /**< refused to deliver */
    uint32_t picture_size; /**< pictures that are not of the room's size */
    uint32_t display;      /**< back buffer or flip refused */
    uint32_t deadline;     /**< pictures not ready at the vertical blank they were made for */
    uint32_t gpio;
    uint32_t watchdog;
    uint32_t can_send; /**< telemetry frames that could not be queued */
} projector_faults_t;

/** What the newest step did, for people who look on: the simulator, tests. */
typedef struct {
    can_board_state_t state;
    bool corrected;        /**< the presented picture is a warped one, not the safe picture */
    safe_picture_t safe;   /**< what that says, if it is the one */
    uint32_t frame_number; /**< pictures presented since start */
    pose_t pose;           /**< that it was warped with; */
    uint8_t pose_counter;  /**< the tracker's, of the one that it was drawn with */
    warp_report_t warp;
    stage_step_t times;     /**< its stages, and the wait before it */
    can_step_t agreement;   /**< which content, picture and pose sample these are, and whether all boards have them */
    can_step_fault_t fault; /**< why that is not certain */
    int32_t pose_to_photon_us; /**< from that sample's capture to the middle of the refresh that shows the picture, as
                                    it is seen on the wall; by the panel's own blank */
} projector_report_t;

/** About 201 MB, one static instance on a board; the simulator makes one for each of its boards before it starts. */
struct projector {
    hal_board_t board;
    int32_t node;
    char name[ROOM_NAME_LENGTH];
    bool unusable; /**< configuration, room, key or a device: it only says so (notice.h) */
    camera_t camera;
    wall_t wall;
    const warp_kernels_t *kernels;

    can_poses_t poses;
    bus_auth_t auth;       /**< what of it is believed */
    bus_master_t time;     /**< of the bus */
    frame_choice_t choice; /**< the picture and the pose of this refresh */
    int64_t picture_us;    /**< when it was taken; at first the start of the loop */
    warp_t warp;
    const warp_method_t *room_method; /**< the board's own */
    ladder_t ladder;                  /**< it, or the one that an operator wants, and what stands in for it */
    degrade_t degrade;                /**< which step of it is in use */
    bool keeps_method;                /**< it stays at step 0 */

    projector_report_t report;
    uint32_t guessed;          /**< pictures mapped with another pose than the rule asks for (pose_for_frame.h) */
    stage_times_t stage_times; /**< since the last report of them */
    int64_t shown_us;          /**< end of STAGE_SHOW, in the step before */
    projector_faults_t faults;
    can_faults_t can_faults;
    telemetry_t telemetry;
    commands_t commands; /**< what operators want */
    update_t update;     /**< to another version of the firmware */
    event_watch_t events;
};

/**
 * Make a projector ready for its first step.
 *
 * @param[out] projector  Need not be initialised.
 * @param      room       Only read here.
 * @param      board      Which board of the room this is.
 * @param      devices    Open devices; they stay the caller's to close, after the last step.
 * @param      kernels    Pixel loops to use.
 */
void projector_init(projector_t *projector, const room_t *room, const room_board_t *board, const hal_board_t *devices,
                    const warp_kernels_t *kernels);

/**
 * Believe only who has the room's key, from the first step on (bus_auth.h). Without this call every frame is believed.
 *
 * @param key   Must outlive the projector. NULL: none.
 * @param seed  Random, another one at every start.
 */
void projector_use_key(projector_t *projector, can_auth_t *key, uint64_t seed);

/** Never take a cheaper method, however late the pictures: where time passes that is not the board's, in a simulation.
 */
void projector_keep_method(projector_t *projector);

/** Make the next pictures with projector->ladder: its first method, which the warp must be ready for, and as stand-ins
 *  those that follow it, up to the first that the warp is not ready for. */
void projector_begin_ladder(projector_t *projector);

/** Drive a line, and count it when that fails. */
void projector_drive(projector_t *projector, hal_gpio_line_t line, bool high);

/** LED and lamp as they belong to the newest step's report. */
void projector_light(projector_t *projector, int64_t now_us);

/**
 * Feed the watchdog, unless a reboot is asked for, and tell the service manager.
 *
 * @param state    In a few words, for people; stays as it is for as long as the board is open.
 * @param healthy  On the terms of hal_watchdog_feed().
 */
void projector_tell_life(projector_t *projector, const char *state, bool healthy, int64_t now_us);

/** Choose the next picture's method by what this one took. @param time_us  There was for it. */
void projector_choose_method(projector_t *projector, int64_t time_us);

/**
 * Everything that is done once per refresh: bus and its time, camera, warp, display, telemetry, watchdog, update. Call
 * it after each vertical blank. Never blocks, never allocates; ends with a picture presented whatever has failed,
 * unless it is the display itself. When pictures are late or about to be, the next ones are made with a cheaper method
 * (degrade.h).
 *
 * States: frozen (the wall keeps what it shows, nothing is presented) and pattern, as long as an operator wants that
 * (commands.h); else waiting for the first pose (safe picture); running; holding the last pose after
 * PROJECTOR_HOLD_AFTER_US without a new one; safe picture after PROJECTOR_SAFE_AFTER_US; fault (safe picture) while the
 * camera has been silent for PROJECTOR_CAMERA_LOST_US, delivers pictures of a wrong size, or the display refuses. Each
 * ends by itself when its cause does.
 *
 * The watchdog is fed when the step got through and a picture was presented or the wall is frozen, or the display said
 * that it is gone: a reset brings no cable back. A display whose buffers never come free is not fed for; nor is it fed
 * when an operator wants a reboot. A service manager hears of life on the same terms.
 */
void projector_step(projector_t *projector);

#endif
