// SPDX-License-Identifier: Apache-2.0
// Which machine this is: see the header.
#include "hal/linux/machine_linux.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "hal/linux/board_error.h"

enum { LIST_LENGTH = 1024 };

bool machine_linux_is(const char *root, const char *name, char found[MACHINE_LINUX_NAME_LENGTH])
{
    char path[PATH_MAX], list[LIST_LENGTH + 1];
    found[0] = '\0';
    const int length = snprintf(path, sizeof path, "%s/proc/device-tree/compatible", root);
    FILE *file = length < 0 || (size_t)length >= sizeof path ? NULL : fopen(path, "re");
    if (file == NULL)
        return true;
    const size_t bytes = fread(list, 1, LIST_LENGTH, file);
    fclose(file);
    list[bytes] = '\0';
    (void)snprintf(found, MACHINE_LINUX_NAME_LENGTH, "%.*s", MACHINE_LINUX_NAME_LENGTH - 1, list);
    for (size_t i = 0; i < bytes; i += strlen(list + i) + 1)
        if (name != NULL && strcmp(list + i, name) == 0)
            return true;
    return name == NULL;
}

hal_status_t machine_linux_open(const char *root, const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH])
{
    char found[MACHINE_LINUX_NAME_LENGTH];
    if (machine_linux_is(root, table->machine, found))
        return HAL_OK;
    return board_error(
        error,
        "machine: this is %s, and the firmware that of board %.32s, expected %.64s: install the firmware "
        "of this board (make BOARD=NAME)",
        found, table->name, table->machine);
}
