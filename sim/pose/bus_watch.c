// SPDX-License-Identifier: Apache-2.0
// Sorts frames by what they say, with the firmware's own decoders, and keeps what people ask about.
#include "sim/pose/bus_watch.h"

#include <math.h>
#include <stddef.h>

#include "firmware/can_auth.h"
#include "firmware/command.h"
#include "sim/bus/sim_can_bits.h"

enum { MILLION = 1000000 };

void bus_watch_init(bus_watch_t *watch, int32_t bitrate, int32_t data_bitrate)
{
    *watch = (bus_watch_t){.bitrate = bitrate, .data_bitrate = data_bitrate, .load_ppm = -1, .worst_load_ppm = -1};
    for (uint8_t v = 0; v < CAN_VIEWERS; v++)
        watch->viewer[v].receiver.viewer = v;
}

static void note_event(bus_watch_rhythm_t *rhythm, int64_t time_us)
{
    if (rhythm->count > 0) {
        const int64_t interval_us = time_us - rhythm->last_us;
        rhythm->sum_us += (double)interval_us;
        rhythm->sum_of_squares += (double)interval_us * (double)interval_us;
        if (interval_us > rhythm->longest_us)
            rhythm->longest_us = interval_us;
    }
    rhythm->count++;
    rhythm->last_us = time_us;
}

double bus_watch_mean_us(const bus_watch_rhythm_t *rhythm)
{
    return rhythm->count < 2 ? 0 : rhythm->sum_us / (double)(rhythm->count - 1);
}

double bus_watch_jitter_us(const bus_watch_rhythm_t *rhythm)
{
    if (rhythm->count < 2)
        return 0;
    const double mean = bus_watch_mean_us(rhythm);
    return sqrt(fmax(rhythm->sum_of_squares / (double)(rhythm->count - 1) - mean * mean, 0));
}

/* Whole windows that have gone by become the load; empty ones count too. */
static void note_load(bus_watch_t *watch, const hal_can_frame_t *frame)
{
    const sim_can_bits_t bits = sim_can_bits(frame);
    const double busy_us =
        (double)bits.arbitration * MILLION / watch->bitrate + (double)bits.data * MILLION / watch->data_bitrate;
    const int64_t windows = (frame->time_us - watch->window_start_us) / BUS_WATCH_WINDOW_US;
    if (windows > 0) {
        watch->load_ppm = windows > 1 ? 0 : (int32_t)(watch->window_busy_us * MILLION / BUS_WATCH_WINDOW_US);
        const int32_t full_ppm = (int32_t)(watch->window_busy_us * MILLION / BUS_WATCH_WINDOW_US);
        watch->worst_load_ppm = full_ppm > watch->worst_load_ppm ? full_ppm : watch->worst_load_ppm;
        watch->window_start_us += windows * BUS_WATCH_WINDOW_US;
        watch->window_busy_us = 0;
    }
    watch->busy_us += busy_us;
    watch->window_busy_us += busy_us;
}

/* The tracker's time goes on from the last pose by what is left of the wrap, and back by less than half of it. */
static void note_capture(bus_watch_viewer_t *viewer, bool fd)
{
    const int64_t wrap_us = (int64_t)(fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US),
                  now_us = viewer->receiver.received_us, wrapped_us = (int64_t)viewer->receiver.newest.capture_time_us;
    if (viewer->poses.count == 1 || (fd ? viewer->set : viewer->fd)) { /* the two messages' times do not compare */
        viewer->capture_us = wrapped_us;
        viewer->least_us = viewer->most_us = now_us - wrapped_us;
        return;
    }
    int64_t forward_us = (wrapped_us - viewer->capture_us) % wrap_us;
    if (forward_us < 0)
        forward_us += wrap_us;
    if (forward_us >= wrap_us / 2) {
        forward_us -= wrap_us;
        viewer->captured_back++;
    }
    viewer->captured |= forward_us != 0;
    viewer->capture_us += forward_us;
    const int64_t delay_us = now_us - viewer->capture_us;
    viewer->least_us = delay_us < viewer->least_us ? delay_us : viewer->least_us;
    viewer->most_us = delay_us > viewer->most_us ? delay_us : viewer->most_us;
}

/* As boards, it believes a capture time only when bus time is a tracker's, and when it lies not long before now. */
static void note_delay(bus_watch_viewer_t *viewer, const bus_master_t *clock, uint64_t wrap_us)
{
    const int64_t local_us = viewer->receiver.received_us, now_us = bus_time_from_local(&clock->time, local_us);
    const int64_t delay_us = now_us - bus_time_extend(now_us, viewer->receiver.newest.capture_time_us, wrap_us);
    if (clock->origin != BUS_MASTER_TRACKER || !bus_master_knows(clock, local_us) ||
        delay_us < -POSE_FROM_CAN_AHEAD_US || delay_us > POSE_FROM_CAN_OLDEST_US)
        return;
    viewer->delay_most_us = viewer->delays > 0 && viewer->delay_most_us > delay_us ? viewer->delay_most_us : delay_us;
    viewer->delay_sum_us += delay_us;
    viewer->delays++;
}

static bool take_pose(bus_watch_viewer_t *viewer, const bus_master_t *clock, const hal_can_frame_t *frame)
{
    /* A good pose leaves its time here, and all times of frames are later than this one. */
    viewer->receiver.received_us = INT64_MIN;
    if (!pose_from_frame(&viewer->receiver, NULL, frame, &viewer->faults))
        return false;
    const bool fd = frame->id < CAN_ID_POSE_SET;
    viewer->fd |= fd;
    viewer->set |= !fd;
    if (viewer->receiver.received_us != INT64_MIN) {
        note_event(&viewer->poses, frame->time_us);
        note_capture(viewer, fd);
        note_delay(viewer, clock, fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US);
    }
    return true;
}

static void take_heartbeat(bus_watch_board_t *board, const can_heartbeat_t *heartbeat, int64_t time_us)
{
    if (board->heartbeats.count > 0 && heartbeat->uptime_s < board->heartbeat.uptime_s) {
        board->restarts++;
        board->has_counts = false;
    }
    board->heartbeat = *heartbeat;
    note_event(&board->heartbeats, time_us);
}

static void take_counts(bus_watch_board_t *board, const can_counts_t *counts)
{
    if (!board->has_counts)
        board->first_counts = *counts;
    board->has_counts = true;
    board->counts = *counts;
}

static void take_step(bus_watch_t *watch, const can_step_t *step, int64_t time_us)
{
    bus_watch_board_t *board = &watch->board[step->node];
    board->step = *step;
    board->steps++;
    board->in_step += step->in_step;
    step_watch_take(&watch->steps, step, time_us);
}

/* @return What the decoders of the boards' reports found. */
static can_check_t take_report(bus_watch_t *watch, const hal_can_frame_t *frame)
{
    can_heartbeat_t heartbeat;
    can_check_t check = can_heartbeat_decode(&heartbeat, frame);
    if (check == CAN_CHECK_OK)
        take_heartbeat(&watch->board[heartbeat.node], &heartbeat, frame->time_us);
    can_status_t status;
    if (check == CAN_CHECK_OTHER && (check = can_status_decode(&status, frame)) == CAN_CHECK_OK) {
        watch->board[status.node].status = status;
        watch->board[status.node].has_status = true;
    }
    can_quality_t quality;
    if (check == CAN_CHECK_OTHER && (check = can_quality_decode(&quality, frame)) == CAN_CHECK_OK) {
        watch->board[quality.node].quality = quality;
        watch->board[quality.node].has_quality = true;
    }
    can_time_t time;
    if (check == CAN_CHECK_OTHER && (check = can_time_decode(&time, frame)) == CAN_CHECK_OK) {
        watch->board[time.node].time = time;
        watch->board[time.node].has_time = true;
    }
    can_step_t step;
    if (check == CAN_CHECK_OTHER && (check = can_step_decode(&step, frame)) == CAN_CHECK_OK)
        take_step(watch, &step, frame->time_us);
    can_latency_t latency;
    if (check == CAN_CHECK_OTHER && (check = can_latency_decode(&latency, frame)) == CAN_CHECK_OK) {
        watch->board[latency.node].latency = latency;
        watch->board[latency.node].has_latency = true;
    }
    can_counts_t counts;
    if (check == CAN_CHECK_OTHER && (check = can_counts_decode(&counts, frame)) == CAN_CHECK_OK)
        take_counts(&watch->board[counts.node], &counts);
    can_update_t update;
    if (check == CAN_CHECK_OTHER && (check = can_update_decode(&update, frame)) == CAN_CHECK_OK) {
        watch->board[update.node].update = update;
        watch->board[update.node].has_update = true;
    }
    can_stage_t stage;
    return check == CAN_CHECK_OTHER ? can_stage_decode(&stage, frame) : check;
}

static void take_sync(bus_watch_time_t *time, const can_sync_t *sync)
{
    time->alone += time->awaited[sync->number] != 0;
    time->awaited[sync->number] = (int8_t)(sync->counter + 1);
    time->origins[sync->number] = sync->origin;
}

static void take_follow_up(bus_watch_time_t *time, const can_follow_up_t *follow_up, int64_t time_us)
{
    const uint8_t number = follow_up->number;
    if (time->awaited[number] != follow_up->counter + 1)
        return;
    time->awaited[number] = 0;
    time->changes += time->pairs.count > 0 && time->master != number;
    time->master = number;
    time->origin = time->origins[number];
    note_event(&time->pairs, time_us);
}

/* @return What the decoders of bus time and of the numbers of refreshes found. */
static can_check_t take_time(bus_watch_t *watch, const hal_can_frame_t *frame)
{
    (void)bus_master_hear(&watch->clock, frame); /* the same check again */
    can_sync_t sync;
    can_check_t check = can_sync_decode(&sync, frame);
    if (check == CAN_CHECK_OK)
        take_sync(&watch->time, &sync);
    can_follow_up_t follow_up;
    if (check == CAN_CHECK_OTHER && (check = can_follow_up_decode(&follow_up, frame)) == CAN_CHECK_OK)
        take_follow_up(&watch->time, &follow_up, frame->time_us);
    can_frame_clock_t clock;
    if (check == CAN_CHECK_OTHER && (check = can_frame_clock_decode(&clock, frame)) == CAN_CHECK_OK && !clock.to_come) {
        watch->frame_clock = clock;
        watch->has_frame_clock = true;
    }
    return check;
}

bool bus_watch_heard(const bus_watch_board_t *board)
{
    return board->heartbeats.count > 0 || board->has_status || board->has_quality || board->has_time ||
           board->steps > 0 || board->has_latency;
}

/* Requests to boards and their replies, which no decoder judges. */
static bool is_command(const hal_can_frame_t *frame)
{
    const uint32_t node = frame->id & CAN_MAX_NODE, base = frame->id - node;
    return !frame->extended && node != 0 && (base == CAN_ID_COMMAND || base == CAN_ID_REPLY);
}

/* A code behind a message, which only who knows key and session could judge. */
static bool is_code(const hal_can_frame_t *frame)
{
    const uint32_t node = frame->id & CAN_MAX_NODE, base = frame->id - node;
    const uint32_t set = frame->id - CAN_AUTH_ID_POSE_SET;
    return !frame->extended && (base == CAN_AUTH_ID_TIME || base == CAN_AUTH_ID_FRAME_CLOCK ||
                                base == CAN_AUTH_ID_LATENCY || (set % 4 == 0 && set / 4 < CAN_VIEWERS));
}

/* A signed FD pose as it is without its code. */
static hal_can_frame_t plain_frame(const hal_can_frame_t *frame)
{
    hal_can_frame_t plain = *frame;
    const bool coded = !frame->extended && frame->id - CAN_AUTH_ID_POSE_FD < CAN_VIEWERS;
    if (coded && frame->fd && frame->length == CAN_AUTH_FD_SIGNED) {
        plain.id -= CAN_AUTH_ID_POSE_FD - CAN_ID_POSE_FD;
        plain.length = CAN_AUTH_FD_PLAIN;
    }
    return plain;
}

void bus_watch_take(bus_watch_t *watch, const hal_can_frame_t *frame)
{
    if (watch->frames == 0) {
        watch->first_us = watch->window_start_us = frame->time_us;
        bus_master_init(&watch->clock, CAN_MAX_NODE, frame->time_us); /* of any node that is no tracker */
    }
    watch->frames++;
    watch->last_us = frame->time_us;
    note_load(watch, frame);
    const hal_can_frame_t plain = plain_frame(frame);
    for (int v = 0; v < CAN_VIEWERS; v++)
        if (take_pose(&watch->viewer[v], &watch->clock, &plain))
            return;
    can_check_t check = take_report(watch, frame);
    if (check == CAN_CHECK_OTHER)
        check = take_time(watch, frame);
    watch->unknown += check == CAN_CHECK_OTHER && !is_command(frame) && !is_code(frame);
    watch->damaged += check != CAN_CHECK_OTHER && check != CAN_CHECK_OK;
}
