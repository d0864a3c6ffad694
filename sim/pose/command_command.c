// SPDX-License-Identifier: Apache-2.0
// `wallwarp-pose command`: tell boards something, or ask them.
#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/auth_key.h"
#include "firmware/byte_order.h"
#include "firmware/can_protocol.h"
#include "sim/options.h"
#include "sim/pose/board_answer.h"
#include "sim/pose/board_talk.h"
#include "sim/pose/command_options.h"
#include "sim/pose/commands.h"
#include "sim/pose/request_text.h"
#include "sim/program.h"

enum { KEY_ALL = 256, KEY_KEY, QUIET_US = 1000000, ROLL_CALL_US = 500000 };

typedef struct {
    const char *bus, *name, *value, *key;
    int node; /**< 0: all */
    bool node_given, whole_log;
    command_t request;
} options_t;

/* A bus that is listened to, and who is asked. */
typedef struct {
    const char *program;
    const volatile sig_atomic_t *stop;
    pose_link_t link;
    can_auth_t *auth;
    board_talk_t talk[CAN_MAX_NODE];
    int boards;
    bool some_missing; /* a board is there that did not answer the roll call */
} session_t;

static void check_usage(struct argp_state *state, options_t *options)
{
    char error[REQUEST_TEXT_MESSAGE_LENGTH];
    if (options->bus == NULL)
        argp_error(state, "--bus is missing");
    if (!options->node_given)
        argp_error(state, "--node is missing: 1 to %d, or all", CAN_MAX_NODE);
    if (options->name == NULL)
        argp_error(state, "what to tell the board is missing");
    else if (!request_from_text(&options->request, options->name, options->value, error))
        argp_error(state, "%s", error);
    if (options->whole_log && options->request.kind != COMMAND_LOG)
        argp_error(state, "--all is for log only");
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case 'b':
        options->bus = command_bus(state, argument);
        return 0;
    case 'n':
        options->node_given = true;
        options->node = 0;
        if (strcmp(argument, "all") != 0)
            options->node = (int)options_whole(state, "--node", argument, 1, CAN_MAX_NODE);
        return 0;
    case KEY_KEY:
        options->key = argument;
        return 0;
    case KEY_ALL:
        options->whole_log = true;
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num == 0)
            options->name = argument;
        else if (state->arg_num == 1)
            options->value = argument;
        else
            argp_error(state, "one command with one value expected, found also '%s'", argument);
        return 0;
    case ARGP_KEY_END:
        check_usage(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* @return false when the bus has failed; said. */
static bool ask(session_t *session, int64_t quiet_us)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    for (int i = 0; i < session->boards; i++)
        session->talk[i].auth = session->auth;
    if (board_talk(&session->link, session->talk, session->boards, quiet_us, session->stop, error))
        return true;
    fprintf(stderr, "%s: %s\n", session->program, error);
    return false;
}

/* Whoever is there. @return false when the bus has failed, or nobody is; said. */
static bool call_the_roll(session_t *session)
{
    session->boards = CAN_MAX_NODE;
    for (int i = 0; i < CAN_MAX_NODE; i++)
        session->talk[i] = (board_talk_t){.node = (uint8_t)(i + 1), .request = {.kind = COMMAND_HELLO}};
    if (!ask(session, ROLL_CALL_US))
        return false;
    session->boards = 0;
    for (int i = 0; i < CAN_MAX_NODE; i++) {
        const board_talk_t *talk = &session->talk[i];
        if (talk->replied)
            session->talk[session->boards++] = *talk;
        else if (talk->alive || talk->answering)
            session->some_missing = !board_answer_silent(session->program, talk);
    }
    if (session->boards == 0 && !session->some_missing)
        fprintf(stderr, "%s: no board is there; power, cable, bit rate? Two nodes or more must be on a bus\n",
                session->program);
    return session->boards > 0;
}

/* One board's log, from an event on. */
static bool read_log(session_t *session, int node, uint32_t first)
{
    int events = COMMAND_MOST_EVENTS;
    while (events == COMMAND_MOST_EVENTS) {
        session->boards = 1;
        session->talk[0] = (board_talk_t){.node = (uint8_t)node, .request = {COMMAND_LOG, .first_event = first}};
        if (!ask(session, QUIET_US) || !board_answer_done(session->program, session->talk))
            return false;
        events = board_answer_print_events(session->talk);
        first = get_u32(session->talk[0].answer) + (uint32_t)events;
    }
    return true;
}

/* After a hello of everybody. */
static bool read_logs(session_t *session, bool whole)
{
    uint8_t node[CAN_MAX_NODE];
    uint32_t first[CAN_MAX_NODE];
    const int boards = session->boards;
    bool done = true;
    for (int i = 0; i < boards; i++) {
        const board_talk_t *talk = &session->talk[i];
        if (!board_answer_done(session->program, talk))
            return false;
        const uint32_t events = get_u32(talk->answer + 1);
        node[i] = talk->node;
        first[i] = whole || events < COMMAND_MOST_EVENTS ? 0 : events - COMMAND_MOST_EVENTS;
    }
    for (int i = 0; i < boards; i++)
        done = read_log(session, node[i], first[i]) && done;
    return done;
}

static bool tell(session_t *session, const options_t *options)
{
    const bool log = options->request.kind == COMMAND_LOG;
    const command_t request = log ? (command_t){.kind = COMMAND_HELLO} : options->request;
    if (options->node == 0 && !call_the_roll(session))
        return false;
    if (options->node != 0) {
        session->boards = 1;
        session->talk[0].node = (uint8_t)options->node;
    }
    for (int i = 0; i < session->boards; i++)
        session->talk[i].request = request;
    const bool asked = options->node == 0 && request.kind == COMMAND_HELLO;
    if (!asked && !ask(session, QUIET_US))
        return false;
    bool done = !session->some_missing;
    if (log)
        return read_logs(session, options->whole_log) && done;
    for (int i = 0; i < session->boards; i++) {
        if (board_answer_done(session->program, &session->talk[i]))
            board_answer_print(&session->talk[i]);
        else
            done = false;
    }
    return done;
}

static bool open_key(session_t *session, const char *file)
{
    char error[HAL_KEY_ERROR_LENGTH];
    session->auth = file == NULL ? NULL : auth_key_open(file, error);
    if (file != NULL && session->auth == NULL)
        fprintf(stderr, "%s: --key: %s\n", session->program, error);
    return file == NULL || session->auth != NULL;
}

int command_command(int argc, char **argv)
{
    static const struct argp_option option_table[] = {
        {"bus", 'b', "BUS", 0, command_bus_help, 0},
        {"node", 'n', "N", 0, "Which board: its node number, or all; needed", 0},
        {"key", KEY_KEY, "FILE", 0, "The room's key: boards with one do only what who has the same one tells them", 0},
        {"all", KEY_ALL, NULL, 0, "log: all events that the board keeps, not only the newest 50", 0},
        {0},
    };
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "COMMAND [VALUE]",
        .doc = "Tell a board something, or ask it.\v"
               "Commands:\n"
               "  hello          which firmware it is\n"
               "  method NAME    correct with another method; room: with the room file's\n"
               "  freeze on|off  keep the wall's picture as it is\n"
               "  pattern none|grid|white|black\n"
               "                 show a picture for setting up the projector\n"
               "  latency MS     all boards show pictures so late after their pose, up to 200:\n"
               "                 as late as the slowest at least; the longest that any board\n"
               "                 was told counts; 0: each as early as it can\n"
               "  reboot         start anew\n"
               "  log            what has happened, newest last\n\n"
               "It holds until another is given, or the board starts anew. Exit status: 0 every board has done it, 1 "
               "one has not, 2 bad usage.",
    };
    static session_t session;
    char error[POSE_LINK_MESSAGE_LENGTH];
    options_t options = {.bus = NULL};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    session.program = argv[0];
    session.stop = command_catch_stop();
    if (!open_key(&session, options.key))
        return PROGRAM_FAILED;
    if (!pose_link_open(&session.link, options.bus, false, error)) {
        fprintf(stderr, "%s: %s\n", argv[0], error);
        can_auth_close(session.auth);
        return PROGRAM_FAILED;
    }
    bool done = pose_link_listen(&session.link, error);
    if (done)
        done = tell(&session, &options);
    else
        fprintf(stderr, "%s: %s\n", argv[0], error);
    pose_link_close(&session.link);
    can_auth_close(session.auth);
    const int status = program_finish(argv[0]);
    return done ? status : PROGRAM_FAILED;
}
