// SPDX-License-Identifier: Apache-2.0
// What a board needs before it opens its devices: its configuration, its room, and the room's key.
#ifndef FIRMWARE_SETUP_H
#define FIRMWARE_SETUP_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_auth.h"
#include "firmware/options.h"
#include "firmware/room.h"

/** All zero bytes has nothing. About 200 KB: a static one. */
typedef struct {
    board_config_t config;
    room_t room;
    const room_board_t *board; /**< the room's board of this node, or NULL */
    can_auth_t *auth;          /**< the room's key; NULL: it has none */
    uint64_t seed;             /**< random, for projector_use_key() */
} setup_t;

/**
 * Read what the options name, the configuration first; start-up only. Odd but workable things are told on stderr.
 *
 * @param[in,out] options  setup_read_config() completes them from the configuration; without one, nothing is done; from
 *                         a wrong one, with what board_config_glimpse() makes of it, to be able to say so.
 * @param[out]    error    On failure: one line, what was found where and what was expected. What else the step would
 *                         have read is untouched.
 */
bool setup_read_config(setup_t *setup, options_t *options, char error[ROOM_MESSAGE_LENGTH]);
bool setup_read_room(setup_t *setup, const options_t *options, char error[ROOM_MESSAGE_LENGTH]);
bool setup_read_key(setup_t *setup, const options_t *options, char error[ROOM_MESSAGE_LENGTH]);

/** Forget the key. */
void setup_close(setup_t *setup);

/** @return What the room asks of the devices. The setup has one. */
hal_board_needs_t setup_needs(const setup_t *setup);

#endif
