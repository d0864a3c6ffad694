// SPDX-License-Identifier: Apache-2.0
// What a board needs before it opens its devices: its configuration, its room, and the room's key.
#include "firmware/setup.h"

#include <stdio.h>

#include "firmware/auth_key.h"
#include "firmware/say.h"
#include "hal/hal_random.h"

_Static_assert((int)HAL_KEY_ERROR_LENGTH <= (int)ROOM_MESSAGE_LENGTH, "what is said of a key must fit");

static void print_warning(void *context, const char *line)
{
    (void)context;
    say_warning(line);
}

bool setup_read_config(setup_t *setup, options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    if (options->config == NULL)
        return true;
    const bool good = board_config_load(&setup->config, options->config, error);
    if (!good)
        board_config_glimpse(&setup->config, options->config);
    options_complete(options, &setup->config);
    return good;
}

bool setup_read_room(setup_t *setup, const options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    if (!room_load(&setup->room, options->room, print_warning, NULL, error))
        return false;
    setup->board = room_board_with_node(&setup->room, options->node);
    if (setup->board == NULL) {
        char nodes[ROOM_NODES_LENGTH];
        room_nodes(&setup->room, nodes);
        (void)snprintf(error, ROOM_MESSAGE_LENGTH, "%.200s: no board has node %d, expected one of %.255s",
                       options->room, options->node, nodes);
    }
    return setup->board != NULL;
}

bool setup_read_key(setup_t *setup, const options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    if (options->key == NULL)
        return true;
    if (hal_random(&setup->seed) != HAL_OK) {
        (void)snprintf(error, ROOM_MESSAGE_LENGTH, "key: no random numbers from the system");
        return false;
    }
    char reason[HAL_KEY_ERROR_LENGTH];
    setup->auth = auth_key_open(options->key, reason);
    if (setup->auth == NULL)
        (void)snprintf(error, ROOM_MESSAGE_LENGTH, "key: %.500s", reason);
    return setup->auth != NULL;
}

void setup_close(setup_t *setup)
{
    can_auth_close(setup->auth);
    setup->auth = NULL;
}

hal_board_needs_t setup_needs(const setup_t *setup)
{
    const room_t *room = &setup->room;
    return (hal_board_needs_t){
        .picture_width = room->camera.width,
        .picture_height = room->camera.height,
        .panel_width = setup->board->wall.panel_width,
        .panel_height = setup->board->wall.panel_height,
        .refresh_frames = room->refresh.frames,
        .refresh_seconds = room->refresh.seconds,
        .bitrate = room->bitrate,
        .data_bitrate = room->data_bitrate,
        .fd = room->fd,
    };
}
