// SPDX-License-Identifier: Apache-2.0
// Judges whether the boards run one version of the firmware.
#include "sim/pose/bus_check_update.h"

void bus_check_updates(bus_judge_t *judge, const bus_watch_t *watch)
{
    int first = 0;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (!board->has_update || board->update.state == CAN_UPDATE_NO_AGENT)
            continue;
        if (first == 0)
            first = node;
        if (board->update.running != watch->board[first].update.running)
            bus_judge_say(judge, false,
                          "board %d: another version than board %d runs; `wallwarp-pose update --status` says which",
                          node, first);
        if (board->update.state == CAN_UPDATE_FAILED)
            bus_judge_say(judge, false, "board %d: an update has failed; `wallwarp-pose update --status` says why",
                          node);
        if (board->update.trial)
            bus_judge_say(judge, true, "board %d: its version is on trial", node);
    }
}
