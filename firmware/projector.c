// SPDX-License-Identifier: Apache-2.0
// The loop body: the stages of a frame by name, in order.
#include "firmware/projector.h"

#include <string.h>

#include "firmware/bus_receive.h"
#include "firmware/pattern_picture.h"
#include "firmware/safe_reason.h"
#include "firmware/warp_steps.h"

_Static_assert((int)ROOM_VIEWERS == (int)CAN_VIEWERS, "a room file may name every viewer");
_Static_assert((int)FRAME_TAG_VIEWERS == (int)CAN_VIEWERS, "and so may the code in a picture");
_Static_assert((int)LADDER_STEPS <= (int)DEGRADE_MAX_STEPS, "every ladder must fit");

/* Rows of pictures that hold a tag are not seen, and have no weight. */
static void set_weights(projector_t *projector, const ls_weights_t *weights)
{
    ls_weights_t below = *weights;
    const int32_t hidden = projector->choice.hidden_px;
    for (int32_t y = 0; y + hidden < projector->camera.height; y++)
        below.y[y] = weights->y[y + hidden];
    warp_set_ls_weights(&projector->warp, &below);
}

void projector_init(projector_t *projector, const room_t *room, const room_board_t *board, const hal_board_t *devices,
                    const warp_kernels_t *kernels)
{
    projector->board = *devices;
    projector->node = board->node;
    memcpy(projector->name, board->name, sizeof projector->name);
    projector->unusable = false;
    projector->camera = room->camera;
    projector->wall = board->wall;
    projector->kernels = kernels;
    projector->poses = (can_poses_t){.viewer = board->viewer};
    bus_auth_init(&projector->auth, NULL, board->viewer, 0);
    bus_master_init(&projector->time, (uint8_t)board->node, hal_time_now_us(devices->clock));
    projector->picture_us = hal_time_now_us(devices->clock);
    const frame_choice_settings_t settings = {
        .clock = {.node = (uint8_t)board->node,
                  .rate = room->refresh,
                  .pose_delay_us = room->pose_delay_us,
                  .display_us = board->display_us},
        .rule = room->rule,
        .width = room->camera.width,
        .height = room->camera.height,
    };
    if (!frame_choice_init(&projector->choice, &settings, projector->picture_us))
        projector->choice.rule.mode = POSE_FOR_FRAME_DELAY; /* room_load() refuses such a room */
    projector->report = (projector_report_t){.state = CAN_BOARD_WAITING};
    projector->guessed = 0;
    stage_times_init(&projector->stage_times);
    projector->shown_us = projector->picture_us;
    projector->faults = (projector_faults_t){.camera = 0};
    projector->can_faults = (can_faults_t){.length = 0};
    telemetry_init(&projector->telemetry, projector->picture_us);
    warp_init(&projector->warp, *board->method, board->step_all, board->border);
    set_weights(projector, &board->ls_weights);
    projector->room_method = board->method;
    projector->keeps_method = false;
    projector->ladder = ladder_of(board->method);
    for (int32_t step = 1; step < projector->ladder.steps; step++)
        (void)warp_add_method(&projector->warp, *projector->ladder.method[step]); /* a test holds: all of them fit */
    for (int32_t i = WARP_METHODS - 1; i >= 0; i--) /* what an operator may want, the best first */
        (void)warp_add_method(&projector->warp, warp_methods[i]);
    projector_begin_ladder(projector);
    commands_init(&projector->commands, board->node, room->latency_ms);
    update_init(&projector->update, projector->picture_us);
    event_watch_init(&projector->events, board->node);
}

void projector_use_key(projector_t *projector, can_auth_t *key, uint64_t seed)
{
    bus_auth_init(&projector->auth, key, projector->poses.viewer, seed);
}

/* Keep the camera's newest picture; while it has none, the last good one stays. */
static void take_newest_picture(projector_t *p, int64_t now_us, int64_t blank_us)
{
    const kept_picture_t *newest = frame_choice_newest(&p->choice);
    hal_camera_frame_t frame;
    if (!frame_choice_wants_picture(&p->choice))
        return;
    const hal_status_t status = hal_camera_take(p->board.camera, &frame);
    if (status == HAL_EMPTY)
        return;
    if (status != HAL_OK) {
        p->faults.camera++;
        return;
    }
    const bool again = newest->any && frame.sequence == newest->frame.sequence; /* of a stuck source */
    const bool fits = frame.picture.width == p->camera.width && frame.picture.height == p->camera.height &&
                      frame.picture.format != PICTURE_GRAY8;
    if (again || !fits) {
        p->faults.picture_size += !again;
        hal_camera_release(p->board.camera, &frame);
        return;
    }
    frame_choice_keep(&p->choice, &frame, &p->time, blank_us);
    p->picture_us = now_us;
}

static can_board_state_t state_now(const projector_t *p, int64_t now_us)
{
    if (p->commands.frozen)
        return CAN_BOARD_FROZEN;
    if (p->commands.pattern != COMMAND_PATTERN_NONE)
        return CAN_BOARD_PATTERN;
    if (now_us - p->picture_us > PROJECTOR_CAMERA_LOST_US)
        return CAN_BOARD_FAULT;
    if (!p->poses.any || !p->choice.now.any)
        return CAN_BOARD_WAITING;
    const int64_t pose_age_us = now_us - p->poses.received_us;
    if (pose_age_us > PROJECTOR_SAFE_AFTER_US)
        return CAN_BOARD_SAFE;
    return pose_age_us > PROJECTOR_HOLD_AFTER_US ? CAN_BOARD_HOLDING : CAN_BOARD_RUNNING;
}

/* Warp the refresh's picture for its pose. @return false when that can't be done; the panel is then untouched. */
static bool draw_corrected(projector_t *p, const picture_t *panel)
{
    homography_t homography;
    pose_for_frame_t chosen;
    if (!frame_choice_pose(&chosen, &p->choice, &p->poses, &p->camera))
        return false;
    p->report.pose = chosen.pose;
    p->report.pose_counter = chosen.drawn.counter;
    p->guessed += !chosen.drawn_known;
    const picture_t picture = frame_choice_picture(&p->choice);
    if (!homography_from_pose(&homography, &chosen.camera, &p->wall, &chosen.pose) ||
        !warp_plan(&p->warp, p->kernels, &p->report.warp, &homography, panel, &picture))
        return false;
    warp_steps_run(&p->warp, p->board.workers);
    return true;
}

static void draw(projector_t *p, const picture_t *panel)
{
    const bool wanted = p->report.state == CAN_BOARD_RUNNING || p->report.state == CAN_BOARD_HOLDING;
    p->report.corrected = wanted && draw_corrected(p, panel);
    p->report.safe = (safe_picture_t){p->name, p->node, safe_reason(p)};
    if (wanted && !p->report.corrected)
        p->report.state = CAN_BOARD_FAULT;
    if (p->report.state == CAN_BOARD_PATTERN)
        pattern_picture_draw(panel, p->commands.pattern);
    else if (!p->report.corrected)
        safe_picture_draw(panel, &p->report.safe);
}

/* End a stage that began at begin_us. @return When it ended. */
static int64_t end_stage(projector_t *p, stage_t stage, int64_t begin_us)
{
    const int64_t end_us = hal_time_now_us(p->board.clock);
    p->report.times.us[stage] = end_us - begin_us;
    return end_us;
}

/* Luma and chroma stay apart where the display takes them: best with as much chroma as the picture has. */
static picture_format_t panel_format(const projector_t *p)
{
    const picture_format_t from = p->choice.now.frame.picture.format; /* XRGB8888, all zero bytes, before the first */
    const bool halved = from == PICTURE_NV12;
    const picture_format_t wanted[2] = {halved ? PICTURE_NV12 : PICTURE_YUYV, halved ? PICTURE_YUYV : PICTURE_NV12};
    for (int i = 0; i < 2 && picture_is_yuv(from); i++)
        if (hal_display_takes(p->board.display, wanted[i]))
            return wanted[i];
    return PICTURE_XRGB8888;
}

/* A new picture on the wall from the vertical blank at deadline_us on. @return Is the loop healthy? */
static bool show(projector_t *p, int64_t begin_us, int64_t deadline_us)
{
    picture_t panel;
    hal_status_t status =
        hal_display_back_buffer(p->board.display, panel_format(p), p->choice.now.frame.picture.matrix, &panel);
    if (status == HAL_OK)
        draw(p, &panel);
    const int64_t drawn_us = end_stage(p, STAGE_WARP, begin_us);
    if (status == HAL_OK)
        status = hal_display_present(p->board.display);
    p->shown_us = end_stage(p, STAGE_SHOW, drawn_us);

    p->report.times.shown = status == HAL_OK;
    p->report.times.late = p->report.times.shown && p->shown_us > deadline_us;
    if (status == HAL_OK) {
        p->report.frame_number++;
        p->faults.deadline += p->report.times.late;
    } else {
        p->faults.display++;
        p->report.state = CAN_BOARD_FAULT;
    }
    return status == HAL_OK || status == HAL_IO;
}

/* The wall keeps what it shows. @return As show(). */
static bool keep(projector_t *p, int64_t begin_us)
{
    p->report.corrected = p->report.times.shown = p->report.times.late = false;
    p->shown_us = end_stage(p, STAGE_SHOW, end_stage(p, STAGE_WARP, begin_us));
    return true;
}

/* What is on the wall from the next blank on; certain only when it got there in time. */
static void note_agreement(projector_t *p)
{
    can_step_t *agreement = &p->report.agreement;
    *agreement = frame_choice_report(&p->choice);
    const bool in_time = p->report.corrected && p->report.times.shown && !p->report.times.late;
    p->report.fault = frame_choice_fault(&p->choice);
    if (p->report.fault == CAN_STEP_OK && !in_time)
        p->report.fault = CAN_STEP_NOT_SHOWN;
    agreement->in_step = p->report.fault == CAN_STEP_OK;
    const int32_t off_us = p->choice.step.off_us,
                  late_us = p->report.times.late ? frame_rate_period_us(p->choice.clock.rate) : 0;
    p->report.pose_to_photon_us =
        (int32_t)(frame_choice_shown_us(&p->choice) - (int64_t)agreement->pose_us) + off_us + late_us;
    if (p->report.corrected && agreement->pose_us != 0)
        telemetry_add_photon(&p->telemetry, p->report.pose_to_photon_us);
}

void projector_step(projector_t *p)
{
    const int64_t now_us = end_stage(p, STAGE_WAIT, p->shown_us);
    projector_drive(p, HAL_GPIO_STROBE, true);
    const bus_receivers_t receivers = {&p->poses,         &p->time,       &p->choice.clock,
                                       &p->commands.link, &p->can_faults, &p->auth};
    bus_receive(&receivers, p->board.can); /* bus -> checked poses, bus time, numbers of refreshes, requests */
    if (bus_auth_may_speak(&p->auth))
        bus_master_step(&p->time, p->board.can, now_us); /* bus time -> bus, when it is this board's turn */
    commands_step(p, now_us);                            /* requests -> what is shown from now on, replies */
    const int64_t blank_us = hal_display_next_vblank_us(p->board.display) - frame_rate_period_us(p->choice.clock.rate);
    take_newest_picture(p, now_us, blank_us); /* camera -> newest picture, or the last good one */
    p->faults.gpio += !frame_choice_take_edges(&p->choice, p->board.gpio);
    p->choice.wanted_ms = p->commands.wanted_latency_ms;
    frame_choice_step(&p->choice, &p->poses, &p->time, p->board.can, p->board.camera, blank_us);
    bus_auth_sign(&p->auth, &p->time, &p->choice.clock, p->board.can, now_us); /* with a key: codes -> bus */
    take_newest_picture(p, now_us, blank_us); /* when there was no room for it before */
    p->report.state = state_now(p, now_us);
    const int64_t posed_us = end_stage(p, STAGE_POSE, now_us);
    const int64_t deadline_us = hal_display_next_vblank_us(p->board.display);
    /* pose and picture -> homography, grid, prefilter, resample -> display */
    const bool healthy = p->report.state == CAN_BOARD_FROZEN ? keep(p, posed_us) : show(p, posed_us, deadline_us);
    note_agreement(p);
    stage_times_add(&p->stage_times, &p->report.times);
    projector_choose_method(p, deadline_us - now_us); /* what this one took -> the next picture's method */
    projector_drive(p, HAL_GPIO_STROBE, false);
    projector_light(p, now_us); /* -> LED, lamp */
    telemetry_send(p, now_us);  /* what was shown, and how the board does -> bus */
    event_watch_step(p, now_us);
    projector_tell_life(p, can_board_state_name(p->report.state), healthy, now_us); /* -> watchdog, service manager */
    update_step(p, now_us);                                                         /* -> update agent */
}
