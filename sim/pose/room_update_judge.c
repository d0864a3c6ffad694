// SPDX-License-Identifier: Apache-2.0
// What the answers of a room's boards mean for its update.
#include "sim/pose/room_update_judge.h"

#include <string.h>

enum { BUS_TIMES_APART_US = 1000000 };

bool room_update_all_well(const room_update_t *u)
{
    int well = 0;
    for (int i = 0; i < u->boards; i++)
        well += u->board[i].trouble == ROOM_BOARD_WELL;
    return well == u->boards;
}

/* @return Is the install over on this board, one way or the other? */
static bool judge_install(room_update_board_t *board)
{
    const can_update_state_t state = board->status.state;
    if (board->trouble == ROOM_BOARD_WELL && state == CAN_UPDATE_FAILED)
        board->trouble = ROOM_BOARD_FAILED;
    const bool as_expected =
        board->trouble == ROOM_BOARD_WELL && (state == CAN_UPDATE_INSTALLING || state == CAN_UPDATE_READY);
    board->missed = as_expected ? 0 : board->missed + 1;
    if (!as_expected && board->trouble == ROOM_BOARD_WELL)
        board->trouble = ROOM_BOARD_OTHER;
    return board->trouble == ROOM_BOARD_FAILED || board->missed >= ROOM_UPDATE_PATIENCE ||
           (as_expected && state == CAN_UPDATE_READY);
}

void room_update_judge_installs(room_update_t *u, int64_t now_us)
{
    int over = 0;
    for (int i = 0; i < u->boards; i++)
        over += judge_install(&u->board[i]);
    u->next_us = now_us + ROOM_UPDATE_ROUND_US;
    if (over < u->boards && now_us - u->begun_us < ROOM_UPDATE_INSTALL_US)
        return;
    const char *first = u->board[0].status.waiting;
    for (int i = 0; i < u->boards; i++)
        if (u->board[i].trouble == ROOM_BOARD_WELL &&
            (u->board[i].status.state != CAN_UPDATE_READY || strcmp(u->board[i].status.waiting, first) != 0))
            u->board[i].trouble = ROOM_BOARD_OTHER;
    memcpy(u->version, first, sizeof u->version);
    u->result = room_update_all_well(u) ? ROOM_UPDATE_DONE : ROOM_UPDATE_FAILED;
}

static bool runs(const room_update_board_t *board, const char *version)
{
    return board->known && strcmp(board->status.running, version) == 0;
}

void room_update_choose_boards(room_update_t *u)
{
    const char *version = u->settings.version;
    for (int i = 0; i < u->boards && version == NULL; i++)
        if (u->board[i].status.waiting[0] != '\0')
            version = u->board[i].status.waiting;
    if (version != NULL)
        memcpy(u->version, version, strlen(version) + 1);
    for (int i = 0; i < u->boards; i++) {
        room_update_board_t *board = &u->board[i];
        board->asked = board->switches = version == NULL || !runs(board, version);
        if (!board->switches)
            continue;
        const bool has_it = version != NULL && strcmp(board->status.other, version) == 0;
        board->trouble = !has_it ? ROOM_BOARD_OTHER : board->status.knows_time ? ROOM_BOARD_WELL : ROOM_BOARD_TIME;
    }
}

bool room_update_choose_moment(room_update_t *u, int64_t now_us)
{
    int64_t least_us = INT64_MAX, most_us = INT64_MIN;
    for (int i = 0; i < u->boards; i++) {
        const room_update_board_t *board = &u->board[i];
        least_us = board->switches && board->bus_us < least_us ? board->bus_us : least_us;
        most_us = board->switches && board->bus_us > most_us ? board->bus_us : most_us;
    }
    if (most_us - least_us > BUS_TIMES_APART_US)
        return false;
    u->switch_us = now_us + u->settings.ahead_us;
    u->switch_bus_us = (uint64_t)(u->switch_us + most_us);
    return true;
}

/* After the moment: how does a board stand? @return Is it over, one way or the other? */
static bool judge_start(const room_update_t *u, room_update_board_t *board)
{
    if (board->trouble != ROOM_BOARD_WELL)
        return false; /* it is starting, or still on its way down */
    const bool there = runs(board, u->version);
    if (!there && board->status.state == CAN_UPDATE_SWITCHING)
        return false;
    board->trouble = !there ? ROOM_BOARD_BACK : board->status.trial ? ROOM_BOARD_TRIAL : ROOM_BOARD_WELL;
    return board->trouble != ROOM_BOARD_TRIAL;
}

void room_update_judge_starts(room_update_t *u, int64_t now_us)
{
    int over = 0;
    for (int i = 0; i < u->boards; i++)
        over += judge_start(u, &u->board[i]);
    u->next_us = now_us + ROOM_UPDATE_ROUND_US;
    if (over == u->boards || now_us - u->switch_us >= ROOM_UPDATE_START_US)
        u->result = room_update_all_well(u) ? ROOM_UPDATE_DONE : ROOM_UPDATE_MIXED;
}

void room_update_judge_cancellation(room_update_t *u, int64_t now_us)
{
    int switched = 0, unheard = 0;
    for (int i = 0; i < u->boards; i++) {
        const room_update_board_t *board = &u->board[i];
        const bool new = board->switches && (board->status.state == CAN_UPDATE_SWITCHING || runs(board, u->version));
        switched += board->answered && new;
        unheard += !board->answered && board->told;
    }
    u->next_us = now_us + ROOM_UPDATE_ROUND_US;
    if (unheard > 0 && now_us - u->switch_us < ROOM_UPDATE_AFTER_US)
        return;
    u->result = switched + unheard > 0 ? ROOM_UPDATE_MIXED : ROOM_UPDATE_CANCELLED;
    if (u->result == ROOM_UPDATE_CANCELLED && u->settings.task == ROOM_UPDATE_CANCEL && room_update_all_well(u))
        u->result = ROOM_UPDATE_DONE;
}
