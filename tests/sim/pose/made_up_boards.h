// SPDX-License-Identifier: Apache-2.0
// Made-up boards that answer as they are told, and the operator's side of their update, for tests.
#ifndef TESTS_SIM_POSE_MADE_UP_BOARDS_H
#define TESTS_SIM_POSE_MADE_UP_BOARDS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/room_update_text.h"

enum { BOARDS = 3, STEP_US = 5000, MOST_US = 20000000, REPLY_HEAD = 2 };

static const int64_t BUS_US = 900000000;

/* A board, and what it was told. */
typedef struct {
    isotp_t link;
    update_status_t status;
    bool silent;
    command_update_t silent_from; /* and silent is true: from this request on */
    uint8_t result, refusal;      /* to everything but looks */
    int64_t off_us;               /* of its bus time */
    int told[COMMAND_UPDATES];    /* requests */
    command_t newest;
} made_up_t;

static room_t room;
static room_update_t update;
static made_up_t board[BOARDS];
static int64_t now_us, most_us;

static inline int open_room(void **state)
{
    (void)state;
    static const char *const names[BOARDS] = {"front", "left", "floor"};
    now_us = 1000000;
    most_us = MOST_US;
    memset(board, 0, sizeof board);
    room.board_count = BOARDS;
    for (int i = 0; i < BOARDS; i++) {
        room.board[i].node = 10 + i;
        snprintf(room.board[i].name, sizeof room.board[i].name, "%s", names[i]);
        isotp_init(&board[i].link, CAN_ID_COMMAND + 10 + (uint32_t)i, CAN_ID_REPLY + 10 + (uint32_t)i);
        board[i].status = (update_status_t){
            .state = CAN_UPDATE_READY, .slot = 'A', .knows_time = true, .running = "1", .waiting = "2", .other = "2"};
    }
    return 0;
}

static inline void obey(made_up_t *b)
{
    b->told[b->newest.update]++;
    if (b->newest.update == COMMAND_UPDATE_CONFIRM && b->result == COMMAND_OK) {
        b->status.plan = UPDATE_CONFIRMED;
        b->status.switch_bus_us = b->newest.bus_time_us;
    }
    if (b->newest.update == COMMAND_UPDATE_CANCEL)
        b->status.plan = UPDATE_NO_PLAN;
}

static inline void answer(made_up_t *b, const uint8_t *bytes, int length)
{
    uint8_t reply[REPLY_HEAD + UPDATE_STATUS_BYTES] = {COMMAND_UPDATE | COMMAND_REPLY_FLAG, COMMAND_OK};
    assert_int_equal(command_decode(&b->newest, bytes, length), COMMAND_OK);
    if (b->silent && b->newest.update >= b->silent_from)
        return;
    obey(b);
    b->status.bus_time_us = (uint64_t)(now_us + BUS_US + b->off_us);
    int used = REPLY_HEAD;
    reply[1] = b->newest.update == COMMAND_UPDATE_STATUS ? (uint8_t)COMMAND_OK : b->result;
    if (reply[1] == COMMAND_OK)
        used += update_status_encode(reply + REPLY_HEAD, &b->status);
    else if (reply[1] == COMMAND_IMPOSSIBLE)
        reply[used++] = b->refusal;
    assert_true(isotp_send(&b->link, reply, used, now_us));
}

static inline void turn(void)
{
    hal_can_frame_t frame;
    now_us += STEP_US;
    room_update_step(&update, now_us);
    while (room_update_next(&update, &frame, now_us))
        for (int i = 0; i < BOARDS; i++)
            (void)isotp_take(&board[i].link, &frame, now_us);
    for (int i = 0; i < BOARDS; i++) {
        const uint8_t *bytes;
        if (board[i].status.plan == UPDATE_CONFIRMED &&
            now_us + BUS_US + board[i].off_us >= (int64_t)board[i].status.switch_bus_us)
            board[i].status = (update_status_t){.state = CAN_UPDATE_IDLE, .slot = 'B', .running = "2", .other = "1"};
        const int length = isotp_received(&board[i].link, &bytes);
        if (length > 0 && !isotp_sending(&board[i].link)) {
            answer(&board[i], bytes, length);
            isotp_taken(&board[i].link);
        }
        while (isotp_next(&board[i].link, &frame, now_us))
            room_update_hear(&update, &frame, now_us);
    }
}

static inline void begin(room_update_task_t task, const char *version)
{
    const room_update_settings_t settings = {
        .task = task, .source = "/b", .version = version, .ahead_us = ROOM_UPDATE_LEAST_AHEAD_US};
    room_update_init(&update, &settings, &room, now_us);
}

static inline void run_to(room_update_result_t result)
{
    while (update.result == ROOM_UPDATE_WORKING && now_us < most_us)
        turn();
    assert_int_equal(update.result, result);
}

static inline void check_trouble(int i, room_board_trouble_t trouble, const char *said)
{
    char text[ROOM_UPDATE_TEXT_LENGTH];
    assert_int_equal(update.board[i].trouble, trouble);
    room_update_board_text(text, &update.board[i]);
    if (strstr(text, said) == NULL)
        fail_msg("\"%s\" is not in \"%s\"", said, text);
}

static inline int told(command_update_t what)
{
    int count = 0;
    for (int i = 0; i < BOARDS; i++)
        count += board[i].told[what];
    return count;
}

#endif
