// SPDX-License-Identifier: Apache-2.0
// The program wallwarp-sim: a room of boards on this machine, or one wall for one pose.
#include <argp.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/warp_once.h"
#include "sim/files/png_file.h"
#include "sim/program.h"
#include "sim/run/sim_run.h"

enum {
    KEY_VIDEO = 256,
    KEY_POSES,
    KEY_BUS,
    KEY_OUT,
    KEY_FRAMES,
    KEY_METHOD,
    KEY_KERNELS,
    KEY_RATE,
    KEY_ORIGINAL,
    KEY_JUDGE,
    KEY_BOARD,
    KEY_POSE,
    KEY_IN
};

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

/* A whole number in a range, or the end of the program as bad usage. */
static int32_t read_number(struct argp_state *state, const char *name, const char *text, long least, long most)
{
    char *end;
    errno = 0;
    const long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || number < least || number > most)
        argp_error(state, "--%s: found \"%s\", expected a whole number from %ld to %ld", name, text, least, most);
    return (int32_t)number;
}

static double read_rate(struct argp_state *state, const char *text)
{
    char *end;
    const double rate = strtod(text, &end);
    if (end == text || *end != '\0' || !(rate >= 0.001 && rate <= 1000))
        argp_error(state, "--rate: found \"%s\", expected 0.001 to 1000 Hz", text);
    return rate;
}

static const warp_kernels_t *read_kernels(struct argp_state *state, const char *text)
{
    const warp_kernels_t *kernels = warp_kernels_from_name(text);
    if (kernels == NULL)
        argp_error(state, "--kernels: found \"%s\", expected scalar or neon", text);
    return kernels;
}

static const warp_method_t *read_method(struct argp_state *state, const char *text)
{
    const warp_method_t *method = warp_method_from_name(text);
    if (method != NULL)
        return method;
    char names[PROGRAM_NAMES_LENGTH];
    program_method_names(names);
    argp_error(state, "--method: found \"%s\", expected one of %s", text, names);
    return NULL;
}

static error_t read_room(const char **room, char *text, struct argp_state *state)
{
    if (state->arg_num > 0)
        argp_error(state, "found \"%s\", expected one room file", text);
    *room = text;
    return 0;
}

static const struct argp_option run_options[] = {
    {"video", KEY_VIDEO, "FILE", 0,
     "What the cameras deliver: PNG, numbered PNGs (frame_%05d.png), Y4M, raw XRGB, or "
     "\"pattern\"; needed",
     0},
    {"poses", KEY_POSES, "CSV", 0, "Pose list, run in virtual time", 0},
    {"bus", KEY_BUS, "PORT", 0, "Run in real time with the bus open on 127.0.0.1:PORT; 0 takes any free port", 0},
    {"out", KEY_OUT, "DIR", 0, "Folder for pictures, tables and the page; needed", 0},
    {"frames", KEY_FRAMES, "N", 0, "End after N frames (default: with the list, or on Ctrl-C)", 0},
    {"method", KEY_METHOD, "M", 0, "Method of every board, in place of the room's", 0},
    {"rate", KEY_RATE, "HZ", 0, "Refresh rate (default: the list's own up to 60, or 60)", 0},
    {"original", KEY_ORIGINAL, "PNG", 0, "A finer original of the picture, to judge by as well", 0},
    {"judge", KEY_JUDGE, "N", 0, "Judge every Nth frame, 0 none (default: 8 frames of the run)", 0},
    {"kernels", KEY_KERNELS, "LEVEL", 0, "Pixel loops: scalar or neon, of the same bytes (default: the fastest)", 0},
    {0},
};

static error_t read_run(int key, char *text, struct argp_state *state)
{
    sim_run_options_t *run = state->input;
    switch (key) {
    case KEY_VIDEO:
        run->video = text;
        return 0;
    case KEY_POSES:
        run->poses = text;
        return 0;
    case KEY_BUS:
        run->bus_port = read_number(state, "bus", text, 0, 65535);
        return 0;
    case KEY_OUT:
        run->out = text;
        return 0;
    case KEY_FRAMES:
        run->frames = read_number(state, "frames", text, 1, SIM_RUN_MAX_FRAMES);
        return 0;
    case KEY_METHOD:
        run->method = read_method(state, text);
        return 0;
    case KEY_KERNELS:
        run->kernels = read_kernels(state, text);
        return 0;
    case KEY_RATE:
        run->rate_hz = read_rate(state, text);
        return 0;
    case KEY_ORIGINAL:
        run->original = text;
        return 0;
    case KEY_JUDGE:
        run->judge = read_number(state, "judge", text, 0, SIM_RUN_MAX_FRAMES);
        return 0;
    case ARGP_KEY_ARG:
        return read_room(&run->room, text, state);
    case ARGP_KEY_END:
        if (run->room == NULL || run->video == NULL || run->out == NULL)
            argp_error(state, "expected ROOM, --video FILE and --out DIR");
        if ((run->poses == NULL) == (run->bus_port == SIM_RUN_NO_BUS))
            argp_error(state, "expected either --poses CSV or --bus PORT");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static int run_command(int argc, char **argv)
{
    static const struct argp argp = {
        .options = run_options,
        .parser = read_run,
        .args_doc = "ROOM",
        .doc = "Run the real firmware of every board of ROOM over a simulated bus; write pictures, tables and "
               "index.html into DIR.",
    };
    sim_run_options_t run = {.bus_port = SIM_RUN_NO_BUS, .judge = SIM_RUN_JUDGE_USUAL};
    if (argp_parse(&argp, argc, argv, 0, NULL, &run) != 0)
        return PROGRAM_BAD_USAGE;
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
        warp->method = read_method(state, text);
        return 0;
    case KEY_KERNELS:
        warp->kernels = read_kernels(state, text);
        return 0;
    case ARGP_KEY_ARG:
        return read_room(&warp->place.room, text, state);
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
                            "  run   every board of a room runs the real firmware over a simulated bus\n"
                            "  warp  one wall, one pose: one picture\n\n"
                            "wallwarp-sim COMMAND --help tells the rest. Exit status: 0 done, 1 failed, 2 bad usage.\n";

int main(int argc, char **argv)
{
    static char run_name[] = "wallwarp-sim run", warp_name[] = "wallwarp-sim warp";
    const char *command = argc > 1 ? argv[1] : "";
    argp_err_exit_status = PROGRAM_BAD_USAGE;
    if (strcmp(command, "run") == 0) {
        argv[1] = run_name;
        return run_command(argc - 1, argv + 1);
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
        fprintf(stderr, "wallwarp-sim: found \"%s\", expected run or warp\n", command);
    fputs(usage, stderr);
    return PROGRAM_BAD_USAGE;
}
