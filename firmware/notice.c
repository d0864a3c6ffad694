// SPDX-License-Identifier: Apache-2.0
// A board that can't do its work says why: on its wall, on the bus, to its service manager.
#include "firmware/notice.h"

#include <stddef.h>
#include <string.h>

#include "firmware/bus_receive.h"
#include "firmware/pattern_picture.h"

enum { SIDE_PX = 64, FOCAL_UPX = 64000000 };

void notice_init(projector_t *projector, const notice_t *notice, const hal_board_t *devices, room_t *room)
{
    room_board_t *board = &room->board[0];
    *room = (room_t){.camera = {.width = SIDE_PX, .height = SIDE_PX, .focal_upx = {FOCAL_UPX, FOCAL_UPX}},
                     .board_count = 1,
                     .refresh = {.frames = 60, .seconds = 1}};
    *board = (room_board_t){.node = notice->node, .method = warp_method_default()}; /* no wall: nothing is warped */
    memcpy(board->name, notice->board, sizeof board->name);
    ls_weights_init(&board->ls_weights);
    projector_init(projector, room, board, devices, &warp_kernels_scalar);
    projector->unusable = true;
}

static void serve_bus(projector_t *p, const notice_t *notice, int64_t now_us)
{
    const bus_receivers_t receivers = {&p->poses, &p->time, NULL, &p->commands.link, &p->can_faults, &p->auth};
    bus_receive(&receivers, p->board.can);
    if (!notice->deaf)
        commands_step(p, now_us);
}

/* @return Is the loop healthy? */
static bool show(projector_t *p, const notice_t *notice)
{
    picture_t panel;
    hal_status_t status = hal_display_back_buffer(p->board.display, PICTURE_XRGB8888, PICTURE_BT709, &panel);
    p->report.safe = (safe_picture_t){p->name, p->node, notice->reason};
    if (status == HAL_OK && p->commands.pattern != COMMAND_PATTERN_NONE)
        pattern_picture_draw(&panel, p->commands.pattern);
    else if (status == HAL_OK)
        safe_picture_draw(&panel, &p->report.safe);
    if (status == HAL_OK)
        status = hal_display_present(p->board.display);
    p->report.frame_number += status == HAL_OK;
    p->faults.display += status != HAL_OK;
    return status == HAL_OK || status == HAL_IO;
}

void notice_step(projector_t *p, const notice_t *notice)
{
    const int64_t now_us = hal_time_now_us(p->board.clock);
    p->report.state = CAN_BOARD_FAULT;
    p->picture_us = now_us; /* no camera is wanted, and none is missed */
    if (p->board.can != NULL)
        serve_bus(p, notice, now_us);
    const bool healthy = p->board.display == NULL || show(p, notice);
    projector_light(p, now_us);
    if (p->board.can != NULL)
        telemetry_send_life(p, now_us);
    event_watch_step(p, now_us);
    projector_tell_life(p, notice->reason, healthy, now_us);
    update_step(p, now_us); /* in state fault no version is marked good, and the bus not looked at, which may be NULL */
}
