// SPDX-License-Identifier: Apache-2.0
// `wallwarp --check`: says what of the board is there and what is missing, and changes nothing.
#include "firmware/self_check.h"

#include <stdio.h>

static void print_check(void *context, hal_check_t what, const char *line)
{
    static const char *const names[] = {"found", "advice", "missing"};
    (void)context;
    printf("%-8s %s\n", names[what], line);
}

/* @return good */
static bool print_part(const char *name, bool good, const char *line)
{
    printf("%-8s %s: %s\n", good ? "found" : "missing", name, line);
    return good;
}

static bool check_config(setup_t *setup, options_t *options)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (options->config == NULL)
        return true;
    const bool good = setup_read_config(setup, options, error);
    return print_part("config", good, good ? options->config : error);
}

/* Of a wrong configuration no room is known. */
static bool check_room(setup_t *setup, const options_t *options, bool config)
{
    char line[ROOM_MESSAGE_LENGTH];
    if (options->room == NULL)
        return !config || print_part("room", true, "none was named");
    const bool good = setup_read_room(setup, options, line);
    if (good)
        (void)snprintf(line, sizeof line, "%.400s, node %d, \"%s\"", options->room, options->node, setup->board->name);
    return print_part("room", good, line);
}

static bool check_key(setup_t *setup, const options_t *options)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (options->key == NULL)
        return true;
    const bool good = setup_read_key(setup, options, error);
    setup_close(setup);
    if (good)
        return print_part("key", good, options->key);
    print_check(NULL, HAL_CHECK_MISSING, error);
    return false;
}

bool self_check(setup_t *setup, options_t *options)
{
    const bool config = check_config(setup, options);
    const bool room = check_room(setup, options, config), key = check_key(setup, options);
    const board_table_t devices = options_devices(options);
    const bool known = setup->board != NULL;
    const hal_board_needs_t needs = known ? setup_needs(setup) : (hal_board_needs_t){.fd = false};
    return hal_board_check(&devices, known ? &needs : NULL, print_check, NULL) && config && room && key;
}
