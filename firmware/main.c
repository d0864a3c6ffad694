// SPDX-License-Identifier: Apache-2.0
// The firmware: read the room, open the board, then one projector_step() per vertical blank.
#include <signal.h>
#include <stdio.h>

#include "firmware/projector.h"
#include "firmware/self_check.h"

enum { DONE = 0, FAILED = 1 };

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

static void run(const setup_t *setup, const hal_board_t *board, const warp_kernels_t *kernels)
{
    static projector_t projector;
    projector_init(&projector, &setup->room, setup->board, board, kernels);
    projector_use_key(&projector, setup->auth, setup->seed);
    while (!stop_requested) {
        projector_step(&projector);
        if (hal_display_wait_vblank(board->display) != HAL_OK) {
            /* no display: the call has waited all the same, and the next step counts it */
        }
    }
}

static int switch_off(const board_table_t *devices)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    if (hal_board_outputs_off(devices, error) == HAL_OK)
        return DONE;
    fprintf(stderr, "wallwarp: %s\n", error);
    return FAILED;
}

/* Read the setup, then be a projector until somebody ends that. */
static int work(setup_t *setup, options_t *options)
{
    char error[ROOM_MESSAGE_LENGTH];
    hal_board_t board;
    bool good = setup_read_config(setup, options, error) && setup_read_room(setup, options, error) &&
                setup_read_key(setup, options, error);
    signal(SIGINT, request_stop); /* before there is anything to set back: a running watchdog, a lit display */
    signal(SIGTERM, request_stop);
    const board_table_t devices = options_devices(options);
    good = good && open_board(&board, &devices, setup, error);
    if (good) {
        run(setup, &board, options->kernels);
        hal_board_close(&board);
    } else {
        fprintf(stderr, "wallwarp: %s\n", error);
    }
    setup_close(setup);
    return good ? DONE : FAILED;
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
