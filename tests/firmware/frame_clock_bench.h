// SPDX-License-Identifier: Apache-2.0
// Eight boards' frame clocks on a made-up bus, for tests: what they send is delivered, or lost.
#ifndef TESTS_FIRMWARE_FRAME_CLOCK_BENCH_H
#define TESTS_FIRMWARE_FRAME_CLOCK_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/frame_clock.h"
#include "tests/support/rng.h"

enum { BOARDS = 8, MOST_SENT = 16, MS = 1000, BUS_ERROR_US = 100, DELAY_US = 2000, CONTENTS = 16 };

/* A board: its clock differs from bus time, its idea of bus time by BUS_ERROR_US at most. */
struct hal_can {
    frame_clock_t clock;
    frame_step_t step;
    bool absent; /* nothing of it gets out or comes in */
    int32_t display_us, wanted_ms;
    int32_t late_us; /* its camera, after the others' */
    int64_t offset_us, bus_error_us;
    int sent;
    hal_can_frame_t out[MOST_SENT];
};

typedef struct {
    hal_can_t board[BOARDS];
    frame_rate_t rate;
    rng_t rng;
    int32_t drift_ppm; /* of all panels, which are genlocked */
    int32_t loss_ppm;
    int32_t lag_us;       /* of the video: capture of the newest picture to the blank */
    int32_t house_off_us; /* edges of a house signal after the blanks; 0: there is none */
    int64_t refresh;
    int64_t blank_us;               /* bus time of the newest */
    frame_step_t content[CONTENTS]; /* the newest contents, each as the first board in step had it */
} room_t;

hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame)
{
    if (can->sent == MOST_SENT)
        return HAL_FULL;
    can->out[can->sent++] = *frame;
    return HAL_OK;
}

static inline int64_t between(rng_t *rng, int64_t low, int64_t high)
{
    return low + (int64_t)(rng_next(rng) % (uint64_t)(high - low + 1));
}

static inline room_t *new_room(uint64_t seed, frame_rate_t rate)
{
    static room_t room;
    room = (room_t){.rng = {seed}, .rate = rate, .blank_us = 1000000000, .lag_us = 20 * MS};
    for (int i = 0; i < BOARDS; i++) {
        hal_can_t *board = &room.board[i];
        board->offset_us = between(&room.rng, 0, INT64_C(1) << 40);
        const frame_clock_settings_t settings = {.node = (uint8_t)(i + 1), .rate = rate, .pose_delay_us = DELAY_US};
        frame_clock_init(&board->clock, &settings, room.blank_us + board->offset_us);
    }
    return &room;
}

static inline void deliver(room_t *room, int from, hal_can_frame_t frame)
{
    for (int i = 0; i < BOARDS; i++) {
        hal_can_t *board = &room->board[i];
        frame.own = i == from;
        const bool lost = i != from && between(&room->rng, 0, 999999) < room->loss_ppm;
        if (!board->absent && !lost)
            assert_int_equal(frame_clock_hear(&board->clock, &frame, room->blank_us + 3 * MS + board->offset_us,
                                              room->blank_us + 3 * MS + board->bus_error_us),
                             CAN_CHECK_OK);
    }
}

static inline void send_latency(hal_can_t *board, const frame_blank_t *blank)
{
    const can_latency_t latency = {.node = board->clock.node,
                                   .lag_us = (uint32_t)blank->lag_us,
                                   .display_us = (uint32_t)board->clock.display_us,
                                   .wanted_ms = (uint32_t)blank->wanted_ms};
    hal_can_frame_t frame;
    assert_true(can_latency_encode(&frame, &latency));
    if (hal_can_send(board, &frame) != HAL_OK) /* as when its cable is pulled */
        assert_int_equal(board->sent, MOST_SENT);
}

/* One refresh of every board; then what they have sent goes over the bus. */
static inline void refresh(room_t *room)
{
    const int64_t turns = room->refresh / room->rate.frames, rest = room->refresh % room->rate.frames;
    const int64_t length_us = (turns * room->rate.frames + rest) * room->rate.seconds * 1000000 / room->rate.frames;
    room->refresh++;
    room->blank_us = 1000007777 + length_us + length_us / 1000 * room->drift_ppm / 1000;
    for (int i = 0; i < BOARDS; i++) {
        hal_can_t *board = &room->board[i];
        board->bus_error_us = between(&room->rng, -BUS_ERROR_US, BUS_ERROR_US);
        const frame_blank_t blank = {.now_us = room->blank_us + board->offset_us,
                                     .blank_us = room->blank_us + board->bus_error_us,
                                     .bus_time_known = true,
                                     .genlocked = room->house_off_us != 0,
                                     .house_us = room->blank_us + room->house_off_us,
                                     .lag_us = room->lag_us + board->late_us + (int32_t)board->bus_error_us,
                                     .wanted_ms = board->wanted_ms};
        board->step = frame_clock_step(&board->clock, board, &blank);
        if ((room->refresh + i) % (room->rate.frames / room->rate.seconds) == 0)
            send_latency(board, &blank);
    }
    for (int i = 0; i < BOARDS; i++) {
        hal_can_t *board = &room->board[i];
        for (int f = 0; !board->absent && f < board->sent; f++)
            deliver(room, i, board->out[f]);
        board->sent = board->absent ? board->sent : 0;
    }
}

static inline bool same_content(const frame_step_t *a, const frame_step_t *b)
{
    return a->start_us == b->start_us && a->pose_limit_us == b->pose_limit_us &&
           a->picture_limit_us == b->picture_limit_us;
}

/* Boards in step have the same numbers, and of a content the same times. @return How many are in step. */
static inline int boards_in_step(room_t *room)
{
    const frame_step_t *first = NULL;
    int count = 0;
    for (int i = 0; i < BOARDS; i++) {
        const frame_step_t *step = &room->board[i].step;
        frame_step_t *content = &room->content[step->content % CONTENTS];
        if (!step->in_step)
            continue;
        count++;
        if (first == NULL)
            first = step;
        if (content->content != step->content)
            *content = *step;
        if (step->number != first->number || !same_content(step, content))
            fail_msg(
                "refresh %lld: board %d has %lld, content %lld at %lld, picture limit %lld; another %lld, at %lld, "
                "%lld",
                (long long)room->refresh, i + 1, (long long)step->number, (long long)step->content,
                (long long)step->start_us, (long long)step->picture_limit_us, (long long)first->number,
                (long long)content->start_us, (long long)content->picture_limit_us);
    }
    return count;
}

/* @return The least number of boards in step at any of these refreshes. */
static inline int run(room_t *room, int refreshes)
{
    int least = BOARDS;
    for (int i = 0; i < refreshes; i++) {
        refresh(room);
        const int count = boards_in_step(room);
        least = count < least ? count : least;
    }
    return least;
}

/* Of those on the bus. */
static inline uint8_t leader(const room_t *room)
{
    uint8_t found = 0;
    for (int i = 0; i < BOARDS; i++) {
        if (!room->board[i].clock.leading || room->board[i].absent)
            continue;
        assert_int_equal(found, 0);
        found = room->board[i].clock.node;
    }
    return found;
}

#endif
