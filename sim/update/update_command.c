// SPDX-License-Identifier: Apache-2.0
// `wallwarp-sim update`: play a room's update, in virtual time.
#include "sim/update/update_command.h"

#include <argp.h>
#include <string.h>

#include "sim/options.h"
#include "sim/pose/room_update_text.h"
#include "sim/program.h"
#include "sim/update/update_record.h"

enum { KEY_FAIL = 256, KEY_INSTALL, KEY_REBOOT, KEY_IN, KEY_LOSE, KEY_SEED, KEY_OUT, US_PER_S = 1000000 };

typedef struct {
    const char *room, *out;
    const char *fail[ROOM_MAX_BOARDS]; /* NAME=WHAT */
    int fails;
    update_play_settings_t play;
} options_t;

static const struct argp_option option_table[] = {
    {"fail", KEY_FAIL, "NAME=WHAT", 0,
     "What goes wrong on that board; install: its install fails; crash: the new version does not start on it; its bus "
     "cable is out, silent: when it is to promise the switch, deaf: when it is to hear that the moment holds, lost: at "
     "the moment. May be given again",
     0},
    {"install", KEY_INSTALL, "S", 0, "Seconds that an install takes, 1 to 600 (20)", 0},
    {"reboot", KEY_REBOOT, "S", 0, "Seconds that a board takes to start, 1 to 60 (8)", 0},
    {"in", KEY_IN, "S", 0, "The switch is in so long, 5 to 59 (6)", 0},
    {"lose", KEY_LOSE, "PERCENT", 0, "Of all frames on the bus, 0 to 50 (0)", 0},
    {"seed", KEY_SEED, "N", 0, "Of all that is random (1)", 0},
    {"out", KEY_OUT, "DIR", 0, "Folder for update.csv and update.svg; needed", 0},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    options_t *options = state->input;
    update_play_settings_t *play = &options->play;
    switch (key) {
    case KEY_FAIL:
        if (options->fails == ROOM_MAX_BOARDS)
            argp_error(state, "--fail: given more than %d times", ROOM_MAX_BOARDS);
        options->fail[options->fails++] = text;
        return 0;
    case KEY_INSTALL:
        play->install_us = US_PER_S * options_whole(state, "--install", text, 1, 600);
        return 0;
    case KEY_REBOOT:
        play->reboot_us = US_PER_S * options_whole(state, "--reboot", text, 1, 60);
        return 0;
    case KEY_IN:
        play->ahead_us = US_PER_S * options_whole(state, "--in", text, ROOM_UPDATE_LEAST_AHEAD_US / US_PER_S,
                                                  UPDATE_MOST_AHEAD_US / US_PER_S - 1);
        return 0;
    case KEY_LOSE:
        play->lose_ppm = (uint32_t)(10000 * options_whole(state, "--lose", text, 0, 50));
        return 0;
    case KEY_SEED:
        play->seed = (uint64_t)options_whole(state, "--seed", text, 0, 1000000000);
        return 0;
    case KEY_OUT:
        options->out = text;
        return 0;
    case ARGP_KEY_ARG:
        return options_room(&options->room, text, state);
    case ARGP_KEY_END:
        if (options->room == NULL || options->out == NULL)
            argp_error(state, "expected ROOM and --out DIR");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* "front=crash". @return false, with the reason in error, when there is no such board or failure. */
static bool take_failure(update_play_settings_t *play, const char *text, char error[ROOM_MESSAGE_LENGTH])
{
    const char *equals = strchr(text, '=');
    int board = 0, failure = UPDATE_PLAY_WELL + 1;
    const size_t length = equals == NULL ? strlen(text) : (size_t)(equals - text);
    while (board < play->room->board_count &&
           (strncmp(play->room->board[board].name, text, length) != 0 || play->room->board[board].name[length] != '\0'))
        board++;
    while (equals != NULL && failure < UPDATE_PLAY_FAILURES &&
           strcmp(equals + 1, update_play_failure_name((update_play_failure_t)failure)) != 0)
        failure++;
    if (equals == NULL || board == play->room->board_count || failure == UPDATE_PLAY_FAILURES) {
        snprintf(error, ROOM_MESSAGE_LENGTH,
                 "--fail: found \"%.80s\", expected a board of the room, '=', and install, crash, silent, deaf or lost",
                 text);
        return false;
    }
    play->failure[board] = (update_play_failure_t)failure;
    return true;
}

static bool play_all(const options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    static update_record_t record;
    update_play_t *play = update_play_open(&options->play, error);
    if (play == NULL)
        return false;
    while (update_play_step(play))
        update_record_take(&record, play, options->play.room, stdout);
    update_record_take(&record, play, options->play.room, stdout);
    room_update_print_table(stdout, update_play_operator(play));
    room_update_print_result(stdout, update_play_operator(play));
    const char *wrong = update_play_error(play);
    if (wrong != NULL)
        snprintf(error, ROOM_MESSAGE_LENGTH, "%s", wrong);
    const bool ok = wrong == NULL && update_record_write(&record, options->play.room, options->out, error);
    update_play_close(play);
    return ok;
}

int update_command(int argc, char **argv)
{
    static const struct argp argp = {
        .options = option_table,
        .parser = parse,
        .args_doc = "ROOM",
        .doc =
            "Play an update of all boards of ROOM, with their real firmware, in virtual time: they install, then they "
            "switch at one moment, or none does.",
    };
    static room_t room;
    options_t options = {.play = {.room = &room,
                                  .install_us = 20 * US_PER_S,
                                  .reboot_us = 8 * US_PER_S,
                                  .ahead_us = 6 * US_PER_S,
                                  .seed = 1}};
    char error[ROOM_MESSAGE_LENGTH];
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    bool ok = room_load(&room, options.room, program_warn, NULL, error);
    for (int i = 0; ok && i < options.fails; i++)
        ok = take_failure(&options.play, options.fail[i], error);
    if (!ok || !play_all(&options, error)) {
        fprintf(stderr, "%s: %s\n", argv[0], error);
        return PROGRAM_FAILED;
    }
    return program_finish(argv[0]);
}
