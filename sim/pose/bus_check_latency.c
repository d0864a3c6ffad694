// SPDX-License-Identifier: Apache-2.0
// Judges how late boards are, what they have counted, and why they are not in step.
#include "sim/pose/bus_check_latency.h"

#include <inttypes.h>
#include <stddef.h>

enum { COUNTS_LONG = 4096, COUNTS_SHORT = 256, APART_US = 10000 };

const char *bus_check_step_name(can_step_fault_t fault)
{
    static const char *const names[] = {"in step",    "no bus time", "no leader", "panel off",
                                        "no picture", "no pose",     "not shown"};
    return names[fault];
}

const char *bus_check_step_advice(const bus_watch_board_t *board)
{
    switch (board->has_latency ? board->latency.fault : CAN_STEP_OK) {
    case CAN_STEP_OK:
        break;
    case CAN_STEP_NO_TIME:
        return "now it has no exact bus time; Sync and FollowUp, or a jumping clock?";
    case CAN_STEP_NO_CLOCK:
        return "now it hears nobody who leads; its bus, or another board with its node number?";
    case CAN_STEP_PANEL:
        return "now its panel's refreshes begin at another time than the room's; genlock, refresh_hz?";
    case CAN_STEP_PICTURE:
        return "now its camera does not deliver the pictures that the others show; its source, its lag below?";
    case CAN_STEP_POSE:
        return "now the pose that is due is missing; lost frames, capture times, or pose_delay_ms too short?";
    case CAN_STEP_NOT_SHOWN:
        return "now its panel does not show the corrected picture in time; its state, its method?";
    }
    return "its bus time, and its panel's refresh rate?";
}

static void check_count(bus_judge_t *judge, int node, uint32_t more, const char *what)
{
    if (more > 0)
        bus_judge_say(judge, false, "board %d: %" PRIu32 " %s", node, more, what);
}

void bus_check_counts(bus_judge_t *judge, int node, const bus_watch_board_t *board)
{
    const can_counts_t *now = &board->counts, *first = &board->first_counts;
    if (!board->has_counts)
        return;
    check_count(judge, node, (now->tags_lost - first->tags_lost) % COUNTS_LONG,
                "pictures whose code could not be read; does the engine paint it, is the picture scaled?");
    check_count(judge, node, (now->guessed - first->guessed) % COUNTS_LONG,
                "pictures shown for a guessed pose; see frames.pose of the room file");
    check_count(judge, node, (now->leaders - first->leaders) % COUNTS_SHORT,
                "changes of the board that leads; lost frames, or a board that starts anew?");
    check_count(judge, node, (now->epochs_missed - first->epochs_missed) % COUNTS_SHORT,
                "changes of the frame clock missed; lost frames?");
    check_count(judge, node, (now->command_faults - first->command_faults) % COUNTS_LONG,
                "commands or replies that did not get through");
}

void bus_check_latency(bus_judge_t *judge, const bus_watch_t *watch)
{
    int least = 0, most = 0;
    uint32_t wanted_ms = 0;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (!board->has_latency || board->latency.photon_us == 0)
            continue;
        if (least == 0 || board->latency.photon_us < watch->board[least].latency.photon_us)
            least = node;
        if (most == 0 || board->latency.photon_us > watch->board[most].latency.photon_us)
            most = node;
        if (board->latency.wanted_ms > wanted_ms)
            wanted_ms = board->latency.wanted_ms;
    }
    if (least == 0)
        return;
    const uint32_t least_us = watch->board[least].latency.photon_us, most_us = watch->board[most].latency.photon_us;
    const bool apart = most_us - least_us > APART_US;
    bus_judge_say(judge, true, "latency: pose to photon %.1f ms (board %d) to %.1f ms (board %d)%s", least_us / 1e3,
                  least, most_us / 1e3, most,
                  apart && wanted_ms == 0 ? "; `wallwarp-pose command --node all latency 1` makes all as late" : "");
}
