// SPDX-License-Identifier: Apache-2.0
// A text in lines of so many letters at most.
#include "firmware/text_wrap.h"

#include <stdbool.h>
#include <string.h>

/* A byte that goes on with a character of UTF-8. */
static bool goes_on(char c)
{
    return ((unsigned char)c & 0xc0) == 0x80;
}

int32_t text_wrap_letters(const text_line_t *line)
{
    int32_t letters = 0;
    for (int32_t i = 0; i < line->bytes; i++)
        letters += !goes_on(line->begin[i]);
    return letters;
}

static const char *skip_spaces(const char *text)
{
    while (*text == ' ')
        text++;
    return text;
}

text_line_t text_wrap_next(const char **rest, int32_t columns)
{
    const char *begin = skip_spaces(*rest), *end = begin, *space = NULL, *joint = NULL;
    for (int32_t letters = 0; *end != '\0'; end++) {
        letters += !goes_on(*end);
        if (*end == ' ')
            space = end;
        if (letters > columns)
            break;
        if (strchr("/:,;.=-_", *end) != NULL)
            joint = end + 1;
    }
    if (*end != '\0')
        end = space != NULL ? space : joint != NULL ? joint : end;
    const text_line_t line = {begin, (int32_t)(end - begin)};
    *rest = end;
    return line;
}

int32_t text_wrap_count(const char *text, int32_t columns)
{
    int32_t lines = 0;
    while (text_wrap_next(&text, columns).bytes > 0)
        lines++;
    return lines;
}
