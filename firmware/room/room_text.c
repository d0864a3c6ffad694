// SPDX-License-Identifier: Apache-2.0
// A room file's bytes, known to be one well-formed YAML document without aliases.
#include "firmware/room/room_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool starts_with_tab(const room_text_t *text, size_t line)
{
    size_t at = 0;
    for (size_t i = 1; i < line && at < text->length; at++)
        if (text->bytes[at] == '\n')
            i++;
    while (at < text->length && text->bytes[at] == ' ')
        at++;
    return at < text->length && text->bytes[at] == '\t';
}

bool room_text_refuse_syntax(const room_report_t *report, const yaml_parser_t *parser, const room_text_t *text)
{
    if (parser->error == YAML_MEMORY_ERROR)
        return room_refuse(report, 1, "file", "out of memory, expected enough to read it");
    if (parser->error == YAML_READER_ERROR) {
        size_t line = 1;
        for (size_t i = 0; i < parser->problem_offset && i < text->length; i++)
            line += text->bytes[i] == '\n';
        return room_refuse(report, line, "syntax", "%s, expected YAML text in UTF-8", parser->problem);
    }
    const size_t line = parser->problem_mark.line + 1;
    if (starts_with_tab(text, line))
        return room_refuse(report, line, "syntax", "found a tab, expected spaces at the start of a line");
    return room_refuse(report, line, "syntax", "%s%s%s, expected YAML", parser->context ? parser->context : "",
                       parser->context ? ": " : "", parser->problem ? parser->problem : "not YAML");
}

static bool read_bytes(room_text_t *text, const room_report_t *report)
{
    FILE *file = fopen(report->path, "rb");
    if (file == NULL)
        return room_refuse(report, 1, "file", "cannot be opened (%s), expected %s in YAML", strerror(errno),
                           report->what);
    unsigned char *bytes = malloc(ROOM_MAX_BYTES + 1);
    errno = bytes == NULL ? ENOMEM : 0;
    const size_t length = bytes == NULL ? 0 : fread(bytes, 1, ROOM_MAX_BYTES + 1, file);
    const bool failed = bytes == NULL || ferror(file);
    const int reason = errno;
    fclose(file);
    if (!failed && length <= ROOM_MAX_BYTES) {
        *text = (room_text_t){.bytes = bytes, .length = length};
        return true;
    }
    free(bytes);
    if (failed)
        return room_refuse(report, 1, "file", "cannot be read (%s), expected %s in YAML", strerror(reason),
                           report->what);
    return room_refuse(report, 1, "file", "more than %d bytes, expected %s of at most that", ROOM_MAX_BYTES,
                       report->what);
}

/* Where the walk through the text is. */
typedef struct {
    int documents, depth;
} position_t;

static bool check_event(const yaml_event_t *event, position_t *at, const room_report_t *report)
{
    const size_t line = event->start_mark.line + 1;
    const yaml_event_type_t type = event->type;
    at->documents += type == YAML_DOCUMENT_START_EVENT;
    at->depth += type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
    at->depth -= type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
    if (at->documents > 1)
        return room_refuse(report, line, "file", "found a second YAML document, expected one");
    if (at->depth > ROOM_MAX_DEPTH)
        return room_refuse(report, line, "syntax",
                           "found more than %d lists and mappings within each other, expected 6 at most",
                           ROOM_MAX_DEPTH);
    if (type == YAML_ALIAS_EVENT)
        return room_refuse(report, line, "syntax", "found the alias '*%.40s', expected the value itself",
                           (const char *)event->data.alias.anchor);
    if (type == YAML_STREAM_END_EVENT && at->documents == 0)
        return room_refuse(report, 1, "file", "empty, expected the keys %s", report->keys);
    return true;
}

/* Every event takes at least one byte, but for the few that open and close: the loop ends with the text. */
static bool check_events(const room_text_t *text, const room_report_t *report)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return room_refuse(report, 1, "file", "out of memory, expected enough to read it");
    yaml_parser_set_input_string(&parser, text->bytes, text->length);
    bool good = true;
    position_t at = {0};
    for (bool more = true; good && more;) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) {
            good = room_text_refuse_syntax(report, &parser, text);
        } else {
            more = event.type != YAML_STREAM_END_EVENT;
            good = check_event(&event, &at, report);
            yaml_event_delete(&event);
        }
    }
    yaml_parser_delete(&parser);
    return good;
}

bool room_text_read(room_text_t *text, const room_report_t *report)
{
    room_text_t read;
    if (!read_bytes(&read, report))
        return false;
    if (!check_events(&read, report)) {
        room_text_free(&read);
        return false;
    }
    *text = read;
    return true;
}

void room_text_free(room_text_t *text)
{
    free(text->bytes);
    *text = (room_text_t){0};
}
