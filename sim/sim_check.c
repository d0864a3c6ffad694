// SPDX-License-Identifier: Apache-2.0
// hal_board_check() and hal_board_outputs_off() of the bench: what sim_bench.c would open.
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hal/hal_board.h"
#include "sim/devices/sim_picture.h"
#include "sim/files/video_file.h"

enum { LAST_PORT = 65535, LINE_LENGTH = 512 };

static bool check_bus(const board_table_t *table, hal_check_print_fn *print, void *context)
{
    char line[LINE_LENGTH], *end;
    const long port = strtol(table->can, &end, 10);
    const bool good = end != table->can && *end == '\0' && port >= 0 && port <= LAST_PORT;
    if (good)
        (void)snprintf(line, sizeof line, "can: port %ld of 127.0.0.1, simulated", port);
    else
        (void)snprintf(line, sizeof line, "can: found \"%s\", expected a port of 127.0.0.1; to mend: --can 29536",
                       table->can);
    print(context, good ? HAL_CHECK_FOUND : HAL_CHECK_MISSING, line);
    return good;
}

static bool check_video(const board_table_t *table, const hal_board_needs_t *needs, hal_check_print_fn *print,
                        void *context)
{
    char line[LINE_LENGTH], error[FILE_ERROR_LENGTH];
    const char *name = table->camera;
    (void)sim_picture_take_format(&name);
    if (needs == NULL) { /* a file tells its size when it is read as the room wants it */
        const bool there = strcmp(name, "pattern") == 0 || access(name, R_OK) == 0;
        (void)snprintf(line, sizeof line, "camera: %s%s%s", name, there ? "" : ": ", there ? "" : strerror(errno));
        print(context, there ? HAL_CHECK_FOUND : HAL_CHECK_MISSING, line);
        return there;
    }
    video_t *video = video_open(name, needs->picture_width, needs->picture_height, error);
    if (video == NULL)
        (void)snprintf(line, sizeof line, "camera: %s; to mend: --camera pattern, or another file", error);
    else
        (void)snprintf(line, sizeof line, "camera: %s, %dx%d", name, needs->picture_width, needs->picture_height);
    print(context, video != NULL ? HAL_CHECK_FOUND : HAL_CHECK_MISSING, line);
    video_close(video);
    return video != NULL;
}

static bool check_panel(const board_table_t *table, hal_check_print_fn *print, void *context)
{
    char line[LINE_LENGTH];
    const char *name = table->display;
    struct stat about;
    (void)sim_picture_take_format(&name);
    /* a folder that is not there is made by hal_board_open() */
    const bool good =
        strcmp(name, "none") == 0 || stat(name, &about) != 0 || (S_ISDIR(about.st_mode) && access(name, W_OK) == 0);
    (void)snprintf(line, sizeof line, "display: %s%s", name,
                   good ? "" : " is no folder to write into; to mend: --display none, or another folder");
    print(context, good ? HAL_CHECK_FOUND : HAL_CHECK_MISSING, line);
    return good;
}

bool hal_board_check(const board_table_t *table, const hal_board_needs_t *needs, hal_check_print_fn *print,
                     void *context)
{
    const bool bus = check_bus(table, print, context);
    const bool video = check_video(table, needs, print, context);
    const bool panel = check_panel(table, print, context);
    print(context, HAL_CHECK_FOUND, "gpio, watchdog: simulated");
    return bus && video && panel;
}

hal_status_t hal_board_outputs_off(const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)table;
    (void)error;
    return HAL_OK; /* simulated lines end with their program */
}
