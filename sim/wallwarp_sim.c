// SPDX-License-Identifier: Apache-2.0
// The program wallwarp-sim: a room of boards on this machine, or one wall for one pose.
#include <argp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/warp_once.h"
#include "sim/files/png_file.h"
#include "sim/options.h"
#include "sim/program.h"
#include "sim/run/run_options.h"
#include "sim/update/update_command.h"

enum { KEY_BOARD = 256, KEY_POSE, KEY_IN, KEY_OUT, KEY_METHOD, KEY_KERNELS };

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static int run_command(int argc, char **argv)
{
    sim_run_options_t run;
    run_options_parse(&run, argc, argv);
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
    return sim_run(&run, &stop_requested);
}

typedef struct {
    warp_once_place_t place;
    const char *in, *out;
    const warp_method_t *method;
    const warp_kernels_t *kernels; /**< NULL: the fastest */
} warp_options_t;

static const struct argp_option warp_options[] = {
    {"board", KEY_BOARD, "NAME", 0, "Which board; needed", 0},
    {"pose", KEY_POSE, "POSE", 0, "\"x_mm y_mm z_mm qw qx qy qz\"; needed", 0},
    {"in", KEY_IN, "PNG", 0, "Picture of the camera's size; needed", 0},
    {"out", KEY_OUT, "PNG", 0, "What the projector must show; needed", 0},
    {"method", KEY_METHOD, "M", 0, "Method, in place of the board's own", 0},
    {"kernels", KEY_KERNELS, "LEVEL", 0, "Pixel loops: scalar or neon, of the same bytes (default: the fastest)", 0},
    {0},
};

static error_t read_warp(int key, char *text, struct argp_state *state)
{
    warp_options_t *warp = state->input;
    switch (key) {
    case KEY_BOARD:
        warp->place.board = text;
        return 0;
    case KEY_POSE:
        warp->place.pose = text;
        return 0;
    case KEY_IN:
        warp->in = text;
        return 0;
    case KEY_OUT:
        warp->out = text;
        return 0;
    case KEY_METHOD:
        warp->method = options_method(state, text);
        return 0;
    case KEY_KERNELS:
        warp->kernels = options_kernels(state, text);
        return 0;
    case ARGP_KEY_ARG:
        return options_room(&warp->place.room, text, state);
    case ARGP_KEY_END:
        if (warp->place.room == NULL || warp->place.board == NULL || warp->place.pose == NULL || warp->in == NULL ||
            warp->out == NULL)
            argp_error(state, "expected ROOM, --board NAME, --pose POSE, --in PNG and --out PNG");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static bool warp_picture(warp_once_t *once, const warp_options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    image_t picture = {.data = NULL}, panel = {.data = NULL};
    bool ok = warp_once_read(once, options->in, IMAGE_XRGB8888, &picture, error);
    if (ok && !(warp_once_panel(once, IMAGE_XRGB8888, &panel) && warp_once(once, options->method, &panel, &picture))) {
        snprintf(error, ROOM_MESSAGE_LENGTH, "%s: can't be warped, or out of memory", options->in);
        ok = false;
    }
    ok = ok && png_file_write(options->out, &panel, error);
    free(picture.data);
    free(panel.data);
    return ok;
}

static int warp_command(int argc, char **argv)
{
    static const struct argp argp = {
        .options = warp_options,
        .parser = read_warp,
        .args_doc = "ROOM",
        .doc = "Make the picture that one projector of ROOM must show for one pose.",
    };
    warp_options_t options = {.in = NULL};
    warp_once_t once;
    char error[ROOM_MESSAGE_LENGTH];
    if (argp_parse(&argp, argc, argv, 0, NULL, &options) != 0)
        return PROGRAM_BAD_USAGE;
    int status = (int)warp_once_open(&once, &options.place, program_warn, error);
    if (status == PROGRAM_DONE) {
        if (options.kernels != NULL)
            once.kernels = options.kernels;
        status = warp_picture(&once, &options, error) ? PROGRAM_DONE : PROGRAM_FAILED;
        warp_once_close(&once);
    }
    if (status != PROGRAM_DONE)
        fprintf(stderr, "wallwarp-sim warp: %s\n", error);
    return status;
}

static const char usage[] = "Usage: wallwarp-sim COMMAND ...\n"
                            "A room of boards, simulated on this machine.\n\n"
                            "  run     every board of a room runs the real firmware over a simulated bus\n"
                            "  update  all boards of a room to another version, as one, and what goes wrong\n"
                            "  warp    one wall, one pose: one picture\n\n"
                            "`wallwarp-sim COMMAND --help` tells the rest. Exit status: 0 done, 1 failed,\n"
                            "2 bad usage.\n";

int main(int argc, char **argv)
{
    static char run_name[] = "wallwarp-sim run", update_name[] = "wallwarp-sim update",
                warp_name[] = "wallwarp-sim warp";
    const char *command = argc > 1 ? argv[1] : "";
    argp_err_exit_status = PROGRAM_BAD_USAGE;
    if (strcmp(command, "run") == 0) {
        argv[1] = run_name;
        return run_command(argc - 1, argv + 1);
    }
    if (strcmp(command, "update") == 0) {
        argv[1] = update_name;
        return update_command(argc - 1, argv + 1);
    }
    if (strcmp(command, "warp") == 0) {
        argv[1] = warp_name;
        return warp_command(argc - 1, argv + 1);
    }
    if (strcmp(command, "--help") == 0 || strcmp(command, "-?") == 0) {
        fputs(usage, stdout);
        return program_finish("wallwarp-sim");
    }
    if (argc > 1)
        fprintf(stderr, "wallwarp-sim: found \"%s\", expected run, update or warp\n", command);
    fputs(usage, stderr);
    return PROGRAM_BAD_USAGE;
}
