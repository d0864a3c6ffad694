// SPDX-License-Identifier: Apache-2.0
// What a board with a key believes of what it hears: frames wait until the code of their message has come.
#include <string.h>

#include "firmware/bus_auth.h"
#include "firmware/can_classic.h"
#include "firmware/can_frame_clock.h"
#include "firmware/can_latency.h"

enum { CLASSIC_LENGTH = 8, PAIR_FRAMES = 2 };

_Static_assert((int)CAN_ID_SYNC + 64 == (int)CAN_ID_FOLLOW_UP && (int)CAN_ID_FOLLOW_UP + 64 == (int)CAN_AUTH_ID_TIME &&
                   (int)CAN_ID_FRAME_CLOCK + 64 == (int)CAN_AUTH_ID_FRAME_CLOCK &&
                   (int)CAN_ID_LATENCY + 64 == (int)CAN_AUTH_ID_LATENCY,
               "one range of identifiers follows the other");

static void count(can_faults_t *faults, can_auth_result_t result)
{
    switch (result) {
    case CAN_AUTH_OTHER:
        faults->auth_unsigned++;
        break;
    case CAN_AUTH_FORGED:
        faults->auth_forged++;
        break;
    case CAN_AUTH_REPLAYED:
        faults->auth_replayed++;
        break;
    case CAN_AUTH_STALE:
        faults->auth_stale++;
        break;
    case CAN_AUTH_EARLY:
        faults->auth_early++;
        break;
    case CAN_AUTH_OK:
    case CAN_AUTH_RESULTS:
        break;
    }
}

/* Another has begun: what was there has no code and will have none. */
static void begin(bus_auth_message_t *message, can_faults_t *faults)
{
    message->uncoded += message->whole;
    if (message->uncoded > BUS_AUTH_MOST_UNCODED) {
        faults->auth_unsigned += (uint32_t)message->uncoded;
        message->uncoded = 0;
    }
    message->frames = 0;
    message->whole = false;
}

/* A message is believed. Those before it without a code were the sender's as far as he has made more than were
 * believed: their codes were lost. The rest is of strangers. */
static void settle(bus_auth_message_t *message, int frames, can_faults_t *faults)
{
    uint32_t lost = 0;
    (void)can_e2e_step(message->newest, can_classic_counter(&message->frame[0]), CAN_E2E_P01_COUNTERS, &lost);
    const uint32_t uncoded = (uint32_t)message->uncoded, torn = (uint32_t)message->torn;
    lost = lost > torn ? lost - torn : 0;
    lost = lost < uncoded ? lost : uncoded;
    faults->auth_lost += lost;
    faults->auth_unsigned += uncoded - lost;
    message->uncoded = message->torn = 0;
    message->newest = can_classic_counter(&message->frame[frames - 1]);
}

/* One frame of `frames` in their order; what comes out of order is of no message. */
static void collect(bus_auth_message_t *message, const hal_can_frame_t *frame, int part, int frames,
                    can_faults_t *faults)
{
    if (part == 0 || message->whole)
        begin(message, faults);
    if (message->frames == part) {
        message->frame[message->frames++] = *frame;
        message->whole = message->frames == frames;
    }
}

/* While a change is announced, the epoch to come and the one that holds are one message. */
static void collect_epoch(bus_auth_message_t *message, const hal_can_frame_t *frame, can_faults_t *faults)
{
    can_frame_clock_t clock = {.to_come = false};
    (void)can_frame_clock_decode(&clock, frame);
    const bool second = clock.changes && !clock.to_come;
    collect(message, frame, second ? 1 : 0, clock.to_come || second ? 2 : 1, faults);
}

/* The code has come. @return Frames that are believed. */
static int judge(bus_auth_t *auth, can_auth_stream_t *stream, bus_auth_message_t *message, const hal_can_frame_t *tag,
                 hal_can_frame_t *believed, can_faults_t *faults)
{
    if (message->whole && tag->time_us - message->frame[0].time_us > BUS_AUTH_CODE_US)
        begin(message, faults); /* this is the code of the next, which was lost */
    const int frames = message->frames;
    const bool whole = message->whole;
    message->frames = 0;
    message->whole = false;
    if (!whole) {
        faults->incomplete_set++;
        message->torn++;
        return 0;
    }
    const can_auth_window_t window = auth_clock_window(&auth->clock, tag->time_us);
    const can_auth_message_t signed_message = {message->frame, frames, tag->id};
    const can_auth_result_t result = can_auth_check(auth->key, stream, &window, &signed_message, tag);
    count(faults, result);
    if (result != CAN_AUTH_OK)
        return 0;
    auth_clock_hear(&auth->clock, stream->newest_us, tag->time_us);
    settle(message, frames, faults);
    memcpy(believed, message->frame, (size_t)frames * sizeof *believed);
    return frames;
}

static int take_fd(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults)
{
    const can_auth_window_t window = auth_clock_window(&auth->clock, frame->time_us);
    hal_can_frame_t plain = *frame;
    plain.id = CAN_ID_POSE_FD + (uint32_t)auth->viewer;
    const can_auth_result_t result = can_auth_check_fd(auth->key, &auth->fd, &window, &plain);
    count(faults, result);
    if (result != CAN_AUTH_OK)
        return 0;
    auth_clock_hear(&auth->clock, auth->fd.newest_us, frame->time_us);
    auth->tracker_us = frame->time_us;
    *believed = plain;
    return 1;
}

static int take_set(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults)
{
    const int part = (int)(frame->id - CAN_ID_POSE_SET) % (CAN_POSE_PARTS + 1);
    if (part < CAN_POSE_PARTS) {
        collect(&auth->set_parts, frame, part, CAN_POSE_PARTS, faults);
        return 0;
    }
    const int frames = judge(auth, &auth->set, &auth->set_parts, frame, believed, faults);
    if (frames > 0)
        auth->tracker_us = frame->time_us;
    return frames;
}

static int take_time(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults)
{
    const uint32_t number = frame->id & CAN_MAX_NODE;
    bus_auth_message_t *pair = &auth->pair[number];
    if (frame->id < CAN_AUTH_ID_TIME) {
        collect(pair, frame, frame->id < CAN_ID_FOLLOW_UP ? 0 : 1, PAIR_FRAMES, faults);
        return 0;
    }
    const int frames = judge(auth, &auth->time[number], pair, frame, believed, faults);
    if (frames > 0 && number == BUS_MASTER_TRACKER)
        auth->tracker_us = frame->time_us;
    return frames;
}

static int take_frame_clock(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed,
                            can_faults_t *faults)
{
    const uint32_t node = frame->id & CAN_MAX_NODE;
    if (frame->id >= CAN_AUTH_ID_FRAME_CLOCK)
        return judge(auth, &auth->frame_clock[node], &auth->epochs[node], frame, believed, faults);
    collect_epoch(&auth->epochs[node], frame, faults);
    return 0;
}

static int take_latency(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults)
{
    const uint32_t node = frame->id & CAN_MAX_NODE;
    if (frame->id >= CAN_AUTH_ID_LATENCY)
        return judge(auth, &auth->latency[node], &auth->latencies[node], frame, believed, faults);
    collect(&auth->latencies[node], frame, 0, 1, faults);
    return 0;
}

static bool is_from(uint32_t id, uint32_t base, uint32_t count)
{
    return id >= base && id - base < count;
}

typedef int take_fn(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults);

static int refuse_plain(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t *believed, can_faults_t *faults)
{
    (void)auth;
    (void)frame;
    (void)believed;
    faults->auth_unsigned++;
    return 0;
}

/* NULL: it needs no code. */
static take_fn *taker_of(const bus_auth_t *auth, uint32_t id)
{
    enum { NODES = CAN_MAX_NODE + 1, SET = CAN_POSE_PARTS + 1 };
    if (id == CAN_ID_POSE_FD + (uint32_t)auth->viewer)
        return refuse_plain;
    if (id == CAN_AUTH_ID_POSE_FD + (uint32_t)auth->viewer)
        return take_fd;
    if (is_from(id, CAN_ID_POSE_SET + (uint32_t)(SET * auth->viewer), SET))
        return take_set;
    if (is_from(id, CAN_ID_SYNC, 3 * NODES)) /* Sync, FollowUp, code */
        return take_time;
    if (is_from(id, CAN_ID_FRAME_CLOCK, 2 * NODES)) /* it, and its code */
        return take_frame_clock;
    return is_from(id, CAN_ID_LATENCY, 2 * NODES) ? take_latency : NULL;
}

int bus_auth_take(bus_auth_t *auth, const hal_can_frame_t *frame, hal_can_frame_t believed[CAN_AUTH_MAX_FRAMES],
                  can_faults_t *faults)
{
    take_fn *take = auth->key == NULL || frame->own || frame->extended ? NULL : taker_of(auth, frame->id);
    if (take == NULL) {
        believed[0] = *frame;
        return 1;
    }
    if (!auth->has_session)
        return 0;
    if (take != take_fd && (frame->fd || frame->length != CLASSIC_LENGTH))
        take = refuse_plain;
    return take(auth, frame, believed, faults);
}
