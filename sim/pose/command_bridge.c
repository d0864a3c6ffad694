// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose bridge`: sends what a tracker measures onto a bus.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "firmware/auth_key.h"
#include "sim/pose/bridge_run.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/pose/udp_listen.h"
#include "sim/program.h"

enum { KEY_NO_SYNC = 256, KEY_KEY };

static const char program[] = "wallwarp-pose bridge";

typedef struct {
    const tracker_protocol_t *protocol;
    const char *bus, *transform, *listen, *interface, *key;
    int64_t duration_us; /* 0: without end */
    bool fd, no_sync;
} options_t;

static void choose_protocol(struct argp_state *state, options_t *options, const char *name)
{
    if (options->protocol != NULL)
        argp_error(state, "one protocol expected, found also '%s'", name);
    options->protocol = tracker_protocol_named(name);
    if (options->protocol == NULL)
        argp_error(state, "no such protocol: '%s', expected freed, dtrack, psn, opentrackio or osc", name);
}

static void check(struct argp_state *state, options_t *options)
{
    char error[UDP_LISTEN_MESSAGE_LENGTH];
    if (options->protocol == NULL)
        argp_error(state, "the protocol is missing: freed, dtrack, psn, opentrackio or osc");
    command_check_fd(state, options->bus, options->fd);
    command_check_key(state, options->key, options->no_sync);
    if (options->transform == NULL)
        argp_error(state, "--transform is missing: a file such as those of sim/trackers/examples");
    if (options->listen == NULL)
        options->listen = options->protocol->listen;
    if (!udp_listen_check(options->listen, options->interface, error))
        argp_error(state, "--listen: %s", error);
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = command_bus(state, argument);
        return 0;
    case 'f':
        options->fd = true;
        return 0;
    case KEY_KEY:
        options->key = argument;
        return 0;
    case KEY_NO_SYNC:
        options->no_sync = true;
        return 0;
    case 't':
        options->transform = argument;
        return 0;
    case 'l':
        options->listen = argument;
        return 0;
    case 'i':
        options->interface = argument;
        return 0;
    case 's':
        options->duration_us = command_seconds_us(state, "--seconds", argument);
        return 0;
    case ARGP_KEY_ARG:
        choose_protocol(state, options, argument);
        return 0;
    case ARGP_KEY_END:
        check(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static int fail(const char *error)
{
    fprintf(stderr, "%s: %s\n", program, error);
    return PROGRAM_FAILED;
}

/* With everything open. */
static int run_bridge(const options_t *options, bridge_t *bridge, pose_link_t *link, int listener)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    bridge_run_t run = {.bridge = bridge,
                        .link = link,
                        .listener = listener,
                        .fd = options->fd,
                        .sync = !options->no_sync,
                        .show_progress = isatty(STDERR_FILENO),
                        .duration_us = options->duration_us,
                        .stop = command_catch_stop()};
    if (!command_open_key(program, options->key, options->bus, &run.auth))
        return PROGRAM_FAILED;
    const bool good = bridge_run(&run, error);
    pose_auth_close(run.auth);
    printf("%" PRIu64 " packets, %" PRIu64 " poses sent to %s\n", bridge->counts.packets, run.sent, options->bus);
    bridge_counts_print(stdout, &bridge->counts);
    const int status = program_finish(program);
    return good ? status : fail(error);
}

static int open_ends(const options_t *options, bridge_t *bridge)
{
    char listen_error[UDP_LISTEN_MESSAGE_LENGTH], error[POSE_LINK_MESSAGE_LENGTH];
    int port = 0;
    pose_link_t link;
    const int listener = udp_listen_open(options->listen, options->interface, &port, listen_error);
    if (listener < 0)
        return fail(listen_error);
    int status = PROGRAM_FAILED;
    if (pose_link_open(&link, options->bus, options->fd, error)) {
        fprintf(stderr, "%s: %s on %.*s:%d\n", program, options->protocol->what, (int)strcspn(options->listen, ":"),
                options->listen, port);
        status = run_bridge(options, bridge, &link, listener);
        pose_link_close(&link);
    } else {
        fail(error);
    }
    close(listener);
    return status;
}

int command_bridge(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"fd", 'f', NULL, 0,
         "One CAN FD frame of 32 bytes per pose, instead of three classic frames; not with HOST:PORT", 0},
        {"transform", 't', "FILE", 0, "Axes, unit, origin, bodies and eyes, in YAML: see sim/trackers/examples", 0},
        {"listen", 'l', "ADDR:PORT", 0, "Where packets arrive; a multicast address is joined", 0},
        {"interface", 'i', "ADDR", 0, "Join on the network interface of this address", 0},
        {"no-sync", KEY_NO_SYNC, NULL, 0, "Leave it to another to give the time of the bus (Sync and FollowUp)", 0},
        {"key", KEY_KEY, "FILE", 0, auth_key_help, 0},
        {"seconds", 's', "S", 0, "End after S seconds, instead of on SIGINT", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "PROTOCOL",
        .doc = "Send what a tracker measures onto a bus, until Ctrl-C.\v"
               "PROTOCOL, and where it listens without --listen:\n"
               "  freed         FreeD D1                            0.0.0.0:40000\n"
               "  dtrack        A.R.T. DTrack, ASCII output         0.0.0.0:5000\n"
               "  psn           PosiStageNet 2                      236.10.10.10:56565\n"
               "  opentrackio   OpenTrackIO 1.0.1, JSON or CBOR     239.135.1.1:55555\n"
               "  osc           /pose [id] x y z qw qx qy qz        0.0.0.0:9000\n\n"
               "At the end it says how many packets came, and why some gave no pose. The exit status is 0 when it was "
               "ended, 1 when it failed, 2 for bad usage.",
    };
    options_t options = {.protocol = NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &options);

    tracker_transform_t transform;
    char error[ROOM_MESSAGE_LENGTH];
    if (!tracker_transform_load(&transform, options.transform, error))
        return fail(error);
    bridge_t *bridge = malloc(sizeof *bridge);
    if (bridge == NULL)
        return fail("out of memory");
    bridge_init(bridge, options.protocol, &transform);
    const int status = open_ends(&options, bridge);
    free(bridge);
    return status;
}
