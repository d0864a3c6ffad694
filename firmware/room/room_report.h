// SPDX-License-Identifier: Apache-2.0
// Errors and warnings about a room file, or another YAML file, each one line: "FILE:LINE: KEY: what was found, what was
// expected".
#ifndef FIRMWARE_ROOM_ROOM_REPORT_H
#define FIRMWARE_ROOM_ROOM_REPORT_H

#include <stdbool.h>
#include <stddef.h>

#include "firmware/room.h"

/** What a file is, and where the messages about it go. */
typedef struct {
    const char *path;
    const char *what;      /**< it should be, such as "a room file" */
    const char *keys;      /**< it must have, such as "camera, boards" */
    room_warning_fn *warn; /**< may be NULL */
    void *context;         /**< for warn */
    char *error;           /**< ROOM_MESSAGE_LENGTH bytes */
} room_report_t;

enum { ROOM_KEY_LENGTH = 128 };

/** The full name of a value in the file, such as "boards[1].wall.corners_mm[2]". */
typedef struct {
    char text[ROOM_KEY_LENGTH];
} room_key_t;

/** @return The key that the format makes, cut to ROOM_KEY_LENGTH - 1 bytes. */
room_key_t room_key(const char *format, ...) __attribute__((format(printf, 1, 2)));

/**
 * Write the error.
 *
 * @param line  From 1. 1 also for what concerns the file as a whole.
 * @param key   The value's full name, or "file" or "syntax".
 * @return Always false, so that a check can end with it.
 */
bool room_refuse(const room_report_t *report, size_t line, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/** Hand a warning to report->warn, if there is one. Parameters as in room_refuse(). */
void room_warn(const room_report_t *report, size_t line, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
