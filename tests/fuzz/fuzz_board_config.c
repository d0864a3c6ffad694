// SPDX-License-Identifier: Apache-2.0
// Fuzzes the board's own file: any bytes are a sound configuration, or an error of one line, nothing read,
// and what is made out of them all the same is sound.
#include "firmware/board_config.h"

#include <string.h>

#include "hal/hal_workers.h"
#include "tests/fuzz/input.h"

enum { UNTOUCHED = 0xa5 };

static void check_text(const char *text, size_t size)
{
    fuzz_check(memchr(text, '\0', size) != NULL, "a text ends");
    for (; *text != '\0'; text++)
        fuzz_check((unsigned char)*text >= 0x20 && *text != 0x7f, "a text is of one line");
}

static void check_config(const board_config_t *config)
{
    fuzz_check(config->node >= 1 && config->node <= ROOM_MAX_NODE, "the node is in range");
    fuzz_check(config->workers >= 0 && config->workers <= HAL_WORKERS_MAX, "the workers are in range");
    fuzz_check(config->room[0] != '\0', "a room is named");
    check_text(config->room, sizeof config->room);
    check_text(config->key, sizeof config->key);
    check_text(config->can, sizeof config->can);
    check_text(config->camera, sizeof config->camera);
    check_text(config->display, sizeof config->display);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    board_config_t config;
    char error[ROOM_MESSAGE_LENGTH] = "";
    memset(&config, UNTOUCHED, sizeof config);
    const input_file_t file = input_file_open(data, size);
    if (board_config_load(&config, file.path, error)) {
        check_config(&config);
    } else {
        const uint8_t *byte = (const uint8_t *)&config;
        for (size_t i = 0; i < sizeof config; i++)
            fuzz_check(byte[i] == UNTOUCHED, "a refused file leaves the configuration untouched");
        fuzz_check_line(error);
        board_config_glimpse(&config, file.path);
        fuzz_check(config.node >= 0 && config.node <= ROOM_MAX_NODE, "a node that was made out is in range");
        check_text(config.can, sizeof config.can);
        check_text(config.display, sizeof config.display);
    }
    input_file_close(&file);
    return 0;
}
