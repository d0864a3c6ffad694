// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose update`: all boards of a room to another version, as one.
#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "firmware/auth_key.h"
#include "firmware/room.h"
#include "sim/devices/sim_clock.h"
#include "sim/options.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/pose/pose_link.h"
#include "sim/pose/room_update_text.h"
#include "sim/program.h"

enum {
    KEY_INSTALL = 256,
    KEY_SWITCH,
    KEY_VERSION,
    KEY_IN,
    KEY_STATUS,
    KEY_CANCEL,
    KEY_KEY,
    WAIT_MS = 1,
    US_PER_S = 1000000
};

enum { USUAL_AHEAD_S = 6, MOST_AHEAD_S = UPDATE_MOST_AHEAD_US / US_PER_S - 1 };

typedef struct {
    const char *bus, *room, *key;
    const char *source, *version;
    bool switches, status, cancel, ahead_given;
    int64_t ahead_us;
} options_t;

typedef struct {
    const char *program;
    const volatile sig_atomic_t *stop;
    pose_link_t link;
    can_auth_t *auth;
    room_t room;
    room_update_t update;
    bool stopped;
    int64_t begun_us;
    char told[ROOM_MAX_BOARDS][ROOM_UPDATE_TEXT_LENGTH]; /* of each board, last */
} session_t;

static void check_usage(struct argp_state *state, const options_t *options)
{
    if (options->bus == NULL)
        argp_error(state, "--bus is missing");
    if (options->room == NULL)
        argp_error(state, "ROOM is missing");
    const bool changes = options->source != NULL || options->switches;
    if ((int)options->status + (int)options->cancel + (int)changes != 1)
        argp_error(state, "expected --status, --cancel, or --install SOURCE and --switch, one of them or both");
    if ((options->version != NULL || options->ahead_given) && !options->switches)
        argp_error(state, "--version and --in are for --switch");
}

static const char *word(struct argp_state *state, const char *option, const char *text, bool good, const char *expected)
{
    if (!good)
        argp_error(state, "%s: found \"%.60s\", expected %s", option, text, expected);
    return text;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = command_bus(state, argument);
        return 0;
    case KEY_INSTALL:
        options->source = word(state, "--install", argument, hal_update_is_source(argument),
                               "usb, an absolute path on the boards, or a URL (http, https), of up to 200 characters");
        return 0;
    case KEY_VERSION:
        options->version = word(state, "--version", argument, hal_update_is_version(argument), "a version such as 0.6");
        return 0;
    case KEY_IN:
        options->ahead_given = true;
        options->ahead_us = US_PER_S * (int64_t)options_whole(state, "--in", argument,
                                                              ROOM_UPDATE_LEAST_AHEAD_US / US_PER_S, MOST_AHEAD_S);
        return 0;
    case KEY_SWITCH:
        options->switches = true;
        return 0;
    case KEY_STATUS:
        options->status = true;
        return 0;
    case KEY_CANCEL:
        options->cancel = true;
        return 0;
    case KEY_KEY:
        options->key = argument;
        return 0;
    case ARGP_KEY_ARG:
        return options_room(&options->room, argument, state);
    case ARGP_KEY_END:
        check_usage(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* A line on stderr for each board that is not as it was told to be; of its progress, every tenth. */
static void tell_changes(session_t *session)
{
    const room_update_t *u = &session->update;
    for (int i = 0; i < u->boards; i++) {
        room_update_board_t board = u->board[i];
        char text[ROOM_UPDATE_TEXT_LENGTH];
        board.status.progress -= board.status.progress % 10;
        room_update_board_text(text, &board);
        if (!board.answered || strcmp(text, session->told[i]) == 0)
            continue;
        memcpy(session->told[i], text, sizeof text);
        fprintf(stderr, "%7.1f s  %s: %s\n", (double)(sim_clock_monotonic_us() - session->begun_us) / US_PER_S,
                board.name, text);
    }
}

/* @return false when the bus has failed; said. */
static bool turn(session_t *session)
{
    room_update_t *u = &session->update;
    char error[POSE_LINK_MESSAGE_LENGTH];
    hal_can_frame_t frame;
    if (*session->stop && !session->stopped) {
        session->stopped = true;
        room_update_stop(u, sim_clock_monotonic_us());
    }
    room_update_step(u, sim_clock_monotonic_us());
    bool ok = true;
    while (ok && room_update_next(u, &frame, sim_clock_monotonic_us()))
        ok = pose_link_send(&session->link, &frame, 1, error);
    const pose_link_heard_t heard = ok ? pose_link_receive(&session->link, &frame, WAIT_MS, error) : POSE_LINK_ENDED;
    if (heard == POSE_LINK_FRAME)
        room_update_hear(u, &frame, sim_clock_monotonic_us());
    if (heard == POSE_LINK_ENDED)
        fprintf(stderr, "%s: %s\n", session->program, error);
    return heard != POSE_LINK_ENDED;
}

/* @return Was it done? */
static bool run(session_t *session, const room_update_settings_t *settings)
{
    room_update_t *u = &session->update;
    room_update_init(u, settings, &session->room, sim_clock_monotonic_us());
    bool ok = true;
    while (ok && u->result == ROOM_UPDATE_WORKING) {
        ok = turn(session);
        if (settings->task != ROOM_UPDATE_STATUS && !u->talking)
            tell_changes(session);
    }
    room_update_print_table(stdout, u);
    room_update_print_result(stdout, u);
    fflush(stdout);
    return ok && u->result == ROOM_UPDATE_DONE;
}

static bool do_all(session_t *session, const options_t *options)
{
    room_update_settings_t settings = {
        .task = options->cancel ? ROOM_UPDATE_CANCEL : ROOM_UPDATE_STATUS,
        .source = options->source,
        .version = options->version,
        .ahead_us = options->ahead_us,
        .auth = session->auth,
    };
    session->begun_us = sim_clock_monotonic_us();
    if (options->source != NULL) {
        settings.task = ROOM_UPDATE_INSTALL;
        if (!run(session, &settings) || !options->switches)
            return session->update.result == ROOM_UPDATE_DONE;
    }
    if (options->switches)
        settings.task = ROOM_UPDATE_SWITCH;
    return run(session, &settings);
}

static bool open_session(session_t *session, const options_t *options)
{
    char error[ROOM_MESSAGE_LENGTH], key_error[HAL_KEY_ERROR_LENGTH], link_error[POSE_LINK_MESSAGE_LENGTH];
    const char *said = NULL;
    if (!room_load(&session->room, options->room, program_warn, NULL, error))
        said = error;
    else if (options->key != NULL && (session->auth = auth_key_open(options->key, key_error)) == NULL)
        said = key_error;
    else if (!pose_link_open(&session->link, options->bus, false, link_error))
        said = link_error;
    if (said == NULL && pose_link_listen(&session->link, link_error))
        return true;
    if (said == NULL)
        pose_link_close(&session->link);
    fprintf(stderr, "%s: %s\n", session->program, said == NULL ? link_error : said);
    can_auth_close(session->auth);
    return false;
}

int command_update(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"status", KEY_STATUS, NULL, 0, "Show how every board is, and change nothing", 0},
        {"install", KEY_INSTALL, "SOURCE", 0,
         "Have every board install a bundle beside what it runs: an http or https URL, an absolute path on the boards, "
         "or usb",
         0},
        {"switch", KEY_SWITCH, NULL, 0,
         "When every board has the bundle, start all in it at one moment, and wait until each has marked it good; with "
         "--install after that",
         0},
        {"version", KEY_VERSION, "V", 0,
         "Switch to this one (the one that waits on all boards); boards that run it stay as they are. The former one "
         "is still there: so all go back",
         0},
        {"in", KEY_IN, "SECONDS", 0, "The moment is in so long, 5 to 59 (6)", 0},
        {"cancel", KEY_CANCEL, NULL, 0, "Drop a switch that is to come", 0},
        {"key", KEY_KEY, "FILE", 0, "The room's key: boards with one do only what who has the same one tells them", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "ROOM",
        .doc =
            "Update all boards of a room as one: none starts in a new version before all have it.\v"
            "SIGINT before the moment cancels the switch on all boards. Exit status: 0 all boards have done it, with "
            "--switch: run the version and have marked it good; 1 not all, said board by board; 2 bad usage.",
    };
    static session_t session;
    options_t options = {.ahead_us = (int64_t)USUAL_AHEAD_S * US_PER_S};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    session.program = argv[0];
    session.stop = command_catch_stop();
    if (!open_session(&session, &options))
        return PROGRAM_FAILED;
    const bool done = do_all(&session, &options);
    pose_link_close(&session.link);
    can_auth_close(session.auth);
    const int status = program_finish(argv[0]);
    return done ? status : PROGRAM_FAILED;
}
