// SPDX-License-Identifier: Apache-2.0
// Deletes what an earlier run has left in its folder.
#include "sim/run/run_clean.h"

#include <errno.h>
#include <libgen.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/run/run_draw.h"

static bool delete_file(const char *path, bool *found, char error[FILE_ERROR_LENGTH])
{
    if (unlink(path) == 0) {
        *found = true;
        return true;
    }
    return errno == ENOENT || errno == ENOTDIR || file_error(error, path, "can't be deleted: %s", strerror(errno));
}

static bool delete_picture(const char *folder, const char *name, int32_t frame, bool *found,
                           char error[FILE_ERROR_LENGTH])
{
    char path[RUN_DRAW_PATH_LENGTH];
    return run_draw_path(path, folder, name, frame, error) && delete_file(path, found, error);
}

/* By frame: boards have every number, but the viewer only those with an eye. */
static bool delete_pictures(const char *folder, const room_t *room, char error[FILE_ERROR_LENGTH])
{
    bool found = true;
    for (int32_t n = 0; found && n < INT32_MAX; n++) {
        found = false;
        for (int32_t i = 0; i < room->board_count; i++)
            if (!delete_picture(folder, room->board[i].name, n, &found, error))
                return false;
        if (!delete_picture(folder, "viewer", n, &found, error) ||
            !delete_picture(folder, "uncompensated", n, &found, error))
            return false;
    }
    return true;
}

bool run_clean_lies_in(const char *folder, const char *file)
{
    char copy[PATH_MAX], of_file[PATH_MAX], of_folder[PATH_MAX];
    if (strlen(file) >= sizeof copy)
        return false;
    strcpy(copy, file);
    return realpath(dirname(copy), of_file) != NULL && realpath(folder, of_folder) != NULL &&
           strcmp(of_file, of_folder) == 0;
}

bool run_clean(const char *folder, const room_t *room, char error[FILE_ERROR_LENGTH])
{
    static const char *const names[] = {"frames.csv", "timings.csv",       "psnr.csv", "bus.log",  "index.html",
                                        "psnr.svg",   "psnr_original.svg", "step.svg", "time.svg", "bus.svg"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[RUN_DRAW_PATH_LENGTH];
        bool found;
        const int length = snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        if (length < 0 || (size_t)length >= sizeof path)
            return file_error(error, folder, "the name is too long");
        if (!delete_file(path, &found, error))
            return false;
    }
    return delete_pictures(folder, room, error);
}
