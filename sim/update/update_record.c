// SPDX-License-Identifier: Apache-2.0
// What a played update looked like.
#include "sim/update/update_record.h"

#include <inttypes.h>

#include "sim/files/folder.h"
#include "sim/files/gnuplot.h"

enum { WIDTH = 860, ROW_HEIGHT = 26, FRAME_HEIGHT = 110 };

static double seconds(int64_t time_us)
{
    return (double)time_us / 1e6;
}

/* @return The newest that is noted of the board, -1: none. */
static int newest(const update_record_t *record, int board)
{
    int i = record->changes - 1;
    while (i >= 0 && record->change[i].board != board)
        i--;
    return i;
}

static void take_board(update_record_t *record, const update_play_t *play, const room_t *room, int board, FILE *file)
{
    const update_play_look_t look = update_play_look(play, board);
    const int last = newest(record, board);
    if (last >= 0 && record->change[last].look == look)
        return;
    if (record->changes == UPDATE_RECORD_CHANGES) {
        record->full = true;
        return;
    }
    record->change[record->changes++] = (update_change_t){update_play_now_us(play), board, look};
    fprintf(file, "%8.2f s  %s: %s, runs %s\n", seconds(update_play_now_us(play)), room->board[board].name,
            update_play_look_name(look), update_play_running(play, board));
}

static void take_operator(update_record_t *record, const update_play_t *play, FILE *file)
{
    static const char *const names[] = {
        "looks",   "says install", "waits for the installs",  "asks for promises", "says that the moment holds",
        "cancels", "looks again",  "watches the boards start"};
    const room_update_t *u = update_play_operator(play);
    const bool switching = u->settings.task == ROOM_UPDATE_SWITCH;
    if (u->boards == 0 || (record->end_us > 0 && record->step == u->step && record->switching == switching))
        return;
    record->step = u->step;
    record->switching = switching;
    record->end_us = update_play_now_us(play);
    fprintf(file, "%8.2f s  operator %s\n", seconds(record->end_us), names[u->step]);
}

void update_record_take(update_record_t *record, const update_play_t *play, const room_t *room, FILE *file)
{
    take_operator(record, play, file);
    for (int i = 0; i < room->board_count; i++)
        take_board(record, play, room, i, file);
    if (record->end_us > 0)
        record->end_us = update_play_now_us(play);
}

static bool write_table(const update_record_t *record, const room_t *room, const char *folder,
                        char error[FILE_ERROR_LENGTH])
{
    FILE *file = folder_create_file(folder, "update.csv", error);
    if (file == NULL)
        return false;
    fputs("time_s,board,node,state\n", file);
    for (int i = 0; i < record->changes; i++) {
        const update_change_t *change = &record->change[i];
        const room_board_t *board = &room->board[change->board];
        fprintf(file, "%.6f,%s,%" PRId32 ",%s\n", seconds(change->time_us), board->name, board->node,
                update_play_look_name(change->look));
    }
    return folder_close_file(file, "update.csv", error);
}

/* Bars of one look; one out of sight first, as gnuplot takes a plot without data for an error. */
static void print_bars(FILE *pipe, const update_record_t *record, update_play_look_t look)
{
    fprintf(pipe, "$look%d << EOD\n-9 0 -9 -9 0 0\n", (int)look);
    for (int i = 0; i < record->changes; i++) {
        const update_change_t *change = &record->change[i];
        double end = seconds(record->end_us);
        for (int k = record->changes - 1; k > i; k--)
            if (record->change[k].board == change->board)
                end = seconds(record->change[k].time_us);
        if (change->look == look)
            fprintf(pipe, "%.3f %d %.3f %.3f %.2f %.2f\n", seconds(change->time_us), change->board,
                    seconds(change->time_us), end, change->board - 0.36, change->board + 0.36);
    }
    fputs("EOD\n", pipe);
}

static bool write_drawing(const update_record_t *record, const room_t *room, const char *folder,
                          char error[FILE_ERROR_LENGTH])
{
    gnuplot_t plot;
    if (!gnuplot_open(&plot, error))
        return false;
    for (int look = 0; look < UPDATE_PLAY_LOOKS; look++)
        print_bars(plot.pipe, record, (update_play_look_t)look);
    gnuplot_output(&plot, folder, "update.svg", WIDTH, FRAME_HEIGHT + ROW_HEIGHT * room->board_count);
    fprintf(plot.pipe,
            "set xlabel 'time, s' tc rgb '#9aa8bd' offset 0,0.3\nset xrange [0:%.3f]\nset yrange [%.1f:-0.5]\n"
            "set key outside right top\nset style fill solid 0.9 noborder\nset ytics (",
            seconds(record->end_us), room->board_count - 0.5);
    for (int i = 0; i < room->board_count; i++) {
        fputs(i > 0 ? "," : "", plot.pipe);
        gnuplot_string(&plot, room->board[i].name);
        fprintf(plot.pipe, " %d", i);
    }
    fputs(")\nplot", plot.pipe);
    for (int look = 0; look < UPDATE_PLAY_LOOKS; look++)
        fprintf(plot.pipe, "%s $look%d using 1:2:3:4:5:6 with boxxyerror lc rgb colour[%d] title '%s'",
                look > 0 ? "," : "", look, look % GNUPLOT_COLOURS + 1, update_play_look_name((update_play_look_t)look));
    fputs("\n", plot.pipe);
    return gnuplot_close(&plot, error);
}

bool update_record_write(const update_record_t *record, const room_t *room, const char *folder,
                         char error[FILE_ERROR_LENGTH])
{
    if (record->full)
        return file_error(error, folder, "the boards changed more than %d times, expected fewer",
                          UPDATE_RECORD_CHANGES);
    return folder_make(folder, error) && write_table(record, room, folder, error) &&
           write_drawing(record, room, folder, error);
}
