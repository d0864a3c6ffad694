// SPDX-License-Identifier: Apache-2.0
// A folder that a program writes its results into.
#include "sim/files/folder.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

bool folder_make(const char *folder, char error[FILE_ERROR_LENGTH])
{
    char path[FOLDER_PATH_LENGTH];
    const size_t length = strlen(folder);
    if (length == 0 || length >= sizeof path)
        return file_error(error, folder, "is no name for a folder");
    memcpy(path, folder, length + 1);
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0')
            continue;
        const char end = path[i];
        path[i] = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST)
            return file_error(error, path, "can't make this folder: %s", strerror(errno));
        path[i] = end;
    }
    struct stat found;
    if (stat(folder, &found) != 0 || !S_ISDIR(found.st_mode))
        return file_error(error, folder, "is not a folder");
    return true;
}

FILE *folder_create_file(const char *folder, const char *name, char error[FILE_ERROR_LENGTH])
{
    char path[FOLDER_PATH_LENGTH];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || (size_t)length >= sizeof path) {
        file_error(error, folder, "the name is too long");
        return NULL;
    }
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        file_error(error, path, "can't be written: %s", strerror(errno));
    return file;
}

bool folder_close_file(FILE *file, const char *name, char error[FILE_ERROR_LENGTH])
{
    if (file == NULL)
        return true;
    const bool whole = !ferror(file);
    errno = 0;
    if (fclose(file) == 0 && whole)
        return true;
    return file_error(error, name, "could not be written whole: %s", errno != 0 ? strerror(errno) : "write error");
}
