// SPDX-License-Identifier: Apache-2.0
// A room file's bytes, known to be one well-formed YAML document without aliases.
#ifndef FIRMWARE_ROOM_ROOM_TEXT_H
#define FIRMWARE_ROOM_ROOM_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include <yaml.h>

#include "firmware/room/room_report.h"

enum { ROOM_MAX_BYTES = 1 << 23, ROOM_MAX_DEPTH = 16 };

typedef struct {
    unsigned char *bytes; /**< owned */
    size_t length;
} room_text_t;

/**
 * Read report->path and check that it is one YAML document. Refused are files above ROOM_MAX_BYTES, values more than
 * ROOM_MAX_DEPTH deep (libyaml's time grows with the square of the depth) and aliases (a few lines could stand for
 * millions of values).
 *
 * @param[out] text  Written only when true is returned; then end with room_text_free().
 */
bool room_text_read(room_text_t *text, const room_report_t *report);

void room_text_free(room_text_t *text);

/** Write libyaml's complaint as the report's error. @return Always false. */
bool room_text_refuse_syntax(const room_report_t *report, const yaml_parser_t *parser, const room_text_t *text);

#endif
