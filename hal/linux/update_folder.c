// SPDX-License-Identifier: Apache-2.0
// The update agent behind its folder.
#include "hal/linux/update_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hal/linux/board_error.h"

enum { FOLDER_LENGTH = 201, PATH_LENGTH = FOLDER_LENGTH + 16, LINE_LENGTH = HAL_UPDATE_SOURCE_LENGTH + 16 };

struct hal_update {
    char state[PATH_LENGTH], request[PATH_LENGTH], draft[PATH_LENGTH];
};

hal_status_t update_folder_open(hal_update_t **update, const char *folder, char error[HAL_BOARD_ERROR_LENGTH])
{
    if (strlen(folder) >= FOLDER_LENGTH)
        return board_error(error, "update: the folder's name is too long: %.60s..., expected at most %d characters",
                           folder, FOLDER_LENGTH - 1);
    hal_update_t *u = malloc(sizeof *u);
    if (u == NULL)
        return board_error(error, "update: out of memory");
    (void)snprintf(u->state, sizeof u->state, "%s/state", folder);
    (void)snprintf(u->request, sizeof u->request, "%s/request", folder);
    (void)snprintf(u->draft, sizeof u->draft, "%s/request.new", folder);
    *update = u;
    return HAL_OK;
}

void update_folder_close(hal_update_t *update)
{
    free(update);
}

static bool request_waits(const hal_update_t *u)
{
    struct stat about;
    return lstat(u->request, &about) == 0;
}

hal_status_t hal_update_state(hal_update_t *u, hal_update_state_t *state)
{
    char text[UPDATE_STATE_BYTES + 2];
    if (u == NULL)
        return HAL_EMPTY;
    if (request_waits(u))
        return HAL_FULL;
    const int file = open(u->state, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (file < 0)
        return errno == ENOENT ? HAL_EMPTY : HAL_IO;
    const ssize_t length = read(file, text, sizeof text - 1);
    (void)close(file);
    if (length < 0 || length > UPDATE_STATE_BYTES || memchr(text, '\0', (size_t)length) != NULL)
        return HAL_IO;
    text[length] = '\0';
    return update_folder_read_state(state, text) ? HAL_OK : HAL_IO;
}

static bool write_draft(const hal_update_t *u, const char *line)
{
    const int file = open(u->draft, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW, 0644);
    if (file < 0)
        return false;
    const size_t length = strlen(line);
    const bool written = write(file, line, length) == (ssize_t)length;
    return close(file) == 0 && written;
}

static hal_status_t request(hal_update_t *u, const char *line)
{
    if (u == NULL || access(u->state, F_OK) != 0)
        return HAL_EMPTY;
    if (!write_draft(u, line))
        return HAL_IO;
    if (renameat2(AT_FDCWD, u->draft, AT_FDCWD, u->request, RENAME_NOREPLACE) == 0)
        return HAL_OK;
    return errno == EEXIST ? HAL_FULL : HAL_IO;
}

hal_status_t hal_update_install(hal_update_t *update, const char *source)
{
    char line[LINE_LENGTH];
    if (!hal_update_is_source(source))
        return HAL_BAD_CALL;
    (void)snprintf(line, sizeof line, "install %s\n", source);
    return request(update, line);
}

hal_status_t hal_update_switch(hal_update_t *update)
{
    return request(update, "switch\n");
}

hal_status_t hal_update_good(hal_update_t *update)
{
    return request(update, "good\n");
}
