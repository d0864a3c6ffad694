// SPDX-License-Identifier: Apache-2.0
// A finished run as a short table.
#include "sim/run/run_summary.h"

#include <inttypes.h>
#include <math.h>

enum { MOST_SKIPPED_SHARE = 10 }; /* a tenth of the frames made */

const char *run_summary_method(const run_summary_t *summary, int32_t board)
{
    return summary->method_name != NULL ? summary->method_name : summary->room->board[board].method->name;
}

int32_t run_summary_peak_load_ppm(const run_summary_t *summary)
{
    int32_t peak = 0;
    for (int32_t n = 0; n < summary->record->frames; n++)
        if (summary->record->frame[n].bus_load_ppm > peak)
            peak = summary->record->frame[n].bus_load_ppm;
    return peak;
}

/* "31.42 / 31.55", or a dash. */
static void print_pair(FILE *file, double psnr_db, double limit_db)
{
    char text[48] = "-";
    if (!isnan(psnr_db))
        snprintf(text, sizeof text, "%.2f / %.2f", psnr_db, limit_db);
    fprintf(file, "  %15s", text);
}

static void print_board(const run_summary_t *summary, int32_t index, FILE *file)
{
    const room_board_t *board = &summary->room->board[index];
    const run_board_sum_t sum = run_record_board(summary->record, index, &board->wall);
    char size[32], k[32] = "-";
    snprintf(size, sizeof size, "%dx%d", board->wall.panel_width, board->wall.panel_height);
    if (sum.drawn)
        snprintf(k, sizeof k, "%.2f to %.2f", sum.k_least, sum.k_most);
    fprintf(file, "%-12s %-9s  %-11s %14s  %5.1f %%", board->name, size, run_summary_method(summary, index), k,
            100 * sum.lit_share);
    print_pair(file, sum.db[RUN_DB_PSNR], sum.db[RUN_DB_LIMIT]);
    if (summary->original_name != NULL)
        print_pair(file, sum.db[RUN_DB_ORIGINAL_PSNR], sum.db[RUN_DB_ORIGINAL_LIMIT]);
    fprintf(file, "  %9.2f", sum.step_ms_mean);
    if (isnan(sum.latency_ms))
        fprintf(file, "  %7s\n", "-");
    else
        fprintf(file, "  %7.1f\n", sum.latency_ms);
}

static void print_house(const run_house_t *house, FILE *file)
{
    fputs("\nhouse signal: ", file);
    if (house->leader == 0)
        fputs("nobody leads at the end", file);
    else
        fprintf(file, "board %u leads", (unsigned)house->leader);
    if (house->frames > 0)
        fprintf(file, "; refreshes began %.3f ms from its edges, at most %.3f", house->off_us_mean / 1e3,
                house->off_us_most / 1e3);
    else
        fputs("; no board that led had it", file);
}

void run_summary_print(const run_summary_t *summary, FILE *file)
{
    const room_t *room = summary->room;
    fprintf(file, "\n%-12s %-9s  %-11s %14s  %7s  %15s", "board", "panel", "method", "step k", "lit", "PSNR/limit dB");
    if (summary->original_name != NULL)
        fprintf(file, "  %15s", "vs original dB");
    fprintf(file, "  %9s  %7s\n", "ms/frame", "late ms");
    for (int32_t i = 0; i < room->board_count; i++)
        print_board(summary, i, file);
    fprintf(file, "\n%" PRId32 " frames at %.5g Hz in %s time", summary->record->frames, summary->rate_hz,
            summary->real ? "real" : "virtual");
    if (summary->real)
        fprintf(file, ", %" PRId64 " refreshes skipped", summary->skipped);
    fprintf(file, "; bus %.5g kbit/s", room->bitrate / 1e3);
    if (room->fd)
        fprintf(file, " and %.5g kbit/s FD", room->data_bitrate / 1e3);
    fprintf(file, ": %" PRId64 " frames, load %.2f %%, at most %.2f %% from frame to frame\n", summary->bus.frames,
            summary->bus.load_ppm / 1e4, run_summary_peak_load_ppm(summary) / 1e4);
    const run_agreement_t agreement = run_record_agreement(summary->record);
    fprintf(file,
            "agreement: at %" PRId64 " of %" PRId64 " refreshes a board was certain to show what all do; %" PRId64
            " frames differ",
            agreement.in_step, agreement.refreshes, agreement.differing);
    if (agreement.in_step > 0)
        fprintf(file, "; pose to photon %.1f ms, at most %.1f", agreement.latency_ms_mean, agreement.latency_ms_most);
    const run_house_t house = run_record_house(summary->record);
    if (summary->genlock)
        print_house(&house, file);
    if (summary->skipped > summary->record->frames / MOST_SKIPPED_SHARE)
        fputs(
            "\nthis machine is too slow for the room in real time: smaller panels, fewer boards or a lower --rate help",
            file);
    fprintf(file, "\npage: %s/index.html\n", summary->folder);
}
