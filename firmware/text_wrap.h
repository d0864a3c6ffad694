// SPDX-License-Identifier: Apache-2.0
// A text in lines of so many letters at most.
#ifndef FIRMWARE_TEXT_WRAP_H
#define FIRMWARE_TEXT_WRAP_H

#include <stdint.h>

/** A part of a text, not ended. */
typedef struct {
    const char *begin;
    int32_t bytes; /**< 0: the text is at its end */
} text_line_t;

/** @return Letters of the line: a character of UTF-8 is one, however many bytes it has. */
int32_t text_wrap_letters(const text_line_t *line);

/**
 * Take the next line: up to the last space that lets it fit, without that space; a word that is longer than a line is
 * broken behind a mark that joins words, as the '/' of a path, and only without one anywhere.
 *
 * @param[in,out] rest     What follows the lines so far; moved on to what follows this one.
 * @param         columns  1 or more.
 */
text_line_t text_wrap_next(const char **rest, int32_t columns);

/** @return How many lines a text makes. */
int32_t text_wrap_count(const char *text, int32_t columns);

#endif
