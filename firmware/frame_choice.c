// SPDX-License-Identifier: Apache-2.0
// Bus time, camera and poses -> the picture and the pose that belong to this refresh.
#include "firmware/frame_choice.h"

#include <stddef.h>

enum { MOST_EDGES = 32 /* a line that rings must not hold the loop */ };

bool frame_choice_init(frame_choice_t *choice, const frame_choice_settings_t *settings, int64_t now_us)
{
    *choice = (frame_choice_t){.rule = settings->rule};
    frame_clock_init(&choice->clock, &settings->clock, now_us);
    if (settings->rule.mode != POSE_FOR_FRAME_TAG)
        return true;
    frame_tag_layout_t layout;
    if (!frame_tag_layout(&layout, settings->width, settings->height))
        return false;
    choice->hidden_px = layout.hidden_px;
    return true;
}

bool frame_choice_wants_picture(const frame_choice_t *choice)
{
    return choice->waiting_count < FRAME_CHOICE_WAITING;
}

const kept_picture_t *frame_choice_newest(const frame_choice_t *choice)
{
    return choice->waiting_count > 0 ? &choice->waiting[choice->waiting_count - 1] : &choice->now;
}

static bool time_is_known(const bus_master_t *time, int64_t now_us)
{
    return bus_master_error_us(time, now_us) <= FRAME_CHOICE_TIME_US;
}

void frame_choice_keep(frame_choice_t *choice, const hal_camera_frame_t *frame, const bus_master_t *time,
                       int64_t blank_us)
{
    kept_picture_t kept = {.any = true, .frame = *frame};
    kept.capture_us = bus_time_from_local(&time->time, frame->capture_time_us);
    if (choice->hidden_px > 0) {
        kept.tagged = frame_tag_decode(&kept.tag, &frame->picture) == FRAME_TAG_OK;
        choice->tags_lost += !kept.tagged;
    }
    const kept_picture_t *newest = frame_choice_newest(choice);
    if (newest->any)
        choice->interval_us = kept.capture_us - newest->capture_us;
    choice->waiting[choice->waiting_count++] = kept;
    if (time_is_known(time, blank_us))
        picture_lag_add(&choice->lag, (int32_t)(blank_us - frame->capture_time_us),
                        frame_rate_period_us(choice->clock.rate));
}

bool frame_choice_take_edges(frame_choice_t *choice, hal_gpio_t *gpio)
{
    for (int i = 0; i < MOST_EDGES; i++) {
        int64_t edge_us = 0;
        const hal_status_t status = hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &edge_us);
        if (status != HAL_OK)
            return status == HAL_EMPTY;
        choice->house_any = true;
        choice->house_us = edge_us;
    }
    return true;
}

/* The oldest that waits is shown from now on. */
static void show_next(frame_choice_t *choice, hal_camera_t *camera)
{
    if (choice->now.any)
        hal_camera_release(camera, &choice->now.frame);
    choice->now = choice->waiting[0];
    choice->waiting_count--;
    for (int32_t i = 0; i < choice->waiting_count; i++)
        choice->waiting[i] = choice->waiting[i + 1];
}

/* A picture is due when it was captured up to the limit; without one, as soon as it is here. */
static void choose_picture(frame_choice_t *choice, hal_camera_t *camera)
{
    const int64_t limit_us = choice->step.in_step ? choice->step.picture_limit_us : INT64_MAX;
    while (choice->waiting_count > 0 && (!choice->now.any || choice->waiting[0].capture_us <= limit_us))
        show_next(choice, camera);
    if (!choice->now.any || !choice->step.in_step) {
        choice->picture_certain = false;
        return;
    }
    const int64_t before_us = limit_us - choice->now.capture_us,
                  after_us = choice->waiting_count > 0 ? choice->waiting[0].capture_us - limit_us
                                                       : choice->interval_us * 3 / 4 - before_us;
    choice->picture_certain = before_us > FRAME_CHOICE_EDGE_US && after_us > FRAME_CHOICE_EDGE_US;
}

static void choose_poses(frame_choice_t *choice, const can_poses_t *poses)
{
    choice->history = poses->history;
    choice->pose_certain = choice->step.in_step && poses->captured &&
                           pose_history_until(&choice->history, choice->step.pose_limit_us, poses->counters);
    if (choice->history.count == 0)
        choice->history = poses->history; /* an old pose is better than none */
}

void frame_choice_step(frame_choice_t *choice, const can_poses_t *poses, const bus_master_t *time, hal_can_t *can,
                       hal_camera_t *camera, int64_t blank_us)
{
    const int64_t blank_bus_us = bus_time_from_local(&time->time, blank_us);
    choice->genlocked = choice->house_any && blank_us - choice->house_us < FRAME_CHOICE_HOUSE_US;
    if (blank_us - frame_choice_newest(choice)->frame.capture_time_us > FRAME_CHOICE_CAMERA_US)
        choice->lag = (picture_lag_t){.lag_us = 0};
    const frame_blank_t blank = {
        .now_us = blank_us,
        .blank_us = blank_bus_us,
        .bus_time_known = time_is_known(time, blank_us),
        .genlocked = choice->genlocked,
        .house_us = bus_time_from_local(&time->time, choice->house_us),
        .lag_us = choice->lag.lag_us,
        .wanted_ms = choice->wanted_ms,
    };
    choice->step = frame_clock_step(&choice->clock, can, &blank);
    choose_picture(choice, camera);
    choose_poses(choice, poses);
}

int64_t frame_choice_shown_us(const frame_choice_t *choice)
{
    const int32_t period_us = frame_rate_period_us(choice->clock.rate);
    return choice->step.start_us + (choice->step.held + 1) * period_us + period_us / 2 + choice->clock.display_us;
}

bool frame_choice_pose(pose_for_frame_t *chosen, const frame_choice_t *choice, const can_poses_t *poses,
                       const camera_t *camera)
{
    const bool fd = poses->counters == CAN_E2E_P05_COUNTERS;
    const pose_for_frame_picture_t picture = {
        .picture_us = choice->now.capture_us,
        .shown_us = frame_choice_shown_us(choice),
        .tagged = choice->now.tagged && choice->now.tag.viewer == poses->viewer,
        .tag = choice->now.tag,
        .wrap_us = fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US,
    };
    const camera_t below = frame_tag_camera_below(camera, choice->hidden_px);
    return pose_for_frame(chosen, &choice->history, &below, &choice->rule, &picture);
}

picture_t frame_choice_picture(const frame_choice_t *choice)
{
    return frame_tag_picture_below(&choice->now.frame.picture, choice->hidden_px);
}

can_step_fault_t frame_choice_fault(const frame_choice_t *choice)
{
    if (choice->step.fault != CAN_STEP_OK)
        return choice->step.fault;
    return !choice->picture_certain ? CAN_STEP_PICTURE : !choice->pose_certain ? CAN_STEP_POSE : CAN_STEP_OK;
}

can_step_t frame_choice_report(const frame_choice_t *choice)
{
    const pose_at_t *newest = pose_history_back(&choice->history, 0);
    return (can_step_t){
        .in_step = frame_choice_fault(choice) == CAN_STEP_OK,
        .tagged = choice->now.tagged,
        .refresh = (uint32_t)choice->step.content,
        .picture = choice->now.tagged ? choice->now.tag.frame_number
                                      : (uint32_t)frame_clock_picture_number(&choice->clock, &choice->step.epoch,
                                                                             choice->now.capture_us),
        .pose_us = newest == NULL || newest->time_us < 0 ? 0 : (uint64_t)newest->time_us,
    };
}
