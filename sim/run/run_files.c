// SPDX-License-Identifier: Apache-2.0
// The tables and the bus log of a run, written while it goes on.
#include "sim/run/run_files.h"

#include <inttypes.h>
#include <math.h>

#include "sim/bus/candump_text.h"
#include "sim/files/folder.h"

enum { US_PER_S = 1000000 };

bool run_files_open(run_files_t *files, const char *folder, int64_t start_us, char error[FILE_ERROR_LENGTH])
{
    if (!folder_make(folder, error))
        return false;
    run_files_t opened = {.folder = folder, .start_us = start_us};
    opened.frames = folder_create_file(folder, "frames.csv", error);
    opened.timings = opened.frames == NULL ? NULL : folder_create_file(folder, "timings.csv", error);
    opened.bus = opened.timings == NULL ? NULL : folder_create_file(folder, "bus.log", error);
    if (opened.bus == NULL) {
        char second[FILE_ERROR_LENGTH];
        (void)folder_close_file(opened.timings, "timings.csv", second);
        (void)folder_close_file(opened.frames, "frames.csv", second);
        return false;
    }
    fputs("frame,time_s,board,state,pose,k_in,k_all,lit_pixels\n", opened.frames);
    fputs("frame,board,step_ms\n", opened.timings);
    *files = opened;
    return true;
}

static void print_seconds(FILE *file, int64_t time_us)
{
    fprintf(file, "%" PRId64 ".%06" PRId64, time_us / US_PER_S, time_us % US_PER_S);
}

void run_files_log(void *context, int sender, const hal_can_frame_t *frame)
{
    const run_files_t *files = context;
    (void)sender;
    hal_can_frame_t logged = *frame;
    logged.time_us = frame->time_us > files->start_us ? frame->time_us - files->start_us : 0;
    char line[CANDUMP_TEXT_LENGTH];
    candump_text_from_frame(line, &logged, "can0");
    fputs(line, files->bus);
    fputc('\n', files->bus);
}

void run_files_add(run_files_t *files, const run_record_t *record, const room_t *room)
{
    const int32_t n = record->frames - 1;
    for (int32_t i = 0; i < record->boards; i++) {
        const run_wall_t *wall = &record->wall[n * record->boards + i];
        const projector_report_t *report = &wall->report;
        char pose[RUN_POSE_TEXT_LENGTH] = "";
        if (report->corrected)
            run_pose_text(pose, &report->pose);
        fprintf(files->frames, "%" PRId32 ",", n);
        print_seconds(files->frames, record->frame[n].time_us);
        fprintf(files->frames, ",%s,%s,%s,%.4f,%.4f,%" PRId32 "\n", room->board[i].name,
                can_board_state_name(report->state), pose, report->corrected ? report->warp.k_in_q16 / 65536.0 : 0.0,
                report->corrected ? report->warp.k_all_q16 / 65536.0 : 0.0,
                report->corrected ? report->warp.lit_pixels : 0);
        fprintf(files->timings, "%" PRId32 ",%s,%.3f\n", n, room->board[i].name, (double)wall->step_time_us / 1000);
    }
}

static bool write_psnr(const run_files_t *files, const run_record_t *record, const room_t *room,
                       char error[FILE_ERROR_LENGTH])
{
    FILE *file = folder_create_file(files->folder, "psnr.csv", error);
    if (file == NULL)
        return false;
    fputs("frame,board,psnr_db,limit_db,original_psnr_db,original_limit_db,coverage\n", file);
    for (int32_t i = 0; i < record->psnrs; i++) {
        const run_psnr_t *psnr = &record->psnr[i];
        fprintf(file, "%" PRId32 ",%s,", psnr->frame, room->board[psnr->board].name);
        for (int kind = 0; kind < RUN_DBS; kind++) {
            if (!isnan(psnr->db[kind]))
                fprintf(file, "%.3f", psnr->db[kind]);
            fputc(',', file);
        }
        fprintf(file, "%.4f\n", psnr->coverage);
    }
    return folder_close_file(file, "psnr.csv", error);
}

bool run_files_close(run_files_t *files, const run_record_t *record, const room_t *room, char error[FILE_ERROR_LENGTH])
{
    bool ok = write_psnr(files, record, room, error);
    ok = folder_close_file(files->frames, "frames.csv", error) && ok;
    ok = folder_close_file(files->timings, "timings.csv", error) && ok;
    return folder_close_file(files->bus, "bus.log", error) && ok;
}
