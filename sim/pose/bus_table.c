// SPDX-License-Identifier: Apache-2.0
// What a watched bus looks like, as a table for people.
#include "sim/pose/bus_table.h"

#include <inttypes.h>

#include "sim/pose/bus_check_latency.h"
#include "warp_fixed/method.h"

static const double us_per_s = 1e6, nm_per_mm = 1e6;

static void print_bus(FILE *file, const char *bus, const bus_watch_t *watch)
{
    const double seconds = watch->frames > 0 ? (double)(watch->last_us - watch->first_us) / us_per_s : 0;
    fprintf(file, "%s: %.1f s, %" PRId64 " frames, %" PRId64 " damaged, %" PRId64 " unknown, %" PRId64 " errors, load ",
            bus, seconds, watch->frames, watch->damaged, watch->unknown, watch->errors);
    if (watch->load_ppm < 0)
        fprintf(file, "- %%\n");
    else
        fprintf(file, "%.1f %% (worst %.1f %%)\n", watch->load_ppm / 1e4, watch->worst_load_ppm / 1e4);
}

static const char *quality_name(can_pose_quality_t quality)
{
    return quality == CAN_POSE_PREDICTED ? "predicted" : "tracked";
}

static void print_delay(FILE *file, const bus_watch_viewer_t *viewer)
{
    if (viewer->delays > 0)
        fprintf(file, " %8.2f %8.2f", (double)viewer->delay_sum_us / (double)viewer->delays / 1e3,
                (double)viewer->delay_most_us / 1e3);
    else
        fprintf(file, " %8s %8s", "-", "-");
}

static void print_viewer(FILE *file, int number, const bus_watch_viewer_t *viewer)
{
    const can_faults_t *faults = &viewer->faults;
    const double mean_us = bus_watch_mean_us(&viewer->poses);
    fprintf(file, "%6d  %-8s %6.1f %9.3f", number,
            viewer->fd && viewer->set ? "fd+set"
            : viewer->fd              ? "fd"
                                      : "set",
            mean_us > 0 ? us_per_s / mean_us : 0, bus_watch_jitter_us(&viewer->poses) / 1e3);
    print_delay(file, viewer);
    fprintf(file, " %6" PRIu32 " %6" PRIu32 " %6" PRIu32 " %6" PRIu32 " %9" PRIu32 "  ", faults->counter_lost,
            faults->crc + faults->length, faults->duplicate + faults->stale,
            faults->bad_pose + faults->counter_invalid + faults->incomplete_set, faults->tracking_lost);
    const can_pose_t *pose = &viewer->receiver.newest;
    if (viewer->receiver.any)
        fprintf(file, "%-9s %10.1f %10.1f %10.1f\n", quality_name(pose->quality),
                (double)pose->pose.eye_nm[0] / nm_per_mm, (double)pose->pose.eye_nm[1] / nm_per_mm,
                (double)pose->pose.eye_nm[2] / nm_per_mm);
    else
        fprintf(file, "none yet\n");
}

static const char *method_name(const can_quality_t *quality)
{
    for (int m = 0; m < WARP_METHODS; m++)
        if (warp_methods[m].filter == quality->filter && warp_methods[m].resampler == quality->resampler)
            return warp_methods[m].name;
    return "unknown";
}

static void print_board(FILE *file, int node, const bus_watch_board_t *board)
{
    const can_heartbeat_t *heartbeat = &board->heartbeat;
    fprintf(file, "%6d  ", node);
    if (board->heartbeats.count > 0)
        fprintf(file, "%-8s %8" PRIu32 " %6" PRIu32 "  0x%03" PRIX32 " ", can_board_state_name(heartbeat->state),
                heartbeat->uptime_s, heartbeat->frame_number, heartbeat->fault_flags);
    else
        fprintf(file, "%-8s %8s %6s  %5s ", "-", "-", "-", "-");
    if (board->has_status)
        fprintf(file, "%5u %7" PRIu32 " %8.3f %8.1f %10" PRIu32 "  ", (unsigned)board->status.pose_counter,
                board->status.pose_age_ms, board->status.step_q8 / 256.0, board->status.warp_time_us / 1e3,
                board->status.can_faults);
    else
        fprintf(file, "%5s %7s %8s %8s %10s  ", "-", "-", "-", "-", "-");
    if (board->has_quality)
        fprintf(file, "%s, step %u\n", method_name(&board->quality), (unsigned)board->quality.step);
    else
        fprintf(file, "-\n");
}

static void print_time(FILE *file, const bus_watch_time_t *time)
{
    if (time->pairs.count == 0 && time->alone == 0)
        return;
    const double mean_us = bus_watch_mean_us(&time->pairs);
    fprintf(file, "bus time: from ");
    if (time->pairs.count == 0)
        fprintf(file, "nobody");
    else
        fprintf(file, "%u, begun by %u", (unsigned)time->master, (unsigned)time->origin);
    fprintf(file, "; %.1f pairs a second, %" PRId64 " Syncs alone, %" PRId64 " changes of who gives it\n",
            mean_us > 0 ? us_per_s / mean_us : 0, time->alone, time->changes);
}

static void print_frames(FILE *file, const bus_watch_t *watch)
{
    int boards = 0, in_step = 0;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        boards += watch->board[node].steps > 0;
        in_step += watch->board[node].steps > 0 && watch->board[node].step.in_step;
    }
    if (boards == 0)
        return;
    fprintf(file, "frames: ");
    if (watch->has_frame_clock)
        fprintf(file, "board %u leads, epoch %u; ", (unsigned)watch->frame_clock.node,
                (unsigned)watch->frame_clock.epoch);
    fprintf(file, "%d of %d boards in step; %" PRId64 " refreshes compared, %" PRId64 " differed\n", in_step, boards,
            watch->steps.compared, watch->steps.differing);
}

static void print_board_time(FILE *file, int node, const bus_watch_board_t *board)
{
    static const char *const state[] = {"none", "own", "locked", "holdover"};
    const can_time_t *time = &board->time;
    fprintf(file, "%6d  ", node);
    if (board->has_time)
        fprintf(file, "%-8s %5u %8" PRIu32 " %9.2f %5" PRIu32 " %8" PRIu32 "  ", state[time->state],
                (unsigned)time->master, time->error_us, time->drift_ppb / 1e3, time->lost, time->relocks);
    else
        fprintf(file, "%-8s %5s %8s %9s %5s %8s  ", "-", "-", "-", "-", "-", "-");
    if (board->steps > 0)
        fprintf(file, "%5.1f %% %8" PRIu32 " %8" PRIu32 "\n", 100.0 * (double)board->in_step / (double)board->steps,
                board->step.refresh, board->step.picture);
    else
        fprintf(file, "%7s %8s %8s\n", "-", "-", "-");
}

static void print_agreement(FILE *file, const bus_watch_t *watch)
{
    bool titled = false;
    print_time(file, &watch->time);
    print_frames(file, watch);
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (!board->has_time && board->steps == 0)
            continue;
        if (!titled)
            fprintf(file, " board  time      from error_us drift_ppm  lost  relocks  in_step  refresh  picture\n");
        titled = true;
        print_board_time(file, node, board);
    }
}

static void print_board_latency(FILE *file, int node, const bus_watch_board_t *board)
{
    const can_latency_t *latency = &board->latency;
    const can_counts_t *counts = &board->counts;
    fprintf(file, "%6d  ", node);
    if (board->has_latency)
        fprintf(file, "%-11s %7.2f %5u %7.1f %8.1f %7" PRIu32 " %7" PRId32 " %-5s", bus_check_step_name(latency->fault),
                latency->photon_us / 1e3, (unsigned)latency->held, latency->lag_us / 1e3, latency->display_us / 1e3,
                latency->wanted_ms, latency->off_us, latency->genlocked ? "yes" : "no");
    else
        fprintf(file, "%-11s %7s %5s %7s %8s %7s %7s %-5s", "-", "-", "-", "-", "-", "-", "-", "-");
    if (board->has_counts)
        fprintf(file, " %9" PRIu32 " %7" PRIu32 " %7" PRIu32 " %6" PRIu32 " %8" PRIu32 "\n", counts->tags_lost,
                counts->guessed, counts->leaders, counts->epochs_missed, counts->command_faults);
    else
        fprintf(file, " %9s %7s %7s %6s %8s\n", "-", "-", "-", "-", "-");
}

static void print_latency(FILE *file, const bus_watch_t *watch)
{
    bool titled = false;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (!board->has_latency && !board->has_counts)
            continue;
        if (!titled)
            fprintf(file, " board  why         late_ms  held  lag_ms  display  wanted  off_us house tags_lost guessed"
                          " leaders missed commands\n");
        titled = true;
        print_board_latency(file, node, board);
    }
}

static void print_board_update(FILE *file, int node, const can_update_t *update)
{
    static const char *const slot[] = {"-", "A", "B"}, *const plan[] = {"no", "promised", "confirmed"};
    fprintf(file, "%6d  %-10s %7u%%  %-4s  %04X  %-5s", node, can_update_state_name(update->state),
            (unsigned)update->progress, slot[update->slot], (unsigned)update->running,
            update->trial ? "trial" : "good");
    if (update->waiting != 0)
        fprintf(file, "     %04X", (unsigned)update->waiting);
    else
        fprintf(file, "  %7s", "-");
    fprintf(file, "  %s\n", plan[update->plan]);
}

/* Of boards that have an agent. */
static void print_updates(FILE *file, const bus_watch_t *watch)
{
    bool titled = false;
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (!board->has_update || board->update.state == CAN_UPDATE_NO_AGENT)
            continue;
        if (!titled)
            fprintf(file, " board  update     progress  slot  runs  it is  waiting  switch\n");
        titled = true;
        print_board_update(file, node, &board->update);
    }
}

void bus_table_print(FILE *file, const char *bus, const bus_watch_t *watch)
{
    print_bus(file, bus, watch);
    fprintf(
        file,
        "viewer  message  rate/s jitter_ms delay_ms worst_ms   lost    crc repeat    bad not_seen  quality         x_mm"
        "       y_mm       z_mm\n");
    for (int v = 0; v < CAN_VIEWERS; v++)
        if (watch->viewer[v].fd || watch->viewer[v].set)
            print_viewer(file, v, &watch->viewer[v]);
    fprintf(file, " board  state    uptime_s  frame faults  pose  age_ms        k  warp_ms bus_faults  method\n");
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const bus_watch_board_t *board = &watch->board[node];
        if (bus_watch_heard(board))
            print_board(file, node, board);
    }
    print_agreement(file, watch);
    print_latency(file, watch);
    print_updates(file, watch);
}
