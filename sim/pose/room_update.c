// SPDX-License-Identifier: Apache-2.0
// Updates all boards of a room as one.
#include "sim/pose/room_update.h"

#include <string.h>

#include "sim/pose/room_update_judge.h"

void room_update_init(room_update_t *u, const room_update_settings_t *settings, const room_t *room, int64_t now_us)
{
    *u = (room_update_t){.settings = *settings, .boards = room->board_count, .next_us = now_us};
    for (int i = 0; i < u->boards; i++) {
        u->board[i].name = room->board[i].name;
        u->board[i].node = (uint8_t)room->board[i].node;
    }
}

/* Tell those that are asked something; the answers are judged in the step. */
static void tell(room_update_t *u, room_update_step_t step, command_update_t what)
{
    command_t request = {.kind = COMMAND_UPDATE, .update = what, .bus_time_us = u->switch_bus_us};
    const char *text = what == COMMAND_UPDATE_INSTALL ? u->settings.source : u->version;
    if (what == COMMAND_UPDATE_INSTALL || what == COMMAND_UPDATE_SWITCH)
        memcpy(request.text, text, strlen(text) + 1);
    u->step = step;
    u->talks = 0;
    for (int i = 0; i < u->boards; i++) {
        if (!u->board[i].asked)
            continue;
        u->board[i].answered = false;
        u->talk[u->talks] = (board_talk_t){.node = u->board[i].node, .request = request, .auth = u->settings.auth};
        u->of_board[u->talks++] = i;
    }
    board_talk_begin(u->talk, u->talks);
    u->talking = true;
}

static void look(room_update_t *u)
{
    for (int i = 0; i < u->boards; i++)
        u->board[i].asked = true;
    tell(u, u->step, COMMAND_UPDATE_STATUS);
}

/* What the board has answered, and whether it is in the way. */
static room_board_trouble_t take_answer(room_update_board_t *board, const board_talk_t *talk)
{
    board->answered = talk->replied;
    if (!talk->replied)
        return ROOM_BOARD_SILENT;
    if (talk->keyless || talk->result == COMMAND_REFUSED)
        return ROOM_BOARD_KEY;
    if (talk->result == COMMAND_IMPOSSIBLE && talk->length > 0) {
        board->refusal = talk->answer[0];
        return ROOM_BOARD_REFUSES;
    }
    if (talk->result != COMMAND_OK || !update_status_decode(&board->status, talk->answer, talk->length))
        return ROOM_BOARD_OLD;
    board->known = true;
    board->bus_us = (int64_t)board->status.bus_time_us - talk->heard_us;
    return board->status.state == CAN_UPDATE_NO_AGENT ? ROOM_BOARD_NO_AGENT : ROOM_BOARD_WELL;
}

/* After a switch that was given up, what was in its way stays told. */
static void take_answers(room_update_t *u)
{
    const bool after =
        u->settings.task == ROOM_UPDATE_SWITCH && (u->step == ROOM_UPDATE_UNDO || u->step == ROOM_UPDATE_LOOK_AFTER);
    u->talking = false;
    for (int i = 0; i < u->talks; i++) {
        room_update_board_t *board = &u->board[u->of_board[i]];
        const room_board_trouble_t trouble = take_answer(board, &u->talk[i]);
        if (!after)
            board->trouble = trouble;
    }
}

static void watch(room_update_t *u, int64_t next_us)
{
    u->step = ROOM_UPDATE_WATCH;
    u->next_us = next_us;
}

static void confirm(room_update_t *u)
{
    for (int i = 0; i < u->boards; i++)
        u->board[i].asked = u->board[i].told = u->board[i].switches;
    tell(u, ROOM_UPDATE_CONFIRM, COMMAND_UPDATE_CONFIRM);
}

static void begin_switch(room_update_t *u, int64_t now_us)
{
    int switching = 0;
    if (room_update_all_well(u))
        room_update_choose_boards(u);
    for (int i = 0; i < u->boards; i++)
        switching += u->board[i].switches;
    if (!room_update_all_well(u)) {
        u->result = ROOM_UPDATE_REFUSED;
    } else if (switching == 0) {
        u->switch_us = now_us;
        watch(u, now_us);
    } else if (room_update_choose_moment(u, now_us)) {
        tell(u, ROOM_UPDATE_PROMISE, COMMAND_UPDATE_SWITCH);
    } else {
        for (int i = 0; i < u->boards; i++)
            u->board[i].trouble = ROOM_BOARD_TIME;
        u->result = ROOM_UPDATE_REFUSED;
    }
}

/* Ask those again that are silent. @return false when none is, or something else is in the way. */
static bool ask_silent_again(room_update_t *u, command_update_t what)
{
    int silent = 0, others = 0;
    for (int i = 0; i < u->boards; i++) {
        const room_board_trouble_t trouble = u->board[i].trouble;
        u->board[i].asked = trouble == ROOM_BOARD_SILENT;
        silent += trouble == ROOM_BOARD_SILENT;
        others += trouble != ROOM_BOARD_SILENT && trouble != ROOM_BOARD_WELL;
    }
    if (silent == 0 || others > 0)
        return false;
    tell(u, u->step, what);
    return true;
}

/* @return Is there time for one request more, before all must have promised, or heard that the moment holds? */
static bool has_time(const room_update_t *u, int64_t now_us)
{
    const int64_t reserve_us = u->step == ROOM_UPDATE_PROMISE ? ROOM_UPDATE_PROMISED_US : ROOM_UPDATE_CONFIRMED_US;
    return u->switch_us - now_us >= reserve_us + ROOM_UPDATE_TALK_US;
}

static void undo(room_update_t *u)
{
    if (u->talking)
        take_answers(u);
    for (int i = 0; i < u->boards; i++)
        u->board[i].asked = u->board[i].switches;
    tell(u, ROOM_UPDATE_UNDO, COMMAND_UPDATE_CANCEL);
}

/* Until the moment: who has not answered may not have heard it. */
static void undo_again(room_update_t *u, int64_t now_us)
{
    int unheard = 0;
    for (int i = 0; i < u->boards; i++) {
        u->board[i].asked = u->board[i].asked && !u->board[i].answered;
        unheard += u->board[i].asked;
    }
    if (unheard > 0 && now_us < u->switch_us) {
        tell(u, ROOM_UPDATE_UNDO, COMMAND_UPDATE_CANCEL);
        return;
    }
    u->step = ROOM_UPDATE_LOOK_AFTER;
    u->next_us = u->switch_us + ROOM_UPDATE_ROUND_US;
}

static void judge_look(room_update_t *u, int64_t now_us)
{
    if (u->again++ < ROOM_UPDATE_LOOKS_AGAIN && ask_silent_again(u, COMMAND_UPDATE_STATUS))
        return;
    for (int i = 0; i < u->boards; i++)
        u->board[i].asked = true;
    switch (u->settings.task) {
    case ROOM_UPDATE_STATUS:
        u->result = room_update_all_well(u) ? ROOM_UPDATE_DONE : ROOM_UPDATE_REFUSED;
        break;
    case ROOM_UPDATE_CANCEL:
        tell(u, ROOM_UPDATE_UNDO, COMMAND_UPDATE_CANCEL);
        break;
    case ROOM_UPDATE_INSTALL:
        u->begun_us = now_us;
        if (room_update_all_well(u))
            tell(u, ROOM_UPDATE_BEGIN_INSTALL, COMMAND_UPDATE_INSTALL);
        else
            u->result = ROOM_UPDATE_REFUSED;
        break;
    case ROOM_UPDATE_SWITCH:
        begin_switch(u, now_us);
        break;
    }
}

static void judge(room_update_t *u, int64_t now_us)
{
    switch (u->step) {
    case ROOM_UPDATE_LOOK:
        judge_look(u, now_us);
        break;
    case ROOM_UPDATE_BEGIN_INSTALL:
        u->step = ROOM_UPDATE_WAIT_INSTALL;
        u->next_us = now_us + ROOM_UPDATE_ROUND_US;
        for (int i = 0; i < u->boards; i++)
            if (u->board[i].trouble != ROOM_BOARD_WELL && u->board[i].trouble != ROOM_BOARD_SILENT)
                u->result = ROOM_UPDATE_FAILED; /* one that is silent may have heard it: the looks will tell */
        break;
    case ROOM_UPDATE_WAIT_INSTALL:
        room_update_judge_installs(u, now_us);
        break;
    case ROOM_UPDATE_PROMISE:
        if (room_update_all_well(u))
            confirm(u);
        else if (!has_time(u, now_us) || !ask_silent_again(u, COMMAND_UPDATE_SWITCH))
            undo(u);
        break;
    case ROOM_UPDATE_CONFIRM:
        if (room_update_all_well(u))
            watch(u, u->switch_us + ROOM_UPDATE_ROUND_US);
        else if (!has_time(u, now_us) || !ask_silent_again(u, COMMAND_UPDATE_CONFIRM))
            undo(u);
        break;
    case ROOM_UPDATE_UNDO:
        undo_again(u, now_us);
        break;
    case ROOM_UPDATE_LOOK_AFTER:
        room_update_judge_cancellation(u, now_us);
        break;
    case ROOM_UPDATE_WATCH:
        room_update_judge_starts(u, now_us);
        break;
    }
}

/* Promises and confirmations that are not here in time are none. */
static bool too_late(const room_update_t *u, int64_t now_us)
{
    const int64_t left_us = u->switch_us - now_us;
    return (u->step == ROOM_UPDATE_PROMISE && left_us < ROOM_UPDATE_PROMISED_US) ||
           (u->step == ROOM_UPDATE_CONFIRM && left_us < ROOM_UPDATE_CONFIRMED_US);
}

void room_update_step(room_update_t *u, int64_t now_us)
{
    if (u->result != ROOM_UPDATE_WORKING)
        return;
    if (!u->talking && now_us >= u->next_us)
        look(u);
    if (!u->talking)
        return;
    board_talk_ask(u->talk, u->talks, ROOM_UPDATE_QUIET_US, now_us);
    if (board_talk_settled(u->talk, u->talks, ROOM_UPDATE_QUIET_US, now_us)) {
        take_answers(u);
        judge(u, now_us);
    } else if (too_late(u, now_us)) {
        undo(u);
    }
}

void room_update_hear(room_update_t *u, const hal_can_frame_t *frame, int64_t now_us)
{
    if (u->talking)
        board_talk_hear(u->talk, u->talks, frame, now_us);
}

bool room_update_next(room_update_t *u, hal_can_frame_t *frame, int64_t now_us)
{
    return u->talking && board_talk_next(u->talk, u->talks, frame, now_us);
}

void room_update_stop(room_update_t *u, int64_t now_us)
{
    const bool over = u->step == ROOM_UPDATE_WATCH && now_us >= u->switch_us;
    const bool promised =
        u->step == ROOM_UPDATE_PROMISE || u->step == ROOM_UPDATE_CONFIRM || (u->step == ROOM_UPDATE_WATCH && !over);
    if (u->result != ROOM_UPDATE_WORKING || u->step == ROOM_UPDATE_UNDO || u->step == ROOM_UPDATE_LOOK_AFTER)
        return;
    if (promised)
        undo(u);
    else
        u->result = over ? ROOM_UPDATE_MIXED : ROOM_UPDATE_CANCELLED;
}
