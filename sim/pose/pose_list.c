// SPDX-License-Identifier: Apache-2.0
// Reads pose lists.
#include "sim/pose/pose_list.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/file_io.h"
#include "sim/pose/decimal.h"
#include "sim/pose/pose_text.h"

enum { COLUMNS = 1 + POSE_TEXT_FIELDS, LONGEST_LINE = 1000, TIME_PLACES = 6 };

static const char header[] = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz";
static const char byte_order_mark[] = "\xEF\xBB\xBF"; /* of UTF-8, which spreadsheets put first */
static const int64_t latest_us = INT64_C(10000000000000000);

typedef struct {
    const char *path;
    FILE *file;
    char line[LONGEST_LINE + 1];
    int64_t line_number;
    pose_list_t list;
    size_t room; /**< entries that the list's memory holds */
    char *error;
} reader_t;

__attribute__((format(printf, 2, 3))) static bool fail(reader_t *reader, const char *format, ...)
{
    char text[POSE_LIST_MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    snprintf(reader->error, POSE_LIST_MESSAGE_LENGTH, "%.200s:%lld: %.280s", reader->path,
             (long long)reader->line_number, text);
    return false;
}

/* @return 1 a line is there, without its end; 0 the file is at its end; -1 failed. */
static int next_line(reader_t *reader)
{
    int length = 0;
    int c = getc(reader->file);
    if (c == EOF && !ferror(reader->file))
        return 0;
    reader->line_number++;
    for (; c != EOF && c != '\n'; c = getc(reader->file)) {
        if (c == '\0' || length == LONGEST_LINE) {
            fail(reader, "not text, or longer than %d characters", LONGEST_LINE);
            return -1;
        }
        reader->line[length++] = (char)c;
    }
    if (ferror(reader->file)) {
        fail(reader, "reading failed");
        return -1;
    }
    if (length > 0 && reader->line[length - 1] == '\r')
        length--;
    reader->line[length] = '\0';
    return 1;
}

static bool split(reader_t *reader, const char *field[COLUMNS])
{
    int columns = 1;
    field[0] = reader->line;
    for (char *at = reader->line; *at != '\0'; at++) {
        if (*at != ',')
            continue;
        *at = '\0';
        if (columns < COLUMNS)
            field[columns] = at + 1;
        columns++;
    }
    return columns == COLUMNS ||
           fail(reader, "found %d column%s, expected 8: %s", columns, columns == 1 ? "" : "s", header);
}

static bool read_entry(reader_t *reader, pose_list_entry_t *entry)
{
    const char *field[COLUMNS];
    char reason[POSE_TEXT_MESSAGE_LENGTH];
    if (!split(reader, field))
        return false;
    switch (decimal_from_text(field[0], TIME_PLACES, &entry->time_us)) {
    case DECIMAL_NOT_A_NUMBER:
        return fail(reader, "time_s: found \"%.40s\", expected a decimal number", field[0]);
    case DECIMAL_TOO_LARGE:
        entry->time_us = INT64_MAX;
        break;
    case DECIMAL_OK:
        break;
    }
    if (entry->time_us < 0 || entry->time_us > latest_us)
        return fail(reader, "time_s: found %.40s, expected 0 to 10000000000", field[0]);
    if (reader->list.count > 0 && entry->time_us < reader->list.entry[reader->list.count - 1].time_us)
        return fail(reader, "time_s: found %.40s, expected no less than in the line before", field[0]);
    return pose_from_fields(field + 1, &entry->pose, reason) || fail(reader, "%s", reason);
}

static bool append(reader_t *reader, const pose_list_entry_t *entry)
{
    if (reader->list.count == reader->room) {
        const size_t room = reader->room == 0 ? 1024 : 2 * reader->room;
        pose_list_entry_t *larger = reallocarray(reader->list.entry, room, sizeof *larger);
        if (larger == NULL)
            return fail(reader, "out of memory");
        reader->list.entry = larger;
        reader->room = room;
    }
    reader->list.entry[reader->list.count++] = *entry;
    return true;
}

static bool read_all(reader_t *reader)
{
    int got = next_line(reader);
    if (got < 0)
        return false;
    const char *line = got == 0 ? "" : reader->line;
    if (strncmp(line, byte_order_mark, strlen(byte_order_mark)) == 0)
        line += strlen(byte_order_mark);
    if (strcmp(line, header) != 0) {
        reader->line_number = 1;
        return fail(reader, "found \"%.60s\", expected the header %s", line, header);
    }
    while ((got = next_line(reader)) > 0) {
        pose_list_entry_t entry;
        if (!read_entry(reader, &entry) || !append(reader, &entry))
            return false;
    }
    if (got == 0 && reader->list.count == 0) {
        reader->line_number++;
        return fail(reader, "found the end of the file, expected a pose");
    }
    return got == 0;
}

bool pose_list_load(pose_list_t *list, const char *path, char error[POSE_LIST_MESSAGE_LENGTH])
{
    int64_t size = 0;
    reader_t reader = {.path = path, .error = error};
    reader.file = file_open(path, &size, error);
    if (reader.file == NULL)
        return false;
    const bool done = read_all(&reader);
    fclose(reader.file);
    if (done)
        *list = reader.list;
    else
        pose_list_free(&reader.list);
    return done;
}

void pose_list_free(pose_list_t *list)
{
    free(list->entry);
    *list = (pose_list_t){.entry = NULL};
}
