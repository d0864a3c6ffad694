// SPDX-License-Identifier: Apache-2.0
// The firmware: read the room, open the board, then one projector_step() per vertical blank.
#include <argp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "firmware/auth_key.h"
#include "firmware/projector.h"
#include "firmware/room.h"
#include "hal/hal_board.h"
#include "hal/hal_random.h"

enum {
    FAILED = 1,
    BAD_USAGE = 2,
    KEY_CAN = 256,
    KEY_CAMERA,
    KEY_DISPLAY,
    KEY_KERNELS,
    KEY_WORKERS,
    KEY_KEY,
    KEY_CHECK,
    KEY_OFF
};

typedef struct {
    enum { RUN, CHECK, OFF } task;
    const char *room; /**< NULL: not given */
    const char *key;  /**< file; NULL: the room has none */
    int32_t node;     /**< 0: not given */
    board_table_t devices;
    const warp_kernels_t *kernels;
} options_t;

/* What the projector needs of it. */
typedef struct {
    can_auth_t *auth;
    uint64_t seed;
} room_key_t;

static const struct argp_option option_table[] = {
    {"node", 'n', "N", 0, "Node number of this board in the room file; needed", 0},
    {"can", KEY_CAN, "NAME", 0, "Bus, in place of the board's own", 0},
    {"camera", KEY_CAMERA, "NAME", 0, "Video source, in place of the board's own", 0},
    {"display", KEY_DISPLAY, "NAME", 0, "Display, in place of the board's own", 0},
    {"key", KEY_KEY, "FILE", 0, auth_key_help, 0},
    {"kernels", KEY_KERNELS, "LEVEL", 0, "Pixel loops: scalar or neon, of the same bytes (default: the fastest)", 0},
    {"workers", KEY_WORKERS, "N", 0, "Threads that make a picture together, 1 to 4, in place of the board's own", 0},
    {"check", KEY_CHECK, NULL, 0, "Say what of the board is there and what is missing, change nothing, and end", 1},
    {"off", KEY_OFF, NULL, 0, "Drive the board's outputs low, the lamp's too, and end", 1},
    {0},
};

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

/* A number from 1 to the largest; anything else ends the program. */
static int32_t read_number(struct argp_state *state, const char *option, const char *text, int32_t largest)
{
    char *end;
    const long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || number < 1 || number > largest)
        argp_error(state, "--%s: found \"%s\", expected 1 to %d", option, text, largest);
    return (int32_t)number;
}

static error_t read_option(int key, char *text, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'n':
        options->node = read_number(state, "node", text, ROOM_MAX_NODE);
        return 0;
    case KEY_WORKERS:
        options->devices.workers.count = read_number(state, "workers", text, HAL_WORKERS_MAX);
        return 0;
    case KEY_CAN:
        options->devices.can = text;
        return 0;
    case KEY_CAMERA:
        options->devices.camera = text;
        return 0;
    case KEY_DISPLAY:
        options->devices.display = text;
        return 0;
    case KEY_KEY:
        options->key = text;
        return 0;
    case KEY_KERNELS:
        options->kernels = warp_kernels_from_name(text);
        if (options->kernels == NULL)
            argp_error(state, "--kernels: found \"%s\", expected scalar or neon", text);
        return 0;
    case KEY_CHECK:
        options->task = CHECK;
        return 0;
    case KEY_OFF:
        options->task = OFF;
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num > 0)
            argp_error(state, "found \"%s\", expected one room file", text);
        options->room = text;
        return 0;
    case ARGP_KEY_END:
        if (options->task == RUN ? options->room == NULL || options->node == 0
                                 : (options->room == NULL) != (options->node == 0))
            argp_error(state, "expected ROOM and --node N");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static void print_warning(void *context, const char *line)
{
    (void)context;
    fprintf(stderr, "warning: %s\n", line);
}

static hal_board_needs_t needs_of(const room_t *room, const room_board_t *board)
{
    return (hal_board_needs_t){
        .picture_width = room->camera.width,
        .picture_height = room->camera.height,
        .panel_width = board->wall.panel_width,
        .panel_height = board->wall.panel_height,
        .refresh_frames = room->refresh.frames,
        .refresh_seconds = room->refresh.seconds,
        .bitrate = room->bitrate,
        .data_bitrate = room->data_bitrate,
        .fd = room->fd,
    };
}

static bool open_board(hal_board_t *devices, const options_t *options, const room_t *room, const room_board_t *board)
{
    const hal_board_needs_t needs = needs_of(room, board);
    char error[HAL_BOARD_ERROR_LENGTH];
    fprintf(stderr, "wallwarp: board \"%s\" on %s: can %s, camera %s, display %s\n", board->name, options->devices.name,
            options->devices.can, options->devices.camera, options->devices.display);
    if (hal_board_open(devices, &options->devices, &needs, error) == HAL_OK)
        return true;
    fprintf(stderr, "wallwarp: %s\n", error);
    return false;
}

/* The board of the options' node. @return NULL, and the reason in error, when room file or node are wrong. */
static const room_board_t *load_room(room_t *room, const options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    if (!room_load(room, options->room, print_warning, NULL, error))
        return NULL;
    const room_board_t *board = room_board_with_node(room, options->node);
    if (board == NULL)
        (void)snprintf(error, ROOM_MESSAGE_LENGTH, "%s: no board has node %d", options->room, options->node);
    return board;
}

static void print_check(void *context, hal_check_t what, const char *line)
{
    static const char *const names[] = {"found", "advice", "missing"};
    (void)context;
    printf("%-8s %s\n", names[what], line);
}

static int check(const options_t *options, room_t *room)
{
    hal_board_needs_t needs;
    char line[ROOM_MESSAGE_LENGTH + sizeof "room: "], error[ROOM_MESSAGE_LENGTH];
    const room_board_t *board = options->room == NULL ? NULL : load_room(room, options, error);
    if (board != NULL) {
        needs = needs_of(room, board);
        (void)snprintf(error, sizeof error, "%s, node %d, \"%s\"", options->room, options->node, board->name);
    }
    (void)snprintf(line, sizeof line, "room: %s", options->room == NULL ? "none was named" : error);
    const bool room_good = options->room == NULL || board != NULL;
    print_check(NULL, room_good ? HAL_CHECK_FOUND : HAL_CHECK_MISSING, line);
    const bool all = hal_board_check(&options->devices, board == NULL ? NULL : &needs, print_check, NULL);
    return all && room_good ? 0 : FAILED;
}

static int switch_off(const options_t *options)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    if (hal_board_outputs_off(&options->devices, error) == HAL_OK)
        return 0;
    fprintf(stderr, "wallwarp: %s\n", error);
    return FAILED;
}

/* NULL without a key. @return false when there is to be one and cannot be; said. */
static bool open_key(room_key_t *key, const char *path)
{
    char error[HAL_KEY_ERROR_LENGTH] = "no random numbers from the system";
    *key = (room_key_t){.auth = NULL};
    if (path == NULL)
        return true;
    if (hal_random(&key->seed) == HAL_OK)
        key->auth = auth_key_open(path, error);
    if (key->auth == NULL)
        fprintf(stderr, "wallwarp: --key: %s\n", error);
    return key->auth != NULL;
}

static void run(const room_t *room, const room_board_t *board, const hal_board_t *devices, const room_key_t *key,
                const warp_kernels_t *kernels)
{
    static projector_t projector;
    projector_init(&projector, room, board, devices, kernels);
    projector_use_key(&projector, key->auth, key->seed);
    while (!stop_requested) {
        projector_step(&projector);
        if (hal_display_wait_vblank(devices->display) != HAL_OK) {
            /* no display: the call has waited all the same, and the next step counts it */
        }
    }
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        .options = option_table,
        .parser = read_option,
        .args_doc = "ROOM --node N\n--check [ROOM --node N]\n--off",
        .doc = "The projector's firmware: shows on one wall of ROOM what the tracked viewer must see."
               "\vOn the host the bus is a port of 127.0.0.1 (socketcand protocol, channel can0), the camera a "
               "picture or video file or \"pattern\", the display a folder for PNGs or \"none\"; nv12: or another "
               "format may be before either, for pictures that are not XRGB. Ends on SIGINT or SIGTERM. Exit status: 0 "
               "done, 1 failed or something is missing, 2 bad usage.",
    };
    static room_t room;
    options_t options = {.devices = board_table, .kernels = warp_kernels_best()};
    char error[ROOM_MESSAGE_LENGTH];
    hal_board_t devices;
    argp_err_exit_status = BAD_USAGE;
    if (argp_parse(&argp, argc, argv, 0, NULL, &options) != 0)
        return BAD_USAGE;
    if (options.task != RUN)
        return options.task == CHECK ? check(&options, &room) : switch_off(&options);
    const room_board_t *board = load_room(&room, &options, error);
    if (board == NULL) {
        fprintf(stderr, "wallwarp: %s\n", error);
        return FAILED;
    }
    room_key_t key;
    if (!open_key(&key, options.key))
        return FAILED;
    signal(SIGINT, request_stop); /* before there is anything to set back: a running watchdog, a lit display */
    signal(SIGTERM, request_stop);
    if (!open_board(&devices, &options, &room, board)) {
        can_auth_close(key.auth);
        return FAILED;
    }
    run(&room, board, &devices, &key, options.kernels);
    hal_board_close(&devices);
    can_auth_close(key.auth);
    return 0;
}
