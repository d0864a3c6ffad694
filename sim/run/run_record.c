// SPDX-License-Identifier: Apache-2.0
// Everything that was measured during a run, frame by frame.
#include "sim/run/run_record.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NM_PER_MM = 1000000 };

/* Room for one more element. The block is moved only when it is full. */
static bool reserve(void **block, int32_t *capacity, int32_t used, size_t element)
{
    if (used < *capacity)
        return true;
    const int32_t wanted = *capacity < 64 ? 128 : *capacity * 2;
    void *moved = wanted < *capacity ? NULL : realloc(*block, (size_t)wanted * element);
    if (moved == NULL)
        return false;
    *block = moved;
    *capacity = wanted;
    return true;
}

bool run_record_add_frame(run_record_t *record)
{
    int32_t wall_capacity = record->frame_capacity;
    void *walls = record->wall;
    const bool walls_fit =
        reserve(&walls, &wall_capacity, record->frames, (size_t)record->boards * sizeof *record->wall);
    record->wall = walls;
    void *frames = record->frame;
    if (!walls_fit || !reserve(&frames, &record->frame_capacity, record->frames, sizeof *record->frame))
        return false;
    record->frame = frames;
    record->frame[record->frames] = (run_frame_t){.seen = false};
    for (int32_t i = 0; i < record->boards; i++)
        record->wall[record->frames * record->boards + i] = (run_wall_t){.step_time_us = 0};
    record->frames++;
    return true;
}

bool run_record_add_psnr(run_record_t *record, const run_psnr_t *psnr)
{
    void *block = record->psnr;
    if (!reserve(&block, &record->psnr_capacity, record->psnrs, sizeof *record->psnr))
        return false;
    record->psnr = block;
    record->psnr[record->psnrs++] = *psnr;
    return true;
}

static int compare(const void *a, const void *b)
{
    const run_psnr_t *p = a, *q = b;
    if (p->frame != q->frame)
        return p->frame < q->frame ? -1 : 1;
    return (p->board > q->board) - (p->board < q->board);
}

void run_record_sort(run_record_t *record)
{
    if (record->psnrs > 0)
        qsort(record->psnr, (size_t)record->psnrs, sizeof *record->psnr, compare);
}

void run_record_free(run_record_t *record)
{
    free(record->frame);
    free(record->wall);
    free(record->psnr);
    *record = (run_record_t){.boards = 0};
}

/* Mean of the finite values of one kind. */
static double mean_db(const run_record_t *record, int32_t board, int kind)
{
    double sum = 0;
    int32_t count = 0;
    for (int32_t i = 0; i < record->psnrs; i++) {
        if (record->psnr[i].board == board && isfinite(record->psnr[i].db[kind])) {
            sum += record->psnr[i].db[kind];
            count++;
        }
    }
    return count > 0 ? sum / count : (double)NAN;
}

static void sum_drawn(run_board_sum_t *sum, const run_record_t *record, int32_t board, const wall_t *wall)
{
    const double panel_pixels = (double)wall->panel_width * wall->panel_height;
    double lit = 0;
    int32_t drawn = 0;
    for (int32_t n = 0; n < record->frames; n++) {
        const projector_report_t *report = &record->wall[n * record->boards + board].report;
        if (!report->corrected)
            continue;
        drawn++;
        lit += report->warp.lit_pixels / panel_pixels;
        const double k = report->warp.k_in_q16 / 65536.0;
        if (report->warp.k_in_q16 == 0)
            continue; /* no pixel of this wall is in the picture */
        sum->k_least = !sum->drawn || k < sum->k_least ? k : sum->k_least;
        sum->k_most = k > sum->k_most ? k : sum->k_most;
        sum->drawn = true;
    }
    sum->lit_share = drawn > 0 ? lit / drawn : 0;
}

/* Of the frames in step. */
static double mean_latency_ms(const run_record_t *record, int32_t board)
{
    double sum_ms = 0;
    int32_t count = 0;
    for (int32_t n = 0; n < record->frames; n++) {
        const projector_report_t *report = &record->wall[n * record->boards + board].report;
        if (!report->agreement.in_step)
            continue;
        sum_ms += report->pose_to_photon_us / 1e3;
        count++;
    }
    return count > 0 ? sum_ms / count : (double)NAN;
}

run_board_sum_t run_record_board(const run_record_t *record, int32_t board, const wall_t *wall)
{
    run_board_sum_t sum = {.latency_ms = mean_latency_ms(record, board)};
    sum_drawn(&sum, record, board, wall);
    for (int32_t n = 0; n < record->frames; n++) {
        const double ms = (double)record->wall[n * record->boards + board].step_time_us / 1000;
        sum.step_ms_mean += ms / record->frames;
        sum.step_ms_most = ms > sum.step_ms_most ? ms : sum.step_ms_most;
    }
    for (int32_t i = 0; i < record->psnrs; i++)
        sum.judged += record->psnr[i].board == board;
    for (int kind = 0; kind < RUN_DBS; kind++)
        sum.db[kind] = mean_db(record, board, kind);
    return sum;
}

/* Has a wall in step shown this content as another one? Pictures that are held back come up to so many frames later. */
static bool differs(const run_record_t *record, int32_t frame, const can_step_t *step)
{
    const int32_t begin = frame > FRAME_CLOCK_MOST_HELD ? frame - FRAME_CLOCK_MOST_HELD : 0;
    for (int32_t n = begin * record->boards; n < (frame + 1) * record->boards; n++) {
        const can_step_t *other = &record->wall[n].report.agreement;
        if (other->in_step && other->refresh == step->refresh &&
            (other->picture != step->picture || other->pose_us != step->pose_us))
            return true;
    }
    return false;
}

run_agreement_t run_record_agreement(const run_record_t *record)
{
    run_agreement_t sum = {.refreshes = (int64_t)record->frames * record->boards};
    for (int32_t n = 0; n < record->frames; n++) {
        bool differ = false;
        for (int32_t i = 0; i < record->boards; i++) {
            const projector_report_t *report = &record->wall[n * record->boards + i].report;
            const can_step_t *step = &report->agreement;
            if (!step->in_step)
                continue;
            const double latency_ms = report->pose_to_photon_us / 1000.0;
            sum.in_step++;
            sum.latency_ms_mean += latency_ms;
            sum.latency_ms_most = latency_ms > sum.latency_ms_most ? latency_ms : sum.latency_ms_most;
            differ |= differs(record, n, step);
        }
        sum.differing += differ;
    }
    sum.latency_ms_mean /= sum.in_step > 0 ? (double)sum.in_step : 1;
    return sum;
}

run_house_t run_record_house(const run_record_t *record)
{
    run_house_t sum = {.leader = record->frames > 0 ? record->frame[record->frames - 1].leader : 0};
    for (int32_t n = 0; n < record->frames; n++) {
        const run_frame_t *frame = &record->frame[n];
        const int32_t size_us = abs(frame->house_off_us);
        sum.frames += frame->housed;
        sum.off_us_mean += size_us;
        sum.off_us_most = size_us > sum.off_us_most ? size_us : sum.off_us_most;
    }
    sum.off_us_mean /= sum.frames > 0 ? sum.frames : 1;
    return sum;
}

void run_pose_text(char text[RUN_POSE_TEXT_LENGTH], const pose_t *pose)
{
    char mm[3][32];
    for (int i = 0; i < 3; i++) {
        const int64_t nm = pose->eye_nm[i];
        const int64_t size = nm < 0 ? -nm : nm;
        snprintf(mm[i], sizeof mm[i], "%s%" PRId64 ".%06" PRId64, nm < 0 ? "-" : "", size / NM_PER_MM,
                 size % NM_PER_MM);
    }
    double q[4];
    for (int i = 0; i < 4; i++)
        q[i] = pose->quaternion_q30[i] / 1073741824.0;
    /* ten decimals: finer than half a step of Q30 */
    snprintf(text, RUN_POSE_TEXT_LENGTH, "%s %s %s %.10f %.10f %.10f %.10f", mm[0], mm[1], mm[2], q[0], q[1], q[2],
             q[3]);
}
