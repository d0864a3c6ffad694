// SPDX-License-Identifier: Apache-2.0
// A YAML file of which every value has the shape that a schema asks for: the values, and their places in the file.
#include "firmware/room/room_yaml_file.h"

#include <stdio.h>
#include <string.h>

#include "firmware/room/room_text.h"

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

static bool convert(room_yaml_file_t *file, const room_text_t *text, const room_report_t *report)
{
    cyaml_words_t words = {.report = report};
    const cyaml_config_t config = {.log_fn = hear_cyaml,
                                   .log_ctx = &words,
                                   .mem_fn = cyaml_mem,
                                   .log_level = CYAML_LOG_WARNING,
                                   .flags = CYAML_CFG_NO_ALIAS};
    const cyaml_err_t status = cyaml_load_data(text->bytes, text->length, &config, file->schema, &file->data, NULL);
    return (status == CYAML_OK && file->data != NULL) ||
           room_refuse(report, 1, "file", "libcyaml: %s (%s), expected %s", words.reason, cyaml_strerror(status),
                       report->what);
}

static bool read_text(room_yaml_file_t *file, const room_text_t *text, const room_report_t *report)
{
    if (!room_places_read(&file->places, text, file->schema, report))
        return false;
    if (convert(file, text, report))
        return true;
    room_places_free(&file->places);
    return false;
}

bool room_yaml_file_read(room_yaml_file_t *file, const cyaml_schema_value_t *schema, const room_report_t *report)
{
    room_text_t text;
    if (!room_text_read(&text, report))
        return false;
    room_yaml_file_t read = {.schema = schema};
    const bool good = read_text(&read, &text, report);
    room_text_free(&text);
    if (good)
        *file = read;
    return good;
}

void room_yaml_file_free(room_yaml_file_t *file)
{
    const cyaml_config_t config = {.mem_fn = cyaml_mem, .flags = CYAML_CFG_NO_ALIAS};
    cyaml_free(&config, file->schema, file->data, 0);
    room_places_free(&file->places);
}
