// SPDX-License-Identifier: Apache-2.0
// The room file: camera, boards with their walls, and the bus.
#include "firmware/room.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/room/room_checks.h"
#include "firmware/room/room_places.h"
#include "firmware/room/room_report.h"
#include "firmware/room/room_schema.h"
#include "firmware/room/room_text.h"
#include "firmware/room/room_walls.h"

/* What libcyaml has to say: its first error is the reason, what follows is its way there. */
typedef struct {
    const room_report_t *report;
    char reason[128];
} cyaml_words_t;

__attribute__((format(printf, 3, 0))) static void hear_cyaml(cyaml_log_t level, void *context, const char *format,
                                                             va_list arguments)
{
    cyaml_words_t *words = context;
    char line[sizeof words->reason];
    vsnprintf(line, sizeof line, format, arguments);
    line[strcspn(line, "\n")] = '\0';
    if (level == CYAML_LOG_WARNING)
        room_warn(words->report, 1, "file", "%s", line);
    else if (level == CYAML_LOG_ERROR && words->reason[0] == '\0')
        memcpy(words->reason, line, sizeof line);
}

static cyaml_config_t cyaml_config(cyaml_words_t *words)
{
    return (cyaml_config_t){.log_fn = hear_cyaml,
                            .log_ctx = words,
                            .mem_fn = cyaml_mem,
                            .log_level = CYAML_LOG_WARNING,
                            .flags = CYAML_CFG_NO_ALIAS};
}

static bool convert(room_t *room, const room_text_t *text, const room_checker_t *checker)
{
    cyaml_words_t words = {.report = checker->report};
    const cyaml_config_t config = cyaml_config(&words);
    cyaml_data_t *data = NULL;
    const cyaml_err_t status = cyaml_load_data(text->bytes, text->length, &config, &room_schema, &data, NULL);
    if (status != CYAML_OK || data == NULL)
        return room_refuse(checker->report, 1, "file", "libcyaml: %s (%s), expected a room file", words.reason,
                           cyaml_strerror(status));
    const bool good = room_checks(checker, data, room) && room_walls_fit(checker, room);
    cyaml_free(&config, &room_schema, data, 0);
    return good;
}

static bool read_places(room_t *room, const room_text_t *text, const room_report_t *report)
{
    room_places_t places;
    if (!room_places_read(&places, text, &room_schema, report))
        return false;
    const room_checker_t checker = {.report = report, .places = &places};
    const bool good = convert(room, text, &checker);
    room_places_free(&places);
    return good;
}

static bool read_text(room_t *room, const room_report_t *report)
{
    room_text_t text;
    if (!room_text_read(&text, report))
        return false;
    const bool good = read_places(room, &text, report);
    room_text_free(&text);
    return good;
}

bool room_load(room_t *room, const char *path, room_warning_fn *warn, void *context, char error[ROOM_MESSAGE_LENGTH])
{
    const room_report_t report = {.path = path, .warn = warn, .context = context, .error = error};
    room_t *read = malloc(sizeof *read);
    if (read == NULL)
        return room_refuse(&report, 1, "file", "out of memory, expected enough to read it");
    const bool good = read_text(read, &report);
    if (good)
        *room = *read;
    free(read);
    return good;
}

const room_board_t *room_board_named(const room_t *room, const char *name)
{
    for (int32_t b = 0; b < room->board_count; b++)
        if (strcmp(room->board[b].name, name) == 0)
            return &room->board[b];
    return NULL;
}

const room_board_t *room_board_with_node(const room_t *room, int32_t node)
{
    for (int32_t b = 0; b < room->board_count; b++)
        if (room->board[b].node == node)
            return &room->board[b];
    return NULL;
}
