// SPDX-License-Identifier: Apache-2.0
// The firmware: read the room, open the board, then one projector_step() per vertical blank.
#include <signal.h>
#include <stdio.h>

#include "firmware/notice.h"
#include "firmware/projector.h"
#include "firmware/say.h"
#include "firmware/self_check.h"

enum { DONE = 0, FAILED = 1 };

/* A device may come, or be mended: after so long with a notice whoever started the firmware may start it again. */
static const int64_t notice_us = 10000000;

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static bool open_board(hal_board_t *board, const board_table_t *devices, const setup_t *setup,
                       char error[ROOM_MESSAGE_LENGTH])
{
    const hal_board_needs_t needs = setup_needs(setup);
    fprintf(stderr, "wallwarp: board \"%s\" on %s: can %s, camera %s, display %s\n", setup->board->name, devices->name,
            devices->can, devices->camera, devices->display);
    return hal_board_open(board, devices, &needs, error) == HAL_OK;
}

static void wait_for_blank(const hal_board_t *board)
{
    if (hal_display_wait_vblank(board->display) != HAL_OK) {
        /* no display: the call has waited all the same, and the next step counts it */
    }
}

static void run(projector_t *projector, const setup_t *setup, const hal_board_t *board, const warp_kernels_t *kernels)
{
    projector_init(projector, &setup->room, setup->board, board, kernels);
    projector_use_key(projector, setup->auth, setup->seed);
    while (!stop_requested) {
        projector_step(projector);
        wait_for_blank(board);
    }
}

/* Only say what is wrong: until somebody ends that, or, of a device, for a while. */
static int say(projector_t *projector, const notice_t *notice, setup_t *setup, board_table_t *devices, bool of_device)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_board_t board;
    if (notice->node == 0)
        devices->can = NULL;
    if (hal_board_open_some(&board, devices, error) != HAL_OK) {
        say_error(error);
        return FAILED;
    }
    notice_init(projector, notice, &board, &setup->room);
    projector_use_key(projector, setup->auth, setup->seed);
    const int64_t end_us = hal_time_now_us(board.clock) + notice_us;
    while (!stop_requested && !(of_device && hal_time_now_us(board.clock) >= end_us)) {
        notice_step(projector, notice);
        wait_for_blank(&board);
    }
    hal_board_close(&board);
    return stop_requested ? DONE : FAILED;
}

/* Read the setup, then be a projector until somebody ends that. */
static int work(setup_t *setup, options_t *options)
{
    static projector_t projector;
    char error[ROOM_MESSAGE_LENGTH];
    hal_board_t board;
    const bool config = setup_read_config(setup, options, error), key = config && setup_read_key(setup, options, error),
               known = key && setup_read_room(setup, options, error);
    board_table_t devices = options_devices(options);
    int status = DONE;
    signal(SIGINT, request_stop); /* before there is anything to set back: a running watchdog, a lit display */
    signal(SIGTERM, request_stop);
    if (known && open_board(&board, &devices, setup, error)) {
        run(&projector, setup, &board, options->kernels);
        hal_board_close(&board);
    } else {
        notice_t notice = {.reason = error, .node = options->node, .deaf = !key};
        (void)snprintf(notice.board, sizeof notice.board, "%s", known ? setup->board->name : devices.name);
        say_error(error);
        status = options->config == NULL ? FAILED : say(&projector, &notice, setup, &devices, known);
    }
    setup_close(setup);
    return status;
}

static int switch_off(const board_table_t *devices)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    if (hal_board_outputs_off(devices, error) == HAL_OK)
        return DONE;
    say_error(error);
    return FAILED;
}

int main(int argc, char **argv)
{
    static setup_t setup;
    options_t options = options_read(argc, argv);
    const board_table_t devices = options_devices(&options);
    switch (options.task) {
    case OPTIONS_CHECK:
        return self_check(&setup, &options) ? DONE : FAILED;
    case OPTIONS_OFF:
        return switch_off(&devices);
    case OPTIONS_RUN:
        break;
    }
    return work(&setup, &options);
}
