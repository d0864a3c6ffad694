// SPDX-License-Identifier: Apache-2.0
// The room file: camera, boards with their walls, and the bus.
#include "firmware/room.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/room/room_checks.h"
#include "firmware/room/room_report.h"
#include "firmware/room/room_schema.h"
#include "firmware/room/room_walls.h"
#include "firmware/room/room_yaml_file.h"

static bool read_file(room_t *room, const room_report_t *report)
{
    room_yaml_file_t file;
    if (!room_yaml_file_read(&file, &room_schema, report))
        return false;
    const room_checker_t checker = {.report = report, .places = &file.places};
    const bool good = room_checks(&checker, file.data, room) && room_walls_fit(&checker, room);
    room_yaml_file_free(&file);
    return good;
}

bool room_load(room_t *room, const char *path, room_warning_fn *warn, void *context, char error[ROOM_MESSAGE_LENGTH])
{
    const room_report_t report = {.path = path,
                                  .what = "a room file",
                                  .keys = "camera, boards",
                                  .warn = warn,
                                  .context = context,
                                  .error = error};
    room_t *read = malloc(sizeof *read);
    if (read == NULL)
        return room_refuse(&report, 1, "file", "out of memory, expected enough to read it");
    const bool good = read_file(read, &report);
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

void room_nodes(const room_t *room, char text[ROOM_NODES_LENGTH])
{
    size_t length = 0;
    text[0] = '\0';
    for (int32_t b = 0; b < room->board_count; b++)
        length += (size_t)snprintf(text + length, ROOM_NODES_LENGTH - length, "%s%d", b == 0 ? "" : ", ",
                                   room->board[b].node);
}
