// SPDX-License-Identifier: Apache-2.0
// Errors and warnings about a room file, each one line.
#include "firmware/room/room_report.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SHOWN_PATH_LENGTH = 160 };

room_key_t room_key(const char *format, ...)
{
    room_key_t key;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(key.text, sizeof key.text, format, arguments);
    va_end(arguments);
    return key;
}

/* A value may hold line ends and escapes: none of them may reach a terminal or break the line. */
static void keep_on_one_line(char *text)
{
    for (; *text != '\0'; text++)
        if ((unsigned char)*text < 0x20 || *text == 0x7f)
            *text = ' ';
}

__attribute__((format(printf, 5, 0))) static void compose(char out[ROOM_MESSAGE_LENGTH], const char *path, size_t line,
                                                          const char *key, const char *format, va_list arguments)
{
    const size_t length = strlen(path);
    const char *shown = length > SHOWN_PATH_LENGTH ? path + length - SHOWN_PATH_LENGTH : path;
    /* Path, line and key are shorter than the message: there is always room for what was found. */
    const int used = snprintf(out, ROOM_MESSAGE_LENGTH, "%s:%zu: %.*s: ", shown, line, ROOM_KEY_LENGTH, key);
    vsnprintf(out + used, ROOM_MESSAGE_LENGTH - (size_t)used, format, arguments);
    keep_on_one_line(out);
}

bool room_refuse(const room_report_t *report, size_t line, const char *key, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    compose(report->error, report->path, line, key, format, arguments);
    va_end(arguments);
    return false;
}

void room_warn(const room_report_t *report, size_t line, const char *key, const char *format, ...)
{
    if (report->warn == NULL)
        return;
    char message[ROOM_MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    compose(message, report->path, line, key, format, arguments);
    va_end(arguments);
    report->warn(report->context, message);
}
