// SPDX-License-Identifier: Apache-2.0
// The board's own file, wallwarp.yaml: which board of which room this is, and the devices that are not its usual ones.
#include "firmware/board_config.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/room/room_report.h"
#include "firmware/room/room_yaml_file.h"
#include "hal/hal_workers.h"

/* As it stands in the file. A pointer is NULL where the key is left out. */
typedef struct {
    int64_t node;
    char *room, *key, *can, *camera, *display;
    int64_t *workers;
} config_yaml_t;

/* What every check needs. */
typedef struct {
    const room_report_t *report;
    const room_places_t *places;
    const char *folder; /* with its last '/'; "" for the one that the program runs in */
} checker_t;

static const cyaml_schema_field_t config_keys[] = {
    CYAML_FIELD_INT("node", CYAML_FLAG_DEFAULT, config_yaml_t, node),
    CYAML_FIELD_STRING_PTR("room", CYAML_FLAG_POINTER, config_yaml_t, room, 0, CYAML_UNLIMITED),
    CYAML_FIELD_STRING_PTR("key", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, config_yaml_t, key, 0, CYAML_UNLIMITED),
    CYAML_FIELD_STRING_PTR("can", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, config_yaml_t, can, 0, CYAML_UNLIMITED),
    CYAML_FIELD_STRING_PTR("camera", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, config_yaml_t, camera, 0,
                           CYAML_UNLIMITED),
    CYAML_FIELD_STRING_PTR("display", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, config_yaml_t, display, 0,
                           CYAML_UNLIMITED),
    CYAML_FIELD_INT_PTR("workers", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, config_yaml_t, workers),
    CYAML_FIELD_END};

static const cyaml_schema_value_t config_schema = {CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, config_yaml_t, config_keys)};

static bool check_number(const checker_t *checker, const char *key, const int64_t *value, int32_t largest, int32_t *out)
{
    if (value == NULL)
        return true;
    if (*value < 1 || *value > largest)
        return room_refuse(checker->report, room_places_line(checker->places, key), key,
                           "found %" PRId64 ", expected 1 to %" PRId32, *value, largest);
    *out = (int32_t)*value;
    return true;
}

/* Into `size` bytes after those of a folder. The text becomes part of messages of one line. */
static bool check_text(const checker_t *checker, const char *key, const char *text, const char *folder, char *out,
                       size_t size)
{
    if (text == NULL)
        return true;
    const size_t line = room_places_line(checker->places, key), length = strlen(folder) + strlen(text);
    if (text[0] == '\0')
        return room_refuse(checker->report, line, key, "found \"\", expected a name");
    for (const char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            return room_refuse(checker->report, line, key,
                               "found a line end or another control character, expected a name");
    if (length >= size)
        return room_refuse(checker->report, line, key, "found a name of %zu bytes%s, expected %zu at most", length,
                           folder[0] == '\0' ? "" : " with its folder", size - 1);
    (void)stpcpy(stpcpy(out, folder), text);
    return true;
}

static bool check_name(const checker_t *checker, const char *key, const char *text, char out[BOARD_CONFIG_NAME_LENGTH])
{
    return check_text(checker, key, text, "", out, BOARD_CONFIG_NAME_LENGTH);
}

static bool check_path(const checker_t *checker, const char *key, const char *text, char out[BOARD_CONFIG_PATH_LENGTH])
{
    const char *folder = text != NULL && text[0] == '/' ? "" : checker->folder;
    return check_text(checker, key, text, folder, out, BOARD_CONFIG_PATH_LENGTH);
}

static bool check_all(const checker_t *checker, const config_yaml_t *yaml, board_config_t *config)
{
    *config = (board_config_t){.node = 0};
    return check_number(checker, "node", &yaml->node, ROOM_MAX_NODE, &config->node) &&
           check_path(checker, "room", yaml->room, config->room) &&
           check_path(checker, "key", yaml->key, config->key) && check_name(checker, "can", yaml->can, config->can) &&
           check_name(checker, "camera", yaml->camera, config->camera) &&
           check_name(checker, "display", yaml->display, config->display) &&
           check_number(checker, "workers", yaml->workers, HAL_WORKERS_MAX, &config->workers);
}

/* @return The folder of the file that the path leads to, with its last '/', for the caller to free; NULL: no memory. */
static char *folder_of(const char *path)
{
    char *folder = realpath(path, NULL);
    if (folder == NULL)
        folder = strdup(path);
    char *slash = folder == NULL ? NULL : strrchr(folder, '/');
    if (slash != NULL)
        slash[1] = '\0';
    else if (folder != NULL)
        folder[0] = '\0';
    return folder;
}

bool board_config_load(board_config_t *config, const char *path, char error[ROOM_MESSAGE_LENGTH])
{
    const room_report_t report = {
        .path = path, .what = "a board's configuration", .keys = "node, room", .error = error};
    room_yaml_file_t file;
    if (!room_yaml_file_read(&file, &config_schema, &report))
        return false;
    char *folder = folder_of(path);
    const checker_t checker = {.report = &report, .places = &file.places, .folder = folder};
    board_config_t read;
    const bool good = folder == NULL ? room_refuse(&report, 1, "file", "out of memory, expected enough to read it")
                                     : check_all(&checker, file.data, &read);
    free(folder);
    room_yaml_file_free(&file);
    if (good)
        *config = read;
    return good;
}

static void glimpse_name(char out[BOARD_CONFIG_NAME_LENGTH], const char *word)
{
    static const char usual[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789:/._-";
    const size_t length = strlen(word);
    if (out[0] == '\0' && length < BOARD_CONFIG_NAME_LENGTH && strspn(word, usual) == length)
        memcpy(out, word, length + 1);
}

/* Of a key, one word, and maybe a comment. */
static void glimpse_line(board_config_t *config, char *line)
{
    static const char blank[] = " \t\r\n";
    char *rest = NULL, *end;
    const char *key = strtok_r(line, blank, &rest), *word = key == NULL ? NULL : strtok_r(NULL, blank, &rest),
               *more = word == NULL ? NULL : strtok_r(NULL, blank, &rest);
    if (word == NULL || (more != NULL && more[0] != '#'))
        return;
    const long node = strcmp(key, "node:") == 0 ? strtol(word, &end, 10) : 0;
    if (node >= 1 && node <= ROOM_MAX_NODE && *end == '\0' && config->node == 0)
        config->node = (int32_t)node;
    if (strcmp(key, "can:") == 0)
        glimpse_name(config->can, word);
    if (strcmp(key, "display:") == 0)
        glimpse_name(config->display, word);
}

void board_config_glimpse(board_config_t *config, const char *path)
{
    enum { MOST_LINES = 1000, LINE_LENGTH = 1024 };
    char line[LINE_LENGTH];
    FILE *file = fopen(path, "r");
    *config = (board_config_t){.node = 0};
    for (int i = 0; file != NULL && i < MOST_LINES && fgets(line, sizeof line, file) != NULL; i++)
        glimpse_line(config, line);
    if (file != NULL)
        (void)fclose(file);
}
