// SPDX-License-Identifier: Apache-2.0
// The board's own file, wallwarp.yaml: which board of which room this is, and the devices that are not its usual ones.
#ifndef FIRMWARE_BOARD_CONFIG_H
#define FIRMWARE_BOARD_CONFIG_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/room.h"

enum {
    BOARD_CONFIG_NAME_LENGTH = 256, /**< of a device, with its end */
    BOARD_CONFIG_PATH_LENGTH = 1024 /**< of a file, with its folder and end */
};

/** What is left out is "" or 0. */
typedef struct {
    int32_t node;                        /**< 1 to ROOM_MAX_NODE */
    char room[BOARD_CONFIG_PATH_LENGTH]; /**< the room file */
    char key[BOARD_CONFIG_PATH_LENGTH];  /**< the room's key, as auth_key_open() takes it */
    char can[BOARD_CONFIG_NAME_LENGTH], camera[BOARD_CONFIG_NAME_LENGTH], display[BOARD_CONFIG_NAME_LENGTH];
    int32_t workers; /**< 1 to HAL_WORKERS_MAX */
} board_config_t;

/**
 * Read and check it. A room or key file without a leading '/' is in the folder of the configuration; where that is
 * reached by a link, in the folder of what the link leads to. Start-up only: uses the heap while it runs.
 *
 * @param[out] config  Written only when true is returned.
 * @param      path    The YAML file.
 * @param[out] error   On failure: "FILE:LINE: KEY: what was found, what was expected".
 * @return true when every key is right; the files it names need not be there.
 */
bool board_config_load(board_config_t *config, const char *path, char error[ROOM_MESSAGE_LENGTH]);

/**
 * What a file that board_config_load() has refused still tells, for who has to say so on the wall and on the bus: node,
 * can and display, each from the first line of its own that is right by itself, whatever is wrong with the others.
 *
 * @param[out] config  All else is left out, and so are these where no line tells, or the file can't be read.
 */
void board_config_glimpse(board_config_t *config, const char *path);

#endif
