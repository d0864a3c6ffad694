// SPDX-License-Identifier: Apache-2.0
// The page of a run: a template, and one block of JSON put into it.
#include "sim/run/page.h"

#include <inttypes.h>
#include <math.h>

#include "sim/files/folder.h"
#include "sim/files/html_template.h"

/* sim/run/page.S */
extern const char page_template[], page_template_end[], page_script[], page_script_end[];

static void print_text(FILE *file, const char *text)
{
    if (text == NULL) {
        fputs("null", file);
        return;
    }
    fputc('"', file);
    for (const char *c = text; *c != '\0'; c++) {
        const unsigned char byte = (unsigned char)*c;
        /* '<' as well, so that no text can end the script */
        if (byte < 0x20 || byte == '"' || byte == '\\' || byte == '<')
            fprintf(file, "\\u%04x", byte);
        else
            fputc(byte, file);
    }
    fputc('"', file);
}

static void print_number(FILE *file, double value, int decimals)
{
    if (isfinite(value))
        fprintf(file, "%.*f", decimals, value);
    else
        fputs("null", file);
}

static void print_named(FILE *file, const char *name, const char *text)
{
    fprintf(file, "\"%s\":", name);
    print_text(file, text);
    fputs(",\n", file);
}

/* The wall's outline as fitted: a point of the panel through the wall's map. */
static void print_corner(FILE *file, const wall_corners_t *corners, const wall_t *wall, int corner)
{
    const bool right = corner == 1 || corner == 2, below = corner >= 2;
    const double u = right ? corners->panel_width : 0, v = below ? corners->panel_height : 0;
    double value[4];
    for (int i = 0; i < 4; i++) {
        const real_t *row = i < 3 ? wall->point[i] : wall->weight;
        value[i] = ldexp((double)real_to_fixed(row[0], 40, INT64_MAX), -40) * u +
                   ldexp((double)real_to_fixed(row[1], 40, INT64_MAX), -40) * v +
                   ldexp((double)real_to_fixed(row[2], 40, INT64_MAX), -40);
    }
    fprintf(file, "%s[", corner == 0 ? "" : ",");
    for (int i = 0; i < 3; i++)
        fprintf(file, "%s%.1f", i == 0 ? "" : ",", (wall->origin_um[i] + value[i] / value[3]) / 1000);
    fputc(']', file);
}

static void print_sums(FILE *file, const run_board_sum_t *sum)
{
    fprintf(file, "\"judged\":%" PRId32 ",\"k\":", sum->judged);
    if (sum->drawn)
        fprintf(file, "[%.3f,%.3f]", sum->k_least, sum->k_most);
    else
        fputs("null", file);
    fprintf(file, ",\"lit\":%.4f,\"ms\":[%.3f,%.3f],\"late_ms\":", sum->lit_share, sum->step_ms_mean,
            sum->step_ms_most);
    print_number(file, sum->latency_ms, 1);
    fputs(",\"db\":[", file);
    for (int kind = 0; kind < RUN_DBS; kind++) {
        fputs(kind == 0 ? "" : ",", file);
        print_number(file, sum->db[kind], 3);
    }
    fputs("]", file);
}

static void print_board(FILE *file, const run_summary_t *summary, int32_t index, int32_t stride)
{
    const room_board_t *board = &summary->room->board[index];
    const run_record_t *record = summary->record;
    const run_board_sum_t sum = run_record_board(record, index, &board->wall);
    fprintf(file,
            "%s{\"name\":\"%s\",\"node\":%" PRId32 ",\"width\":%" PRId32 ",\"height\":%" PRId32
            ",\"method\":\"%s\",\"plane_mm\":[%.3f,%.3f],",
            index == 0 ? "" : ",\n", board->name, board->node, board->wall.panel_width, board->wall.panel_height,
            run_summary_method(summary, index), board->wall.rms_um / 1e3, board->wall.worst_um / 1e3);
    print_sums(file, &sum);
    fputs(",\"corners_mm\":[", file);
    for (int corner = 0; corner < 4; corner++)
        print_corner(file, &board->corners, &board->wall, corner);
    fputs("],\"frames\":[", file);
    for (int32_t n = 0; n < record->frames; n += stride) {
        const run_wall_t *wall = &record->wall[n * record->boards + index];
        fprintf(file, "%s[%d,%.3f,%.4f]", n == 0 ? "" : ",", (int)wall->report.state,
                wall->report.corrected ? wall->report.warp.k_in_q16 / 65536.0 : 0.0,
                wall->report.corrected
                    ? wall->report.warp.lit_pixels / ((double)board->wall.panel_width * board->wall.panel_height)
                    : 0.0);
    }
    fputs("]}", file);
}

static void print_frames(FILE *file, const run_record_t *record, int32_t stride)
{
    fputs("\"frames\":[", file);
    for (int32_t n = 0; n < record->frames; n += stride) {
        const run_frame_t *frame = &record->frame[n];
        fprintf(file, "%s{\"n\":%" PRId32 ",\"t\":%.4f,\"load\":%.3f", n == 0 ? "" : ",\n", n,
                (double)frame->time_us / 1e6, frame->bus_load_ppm / 1e4);
        if (frame->seen) {
            fputs(",\"eye\":[", file);
            for (int i = 0; i < 3; i++)
                fprintf(file, "%.1f,", (double)frame->eye.eye_nm[i] / 1e6);
            for (int i = 0; i < 4; i++)
                fprintf(file, "%s%.5f", i == 0 ? "" : ",", frame->eye.quaternion_q30[i] / 1073741824.0);
            fputs("]", file);
        }
        fputs("}", file);
    }
    fputs("]", file);
}

static void print_data(FILE *file, const run_summary_t *summary)
{
    const room_t *room = summary->room;
    const camera_t *camera = &room->camera;
    const int32_t frames = summary->record->frames;
    const int32_t stride = frames > PAGE_FRAMES ? (frames + PAGE_FRAMES - 1) / PAGE_FRAMES : 1;
    fputs("{", file);
    print_named(file, "room", summary->room_name);
    print_named(file, "video", summary->video_name);
    print_named(file, "poses", summary->poses_name);
    print_named(file, "original", summary->original_name);
    fprintf(file, "\"rate_hz\":%.6g,\"real\":%s,\"skipped\":%" PRId64 ",\"count\":%" PRId32 ",\n", summary->rate_hz,
            summary->real ? "true" : "false", summary->skipped, frames);
    fprintf(file,
            "\"camera\":{\"width\":%" PRId32 ",\"height\":%" PRId32
            ",\"focal_px\":[%.3f,%.3f],\"principal_px\":[%.3f,%.3f]},\n",
            camera->width, camera->height, (double)camera->focal_upx[0] / 1e6, (double)camera->focal_upx[1] / 1e6,
            (double)camera->principal_upx[0] / 1e6, (double)camera->principal_upx[1] / 1e6);
    fprintf(file,
            "\"bus\":{\"bitrate\":%" PRId32 ",\"data_bitrate\":%" PRId32 ",\"fd\":%s,\"frames\":%" PRId64
            ",\"poses\":%" PRId64 ",\"load\":%.4f,\"peak\":%.4f,\"errors\":%" PRId64 "},\n",
            room->bitrate, room->data_bitrate, room->fd ? "true" : "false", summary->bus.frames, summary->poses_sent,
            summary->bus.load_ppm / 1e4, run_summary_peak_load_ppm(summary) / 1e4, summary->bus.error_frames);
    const run_agreement_t agreement = run_record_agreement(summary->record);
    fprintf(file,
            "\"agreement\":{\"walls\":%" PRId64 ",\"in_step\":%" PRId64 ",\"differing\":%" PRId64
            ",\"latency_ms\":%.3f,\"latency_most_ms\":%.3f},\n",
            agreement.refreshes, agreement.in_step, agreement.differing, agreement.latency_ms_mean,
            agreement.latency_ms_most);
    fputs("\"boards\":[", file);
    for (int32_t i = 0; i < room->board_count; i++)
        print_board(file, summary, i, stride);
    fputs("],\n", file);
    print_frames(file, summary->record, stride);
    fputs("}\n", file);
}

bool page_write(const run_summary_t *summary, char error[FILE_ERROR_LENGTH])
{
    FILE *file = folder_create_file(summary->folder, "index.html", error);
    if (file == NULL)
        return false;
    html_template_t page = html_template_begin(file, page_template, page_template_end);
    html_template_until(&page, "/*DATA*/");
    print_data(file, summary);
    html_template_until(&page, "/*SCRIPT*/");
    fwrite(page_script, 1, (size_t)(page_script_end - page_script), file);
    html_template_end(&page);
    return folder_close_file(file, "index.html", error);
}
