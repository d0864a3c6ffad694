// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-sim run.
#include "sim/run/run_options.h"

#include <argp.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/auth_key.h"
#include "sim/devices/sim_picture.h"
#include "sim/options.h"
#include "sim/run/run_rate.h"

enum {
    KEY_VIDEO = 256,
    KEY_POSES,
    KEY_BUS,
    KEY_OUT,
    KEY_FRAMES,
    KEY_METHOD,
    KEY_CAMERA,
    KEY_DISPLAY,
    KEY_KERNELS,
    KEY_RATE,
    KEY_GENLOCK,
    KEY_ORIGINAL,
    KEY_JUDGE,
    KEY_KEY
};

static double read_rate(struct argp_state *state, const char *text)
{
    char *end;
    const double rate = strtod(text, &end);
    if (end == text || *end != '\0' || !(rate >= RUN_RATE_LEAST_HZ && rate <= RUN_RATE_MAX_HZ))
        argp_error(state, "--rate: found \"%s\", expected %d to %d Hz", text, RUN_RATE_LEAST_HZ, RUN_RATE_MAX_HZ);
    return rate;
}

/* PPM or PPM,NODE. */
static house_signal_options_t read_genlock(struct argp_state *state, const char *text)
{
    char *end;
    const long ppm = strtol(text, &end, 10);
    bool good = end != text && ppm >= -1000 && ppm <= 1000;
    long node = 0;
    if (good && *end == ',') {
        const char *number = end + 1;
        node = strtol(number, &end, 10);
        good = end != number && node >= 1 && node <= ROOM_MAX_NODE;
    }
    if (!good || *end != '\0')
        argp_error(state, "--genlock: found \"%s\", expected -1000 to 1000 ppm, and maybe a comma and a node", text);
    return (house_signal_options_t){.on = true, .ppm = (int32_t)ppm, .node = (int32_t)node};
}

static picture_format_t read_format(struct argp_state *state, const char *name, const char *text)
{
    picture_format_t format = PICTURE_XRGB8888;
    if (!sim_picture_format_from_name(&format, text, strlen(text)))
        argp_error(state, "--%s: found \"%s\", expected a format as xrgb8888 or nv12", name, text);
    return format;
}

static const struct argp_option run_options[] = {
    {"video", KEY_VIDEO, "FILE", 0,
     "What the cameras deliver: PNG, numbered PNGs (frame_%05d.png), Y4M, raw XRGB, or "
     "\"pattern\"; needed",
     0},
    {"poses", KEY_POSES, "CSV", 0, "Pose list, run in virtual time", 0},
    {"bus", KEY_BUS, "PORT", 0,
     "Run in real time with the bus open on 127.0.0.1:PORT; 0 takes any free port. Without --frames it goes on, "
     "and keeps the pictures of every frame",
     0},
    {"out", KEY_OUT, "DIR", 0, "Folder for pictures, tables and the page; needed", 0},
    {"frames", KEY_FRAMES, "N", 0, "End after N frames (default: with the list, or on Ctrl-C)", 0},
    {"method", KEY_METHOD, "M", 0, "Method of every board, in place of the room's", 0},
    {"camera", KEY_CAMERA, "FORMAT", 0,
     "What the cameras deliver: xrgb8888 (default), rgb888, bgr888, yuyv, uyvy or nv12", 0},
    {"display", KEY_DISPLAY, "FORMAT", 0, "What the displays take besides xrgb8888, if anything: nv12 or yuyv", 0},
    {"rate", KEY_RATE, "HZ", 0,
     "Refresh rate of every board, in place of the room's (without either: the list's own up to 60, or 60)", 0},
    {"genlock", KEY_GENLOCK, "PPM[,NODE]", 0,
     "A house signal at the refresh rate, PPM faster, on the genlock input of every board, or of one", 0},
    {"original", KEY_ORIGINAL, "PNG", 0, "A finer original of the picture, to judge by as well", 0},
    {"judge", KEY_JUDGE, "N", 0, "Judge every Nth frame, 0 none (default: 8 frames of the run)", 0},
    {"key", KEY_KEY, "FILE", 0, auth_key_help, 0},
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
        run->bus_port = (int32_t)options_whole(state, "--bus", text, 0, 65535);
        return 0;
    case KEY_OUT:
        run->out = text;
        return 0;
    case KEY_FRAMES:
        run->frames = (int32_t)options_whole(state, "--frames", text, 1, SIM_RUN_MAX_FRAMES);
        return 0;
    case KEY_KEY:
        run->key = text;
        return 0;
    case KEY_METHOD:
        run->method = options_method(state, text);
        return 0;
    case KEY_KERNELS:
        run->kernels = options_kernels(state, text);
        return 0;
    case KEY_CAMERA:
        run->camera = read_format(state, "camera", text);
        return 0;
    case KEY_DISPLAY:
        run->display = read_format(state, "display", text);
        return 0;
    case KEY_RATE:
        run->rate_hz = read_rate(state, text);
        return 0;
    case KEY_GENLOCK:
        run->house = read_genlock(state, text);
        return 0;
    case KEY_ORIGINAL:
        run->original = text;
        return 0;
    case KEY_JUDGE:
        run->judge = (int32_t)options_whole(state, "--judge", text, 0, SIM_RUN_MAX_FRAMES);
        return 0;
    case ARGP_KEY_ARG:
        return options_room(&run->room, text, state);
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

void run_options_parse(sim_run_options_t *options, int argc, char **argv)
{
    static const struct argp argp = {
        .options = run_options,
        .parser = read_run,
        .args_doc = "ROOM",
        .doc = "Run the real firmware of every board of ROOM over a simulated bus; write pictures, tables and "
               "index.html into DIR.",
    };
    *options = (sim_run_options_t){.bus_port = SIM_RUN_NO_BUS, .judge = SIM_RUN_JUDGE_USUAL};
    argp_parse(&argp, argc, argv, 0, NULL, options);
}
