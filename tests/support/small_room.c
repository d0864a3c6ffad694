// SPDX-License-Identifier: Apache-2.0
// Rooms for tests, by their files' text.
#include "tests/support/small_room.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "tests/support/scratch.h"

void room_from_text(room_t *room, const char *text)
{
    scratch_t scratch;
    char path[SCRATCH_PATH_LENGTH], error[ROOM_MESSAGE_LENGTH] = "";
    scratch_open(&scratch);
    scratch_path(&scratch, "room.yaml", path);
    scratch_write(path, text, strlen(text));
    const bool loaded = room_load(room, path, NULL, NULL, error);
    scratch_close(&scratch);
    assert_string_equal(error, "");
    assert_true(loaded);
}

void small_room_load(room_t *room, const small_room_t *settings)
{
    char text[4096];
    int length = snprintf(text, sizeof text,
                          "camera: {width: 96, height: 54, focal_px: [60, 60], principal_px: [48, 27]}\n"
                          "can: {fd: %s}\nboards:\n",
                          settings->classic ? "false" : "true");
    for (int i = 1; i <= settings->boards; i++)
        length +=
            snprintf(text + length, sizeof text - (size_t)length,
                     "  - name: wall%d\n    node: %d\n    projector: {width: 16, height: 9}\n"
                     "    viewer: %d\n    display_delay_ms: %.3f\n"
                     "    wall: {corners_mm: [[-2000, -1125, %d], [2000, -1125, %d], [2000, 1125, %d], null]}\n",
                     i, settings->nodes_apart * i, settings->viewers ? i % CAN_VIEWERS : 0,
                     settings->display_ms == NULL ? 0 : settings->display_ms[i - 1], 1000 * i, 1000 * i, 1000 * i);
    room_from_text(room, text);
}
