// SPDX-License-Identifier: Apache-2.0
// Is this bus healthy? One line of judgement for each thing that was watched.
#include "sim/pose/bus_check.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

#include "firmware/projector.h"
#include "sim/pose/bus_check_latency.h"
#include "sim/pose/bus_check_update.h"
#include "sim/pose/bus_judge.h"
#include "sim/pose/event_text.h"

enum {
    US_PER_S = 1000000,
    LEAST_POSES_PER_S = 20,
    MOST_LOAD_PPM = 700000,
    MOST_TIME_ERROR_US = 1000,
    DELAY_STEP_US = 500,
    MOST_DELAY_US = 50000, /* that a room file may have */
    HEARTBEAT_GAP_US = 3 * CAN_HEARTBEAT_PERIOD_MS * 1000 / 2
};

/* A count that should be 0: said only when it is not. */
static void say_count(bus_judge_t *judge, int viewer, uint32_t count, const char *what)
{
    if (count > 0)
        bus_judge_say(judge, false, "viewer %d: %" PRIu32 " %s", viewer, count, what);
}

static void check_faults(bus_judge_t *judge, int number, const can_faults_t *faults)
{
    say_count(judge, number, faults->counter_lost, "poses lost on the way: is the bus overloaded or its wiring bad?");
    say_count(judge, number, faults->crc, "frames with a wrong CRC: see wallwarp.dbc for polynomial and data ids");
    say_count(judge, number, faults->length, "frames of a wrong length or kind: FD has 32 bytes, classic ones 8");
    say_count(judge, number, faults->counter_invalid, "frames with counter 15: a set's counter is 0 to 14");
    say_count(judge, number, faults->duplicate, "repeated poses: is a second sender on the bus?");
    say_count(judge, number, faults->stale, "poses older than the newest: is a second sender on the bus?");
    say_count(judge, number, faults->sender_restart,
              "jumps of the counter: has the sender started anew, or are there two?");
    say_count(judge, number, faults->incomplete_set, "incomplete sets: three frames within 10 ms, all of one counter");
    say_count(judge, number, faults->bad_pose,
              "poses that cannot be: position within 1000 m and a quaternion of length 1 expected");
    say_count(judge, number, faults->tracking_lost, "times the tracker did not see the viewer");
}

/* Is every pose at the boards when they choose it? Its value is rounded up to half a millisecond. */
static void check_delay(bus_judge_t *judge, int number, const bus_watch_viewer_t *viewer, int64_t pose_delay_us)
{
    const int64_t needed_us = viewer->delay_most_us + (int64_t)(bus_watch_mean_us(&viewer->poses) / 4);
    const int64_t value_us = (needed_us + DELAY_STEP_US - 1) / DELAY_STEP_US * DELAY_STEP_US;
    if (pose_delay_us == BUS_CHECK_NO_DELAY)
        return;
    if (viewer->delays == 0)
        bus_judge_say(
            judge, false,
            "viewer %d: how late its poses come is not known: it takes a tracker's bus time, and 4 to 20 s of "
            "it; see --seconds",
            number);
    else if (needed_us > MOST_DELAY_US)
        bus_judge_say(judge, false,
                      "viewer %d: poses come up to %.1f ms after their capture, which no pose_delay_ms allows for",
                      number, (double)viewer->delay_most_us / 1e3);
    else if (needed_us > pose_delay_us)
        bus_judge_say(
            judge, false,
            "viewer %d: poses come up to %.1f ms after their capture; set the room's pose_delay_ms to %.1f, not %.1f",
            number, (double)viewer->delay_most_us / 1e3, (double)value_us / 1e3, (double)pose_delay_us / 1e3);
}

static void say_good_viewer(bus_judge_t *judge, int number, const bus_watch_viewer_t *viewer)
{
    const double rate = US_PER_S / bus_watch_mean_us(&viewer->poses);
    const double jitter_ms = bus_watch_jitter_us(&viewer->poses) / 1e3;
    if (viewer->delays == 0)
        bus_judge_say(judge, true, "viewer %d: %.1f poses a second, jitter %.3f ms, delay within %.3f ms", number, rate,
                      jitter_ms, (double)(viewer->most_us - viewer->least_us) / 1e3);
    else
        bus_judge_say(judge, true, "viewer %d: %.1f poses a second, jitter %.3f ms, delay %.1f ms, at most %.1f",
                      number, rate, jitter_ms, (double)viewer->delay_sum_us / (double)viewer->delays / 1e3,
                      (double)viewer->delay_most_us / 1e3);
}

static void check_viewer(bus_judge_t *judge, int number, const bus_watch_viewer_t *viewer, int64_t pose_delay_us)
{
    const int before = judge->bad;
    const double mean_us = bus_watch_mean_us(&viewer->poses), rate = mean_us > 0 ? US_PER_S / mean_us : 0;
    if (viewer->fd && viewer->set)
        bus_judge_say(judge, false, "viewer %d: comes as FD frames and as classic sets; send one of them", number);
    if (rate < LEAST_POSES_PER_S)
        bus_judge_say(judge, false, "viewer %d: %.1f poses a second; send at least %d", number, rate,
                      LEAST_POSES_PER_S);
    if (viewer->poses.longest_us > PROJECTOR_HOLD_AFTER_US)
        bus_judge_say(judge, false, "viewer %d: a gap of %" PRId64 " ms; boards hold the last pose after %d ms", number,
                      viewer->poses.longest_us / 1000, PROJECTOR_HOLD_AFTER_US / 1000);
    if (viewer->captured_back > 0)
        bus_judge_say(judge, false, "viewer %d: capture times went back %" PRId64 " times; they count up, in us",
                      number, viewer->captured_back);
    check_faults(judge, number, &viewer->faults);
    check_delay(judge, number, viewer, pose_delay_us);
    if (judge->bad == before)
        say_good_viewer(judge, number, viewer);
}

static bool any_captured(const bus_watch_t *watch)
{
    bool any = false;
    for (int v = 0; v < CAN_VIEWERS; v++)
        any |= watch->viewer[v].captured;
    return any;
}

static void check_time(bus_judge_t *judge, const bus_watch_t *watch)
{
    const bus_watch_time_t *time = &watch->time;
    const int before = judge->bad;
    if (time->pairs.count == 0) {
        if (any_captured(watch))
            bus_judge_say(
                judge, false,
                "bus time: nobody gives it, so capture times are of no use; send Sync and FollowUp, see BUS.md");
        return;
    }
    if (any_captured(watch) && time->origin != BUS_MASTER_TRACKER)
        bus_judge_say(
            judge, false,
            "bus time: board %u's own clock, so capture times are of no use; the tracker should give it, see BUS.md",
            (unsigned)time->origin);
    const int64_t silent_us = watch->last_us - time->pairs.last_us;
    const int64_t gap_us = silent_us > time->pairs.longest_us ? silent_us : time->pairs.longest_us;
    if (gap_us > BUS_MASTER_SILENT_US)
        bus_judge_say(judge, false, "bus time: no Sync and FollowUp for %" PRId64 " ms, expected every %d",
                      gap_us / 1000, CAN_SYNC_PERIOD_MS);
    if (time->changes > 0)
        bus_judge_say(judge, false,
                      "bus time: who gives it changed %" PRId64 " times; are there two trackers, or lost frames?",
                      time->changes);
    if (judge->bad == before)
        bus_judge_say(judge, true, "bus time: given by number %u, %" PRId64 " pairs", (unsigned)time->master,
                      time->pairs.count);
}

static void check_board_time(bus_judge_t *judge, int node, const bus_watch_board_t *board)
{
    const can_time_t *time = &board->time;
    if (!board->has_time)
        return;
    if (time->state == CAN_TIME_NONE)
        bus_judge_say(judge, false, "board %d: has no bus time; it takes 4 to 20 s of Sync and FollowUp", node);
    if (time->state == CAN_TIME_HOLDOVER)
        bus_judge_say(judge, false,
                      "board %d: does not hear number %u, whose bus time it had; bus-off, or a loose wire?", node,
                      (unsigned)time->master);
    if (time->state != CAN_TIME_NONE && time->error_us > MOST_TIME_ERROR_US)
        bus_judge_say(judge, false, "board %d: its bus time may be off by %" PRIu32 " us, expected at most %d", node,
                      time->error_us, MOST_TIME_ERROR_US);
}

static void check_board_steps(bus_judge_t *judge, int node, const bus_watch_board_t *board, bool expected)
{
    if (expected && board->steps == 0)
        bus_judge_say(judge, false, "board %d: sends no Step, as others do; is its firmware of this version?", node);
    if (board->in_step < board->steps)
        bus_judge_say(judge, false, "board %d: in step in %.1f %% of its Steps, expected 100; %s", node,
                      100.0 * (double)board->in_step / (double)board->steps, bus_check_step_advice(board));
}

static void check_state(bus_judge_t *judge, int node, can_board_state_t state)
{
    if (state == CAN_BOARD_FROZEN)
        bus_judge_say(
            judge, false,
            "board %d: an operator has frozen its picture; `wallwarp-pose command --node %d freeze off` ends that",
            node, node);
    else if (state == CAN_BOARD_PATTERN)
        bus_judge_say(
            judge, false,
            "board %d: an operator has put a test pattern on; `wallwarp-pose command --node %d pattern none` ends that",
            node, node);
    else if (state != CAN_BOARD_RUNNING)
        bus_judge_say(judge, false, "board %d: is %s, expected running", node, can_board_state_name(state));
}

/* By an operator: it does not show what the others do. */
static bool is_held(can_board_state_t state)
{
    return state == CAN_BOARD_FROZEN || state == CAN_BOARD_PATTERN;
}

/* @param steps  Do boards send Step at all? */
static void check_board(bus_judge_t *judge, int node, const bus_watch_board_t *board, int64_t end_us, bool steps)
{
    const int before = judge->bad;
    if (board->heartbeats.count == 0) {
        bus_judge_say(judge, false, "board %d: reports but no heartbeat; is its firmware of this version?", node);
        return;
    }
    const int64_t silent_us = end_us - board->heartbeats.last_us;
    const int64_t gap_us = silent_us > board->heartbeats.longest_us ? silent_us : board->heartbeats.longest_us;
    if (gap_us > HEARTBEAT_GAP_US)
        bus_judge_say(judge, false,
                      "board %d: no heartbeat for %" PRId64 " ms, expected one every %d; power, cable, bus-off?", node,
                      gap_us / 1000, CAN_HEARTBEAT_PERIOD_MS);
    if (board->restarts > 0)
        bus_judge_say(judge, false, "board %d: started anew %" PRId64 " times; see its log", node, board->restarts);
    check_state(judge, node, board->heartbeat.state);
    if (board->heartbeat.fault_flags != 0) {
        char names[FAULT_NAMES_LENGTH];
        event_fault_names(names, board->heartbeat.fault_flags);
        bus_judge_say(judge, false, "board %d: reports a fault: %s%s", node, names,
                      (board->heartbeat.fault_flags & (CAN_FAULT_REFUSED | CAN_FAULT_SESSION)) != 0
                          ? "; it has a key: has who sends the same one, --key FILE?"
                          : "");
    }
    check_board_time(judge, node, board);
    if (!is_held(board->heartbeat.state))
        check_board_steps(judge, node, board, steps);
    bus_check_counts(judge, node, board);
    if (judge->bad == before)
        bus_judge_say(judge, true, "board %d: running, up for %" PRIu32 " s", node, board->heartbeat.uptime_s);
}

static void check_bus(bus_judge_t *judge, const bus_watch_t *watch)
{
    const bool light = watch->worst_load_ppm <= MOST_LOAD_PPM;
    bus_judge_say(judge, light, "load: %.1f %% in the fullest second%s", watch->worst_load_ppm / 1e4,
                  light ? "" : "; above 70 % poses come late: lower the rate, or raise the bit rate");
    if (watch->errors > 0)
        bus_judge_say(judge, false, "%" PRId64 " bus errors; termination, bit rate, cable?", watch->errors);
    if (watch->damaged > 0)
        bus_judge_say(judge, false, "%" PRId64 " damaged reports of boards; do two have one node number?",
                      watch->damaged);
    if (watch->unknown > 0)
        bus_judge_say(judge, true, "%" PRId64 " frames that are none of wallwarp.dbc's", watch->unknown);
}

/* @return How many boards were heard. */
static int check_boards(bus_judge_t *judge, const bus_watch_t *watch)
{
    int boards = 0, stepping = 0;
    for (int node = 1; node <= CAN_MAX_NODE; node++)
        stepping += watch->board[node].steps > 0;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        if (!bus_watch_heard(&watch->board[node]))
            continue;
        check_board(judge, node, &watch->board[node], watch->last_us, stepping > 0);
        boards++;
    }
    if (watch->steps.differing > 0)
        bus_judge_say(judge, false,
                      "frames: boards in step differed at %" PRId64 " of %" PRId64
                      " refreshes; have they one room file, and one firmware?",
                      watch->steps.differing, watch->steps.compared);
    else if (stepping > 1)
        bus_judge_say(
            judge, watch->steps.compared > 0, "frames: %" PRId64 " refreshes compared%s", watch->steps.compared,
            watch->steps.compared > 0 ? ", all boards in step showed the same" : "; no two boards were in step");
    bus_check_latency(judge, watch);
    bus_check_updates(judge, watch);
    return boards;
}

int bus_check_print(FILE *file, const bus_watch_t *watch, int64_t pose_delay_us)
{
    bus_judge_t judge = {.file = file};
    if (watch->frames == 0) {
        bus_judge_say(&judge, false, "no frame: is anything sending, and is the bit rate right?");
        return judge.bad;
    }
    check_bus(&judge, watch);
    check_time(&judge, watch);
    int viewers = 0;
    for (int v = 0; v < CAN_VIEWERS; v++) {
        if (!watch->viewer[v].fd && !watch->viewer[v].set)
            continue;
        check_viewer(&judge, v, &watch->viewer[v], pose_delay_us);
        viewers++;
    }
    if (viewers == 0)
        bus_judge_say(&judge, false, "no poses: see `wallwarp-pose send --help`");
    if (check_boards(&judge, watch) == 0)
        bus_judge_say(&judge, false, "no board reports; are they powered, and are there two nodes or more on the bus?");
    return judge.bad;
}
