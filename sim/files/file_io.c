// SPDX-License-Identifier: Apache-2.0
// Opening files, and the error line that names the file.
#include "sim/files/file_io.h"

#include <errno.h>
#include <stdarg.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SHOWN = 120 };

bool file_error(char error[FILE_ERROR_LENGTH], const char *path, const char *format, ...)
{
    const size_t length = strlen(path);
    const bool cut = length > PATH_SHOWN;
    const char *shown = cut ? path + length - PATH_SHOWN : path;
    const int begun = snprintf(error, FILE_ERROR_LENGTH, "%s%s: ", cut ? "..." : "", shown);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error + begun, (size_t)(FILE_ERROR_LENGTH - begun), format, arguments);
    va_end(arguments);
    return false;
}

FILE *file_open(const char *path, int64_t *size, char error[FILE_ERROR_LENGTH])
{
    struct stat about;
    if (stat(path, &about) != 0) {
        file_error(error, path, "cannot read: %s", strerror(errno));
        return NULL;
    }
    if (!S_ISREG(about.st_mode)) {
        file_error(error, path, "not a regular file, expected one");
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        file_error(error, path, "cannot read: %s", strerror(errno));
        return NULL;
    }
    *size = about.st_size;
    return file;
}
