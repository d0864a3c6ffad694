// SPDX-License-Identifier: Apache-2.0
// A room's update in words.
#include "sim/pose/room_update_text.h"

#include <string.h>

const char *room_update_refusal(uint8_t refusal)
{
    static const char *const reasons[] = {
        [UPDATE_DONE] = "refuses, and does not say why",
        [UPDATE_NO_AGENT] = "has no update agent",
        [UPDATE_BUSY] = "is installing or switching, or has promised a switch; wait, or --cancel",
        [UPDATE_NOT_THERE] = "has not this version in its other slot; --install it",
        [UPDATE_ON_TRIAL] = "has not marked the version good that it runs; wait, or look at its faults",
        [UPDATE_NO_TIME] = "does not know bus time; wait some seconds, in a room with a key start the tracker",
        [UPDATE_BAD_TIME] = "says that the moment is over, or too far",
        [UPDATE_NO_PROMISE] = "knows of no promise for this moment; is another updating the room?",
        [UPDATE_NOT_TOLD] = "cannot reach its update agent; `systemctl status` on the board says why",
    };
    return refusal < sizeof reasons / sizeof reasons[0] ? reasons[refusal]
                                                        : "gives a reason that this program does not know";
}

static void state_text(char text[ROOM_UPDATE_TEXT_LENGTH], const update_status_t *status)
{
    int length = snprintf(text, ROOM_UPDATE_TEXT_LENGTH, "runs %s%s, ",
                          status->running[0] == '\0' ? "?" : status->running, status->trial ? " on trial" : "");
    char *rest = text + length;
    const size_t size = ROOM_UPDATE_TEXT_LENGTH - (size_t)length;
    if (status->state == CAN_UPDATE_INSTALLING)
        snprintf(rest, size, "installing %d %%", (int)status->progress);
    else if (status->plan != UPDATE_NO_PLAN)
        snprintf(rest, size, "%s the switch to %s", status->plan == UPDATE_PROMISED ? "promised" : "will do",
                 status->other);
    else if (status->state == CAN_UPDATE_READY)
        snprintf(rest, size, "%s waits", status->waiting);
    else if (status->state == CAN_UPDATE_FAILED)
        snprintf(rest, size, "failed: %s", status->message[0] == '\0' ? "it does not say why" : status->message);
    else
        snprintf(rest, size, "%s", can_update_state_name(status->state));
}

static const char *trouble_text(const room_update_board_t *board)
{
    switch (board->trouble) {
    case ROOM_BOARD_SILENT:
        return "is silent; power, cable, bit rate?";
    case ROOM_BOARD_KEY:
        return "has another key than this program (--key FILE), or none";
    case ROOM_BOARD_OLD:
        return "does not know this; is its firmware older than this program?";
    case ROOM_BOARD_NO_AGENT:
        return room_update_refusal(UPDATE_NO_AGENT);
    case ROOM_BOARD_REFUSES:
        return room_update_refusal(board->refusal);
    case ROOM_BOARD_OTHER:
        return "has not the version that the room is to have";
    case ROOM_BOARD_TIME:
        return room_update_refusal(UPDATE_NO_TIME);
    case ROOM_BOARD_BACK:
        return "is in its former slot";
    case ROOM_BOARD_TRIAL:
        return "not marked good yet; `wallwarp-pose monitor` shows faults, if it has some";
    case ROOM_BOARD_FAILED:
    case ROOM_BOARD_WELL:
        break;
    }
    return "";
}

void room_update_board_text(char text[ROOM_UPDATE_TEXT_LENGTH], const room_update_board_t *board)
{
    const char *trouble = trouble_text(board);
    text[0] = '\0';
    if (board->known)
        state_text(text, &board->status);
    const size_t used = strlen(text);
    if (trouble[0] != '\0')
        snprintf(text + used, ROOM_UPDATE_TEXT_LENGTH - used, "%s%s", used > 0 ? "; " : "", trouble);
}

void room_update_print_table(FILE *file, const room_update_t *u)
{
    fprintf(file, "node  slot  board\n");
    for (int i = 0; i < u->boards; i++) {
        const room_update_board_t *board = &u->board[i];
        char text[ROOM_UPDATE_TEXT_LENGTH];
        room_update_board_text(text, board);
        fprintf(file, "%4u  %-4c  %s: %s\n", (unsigned)board->node, board->known ? board->status.slot : '?',
                board->name, text);
    }
}

/* How a mixed room becomes one again: the others back, or those that are back once more. */
static void print_ways(FILE *file, const room_update_t *u)
{
    const char *former = "";
    for (int i = 0; i < u->boards; i++)
        if (u->board[i].known && strcmp(u->board[i].status.running, u->version) == 0)
            former = u->board[i].status.other;
    fprintf(file, "the room is mixed, or may be: not every board runs %s, or has said so\n", u->version);
    if (former[0] != '\0')
        fprintf(file, "to have all run %s again: --switch --version %s\n", former, former);
    fprintf(file, "to try again: --install SOURCE of %s, then --switch --version %s\n", u->version, u->version);
}

void room_update_print_result(FILE *file, const room_update_t *u)
{
    switch (u->result) {
    case ROOM_UPDATE_WORKING:
        break;
    case ROOM_UPDATE_DONE:
        if (u->settings.task == ROOM_UPDATE_INSTALL)
            fprintf(file, "all %d boards have %s: --switch starts them in it\n", u->boards, u->version);
        else if (u->settings.task == ROOM_UPDATE_SWITCH)
            fprintf(file, "all %d boards run %s, and have marked it good\n", u->boards, u->version);
        else if (u->settings.task == ROOM_UPDATE_CANCEL)
            fprintf(file, "no board of %d will switch\n", u->boards);
        break;
    case ROOM_UPDATE_REFUSED:
        fprintf(file, "nothing was begun\n");
        break;
    case ROOM_UPDATE_FAILED:
        fprintf(file, "not all boards have the same version: none will switch\n");
        break;
    case ROOM_UPDATE_CANCELLED:
        fprintf(file, "cancelled: no board has switched\n");
        break;
    case ROOM_UPDATE_MIXED:
        print_ways(file, u);
        break;
    }
}
