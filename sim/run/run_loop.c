// SPDX-License-Identifier: Apache-2.0
// The frames of a run, one after the other: in virtual or in real time.
#include "sim/run/run_loop.h"

#include <inttypes.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"

enum { US_PER_S = 1000000, TERMINAL_PERIOD_US = 100000, POLL_NS = 500000 };

/* In place, ten times a second, on a terminal; else a line a second. */
static void tell_progress(run_loop_t *loop)
{
    const bool terminal = isatty(STDERR_FILENO) == 1;
    const int64_t now_us = sim_clock_monotonic_us();
    const bool last = loop->record->frames == loop->frames;
    if (now_us - loop->told_us < (terminal ? TERMINAL_PERIOD_US : US_PER_S) && !(last && terminal))
        return;
    loop->told_us = now_us;
    fprintf(stderr, "%sframe %" PRId32, terminal ? "\r" : "", loop->record->frames);
    if (loop->frames != INT64_MAX)
        fprintf(stderr, " of %" PRId64, loop->frames);
    fputs(terminal && !last ? "" : "\n", stderr);
}

static void record_bus(run_loop_t *loop, run_frame_t *frame)
{
    const sim_bus_stats_t bus = sim_bus_stats(sim_world_bus(loop->world));
    const int64_t elapsed_ns = bus.elapsed_ns - loop->elapsed_ns;
    if (elapsed_ns > 0)
        frame->bus_load_ppm = (int32_t)((double)(bus.busy_ns - loop->busy_ns) * 1e6 / (double)elapsed_ns);
    loop->busy_ns = bus.busy_ns;
    loop->elapsed_ns = bus.elapsed_ns;
}

/* Take what clients have sent, let it pass over the bus until now, and give them what was heard. */
static void serve_bus(run_loop_t *loop, int64_t now_us)
{
    socketcand_server_poll(loop->server);
    sim_bus_advance(sim_world_bus(loop->world), now_us);
    socketcand_server_poll(loop->server);
}

/*
 * In real time the boards of this process take turns, some 10 ms each; the bus is served before every turn, so that
 * each board hears and stamps its frames as one with a processor of its own would.
 */
static bool step_boards(run_loop_t *loop, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    if (loop->server == NULL)
        return sim_world_step(loop->world, now_us, error);
    const bool ok = sim_world_advance(loop->world, now_us, error);
    for (int32_t i = 0; i < loop->record->boards; i++) {
        serve_bus(loop, sim_clock_monotonic_us());
        sim_world_step_board(loop->world, i);
    }
    return ok;
}

/* One step of every board, and what it did. */
static bool make_step(run_loop_t *loop, int64_t now_us)
{
    char error[FILE_ERROR_LENGTH];
    run_record_t *record = loop->record;
    if (!run_record_add_frame(record)) {
        fprintf(stderr, "wallwarp-sim: out of memory after %" PRId32 " frames\n", record->frames);
        return false;
    }
    house_signal_advance(&loop->house, loop->world, loop->room, now_us);
    if (!step_boards(loop, now_us, error) && !loop->camera_told) {
        fprintf(stderr, "warning: camera: %s\n", error);
        loop->camera_told = true;
    }
    run_frame_t *frame = &record->frame[record->frames - 1];
    frame->time_us = now_us - loop->start_us;
    record_bus(loop, frame);
    house_signal_note(frame, loop->world, loop->room);
    for (int32_t i = 0; i < record->boards; i++) {
        run_wall_t *wall = &record->wall[(record->frames - 1) * record->boards + i];
        const projector_t *projector = sim_world_projector(loop->world, i);
        wall->report = projector->report;
        warp_report_step(&projector->warp, &wall->report.warp);
        wall->step_time_us = sim_world_step_time_us(loop->world, i);
        if (wall->report.corrected && !frame->seen) {
            frame->seen = true;
            frame->eye = wall->report.pose;
        }
    }
    run_files_add(loop->files, record, loop->room);
    tell_progress(loop);
    return true;
}

/* Hand the pictures of the newest frame over, as the walls show them from that vertical blank on. */
static bool hand_over(run_loop_t *loop, int64_t blank_us)
{
    const int32_t n = loop->record->frames - 1;
    const run_frame_t *frame = &loop->record->frame[n];
    run_job_t *job = run_pictures_borrow(loop->pictures);
    if (job == NULL)
        return false;
    job->frame = n;
    job->seen = frame->seen;
    job->eye = frame->eye;
    job->judge = loop->judge_every > 0 && n % loop->judge_every == loop->judge_every / 2;
    const picture_t *picture = NULL;
    const int32_t held = sim_world_projector(loop->world, 0)->choice.step.held; /* by whom picture and eye are */
    for (int32_t i = 0; i < loop->record->boards; i++) {
        const projector_t *projector = sim_world_projector(loop->world, i);
        const image_t *shown = sim_world_shown(loop->world, i, blank_us);
        job->corrected[i] = projector->report.corrected && shown != NULL && projector->choice.step.held == held;
        const picture_t panel = shown == NULL ? (picture_t){0} : picture_from_image(shown);
        run_pictures_copy(&job->shown[i], shown == NULL ? NULL : &panel);
        if (picture == NULL && projector->choice.now.any)
            picture = &projector->choice.now.frame.picture;
    }
    run_pictures_copy(&job->picture, picture);
    run_pictures_submit(loop->pictures, job);
    return true;
}

bool run_loop_virtual(run_loop_t *loop)
{
    int64_t n = 0;
    for (; n < loop->frames && !*loop->stop; n++) {
        const int64_t now_us = sim_rate_time_us(&loop->refresh, n);
        pose_sender_advance(loop->sender, now_us);
        if (!make_step(loop, now_us) || !hand_over(loop, sim_rate_time_us(&loop->refresh, n + 1)))
            return false;
    }
    sim_bus_advance(sim_world_bus(loop->world), sim_rate_time_us(&loop->refresh, n)); /* what the last step sent */
    return true;
}

/* Keep the bus and its clients going until a vertical blank, and until there is room for the pictures of a frame. */
static int64_t wait_for_blank(run_loop_t *loop, int64_t blank)
{
    for (;;) {
        const int64_t now_us = sim_clock_monotonic_us();
        serve_bus(loop, now_us);
        const int64_t reached = sim_rate_beat_at(&loop->refresh, now_us);
        if (reached >= blank && run_pictures_ready(loop->pictures))
            return reached;
        const struct timespec nap = {.tv_nsec = POLL_NS};
        nanosleep(&nap, NULL);
    }
}

bool run_loop_real(run_loop_t *loop)
{
    int64_t blank = wait_for_blank(loop, 0);
    for (int64_t n = 0; n < loop->frames && !*loop->stop; n++) {
        if (!make_step(loop, sim_clock_monotonic_us()))
            return false;
        /* every board has presented by now: the next blank brings all their pictures */
        const int64_t next = sim_rate_beat_at(&loop->refresh, sim_clock_monotonic_us()) + 1;
        const int64_t reached = wait_for_blank(loop, next);
        loop->skipped += reached - blank - 1;
        blank = reached;
        if (!hand_over(loop, sim_clock_monotonic_us()))
            return false;
    }
    return true;
}
