// SPDX-License-Identifier: Apache-2.0
// Opening files, and the error line that names the file.
#ifndef SIM_FILES_FILE_IO_H
#define SIM_FILES_FILE_IO_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { FILE_ERROR_LENGTH = 256 };

/**
 * Write "PATH: text" as one line without newline.
 *
 * @param[out] error   Always a complete string; a long path loses its beginning, a long text its end.
 * @param      format  As for printf.
 * @return false, always: `return file_error(...)`.
 */
bool file_error(char error[FILE_ERROR_LENGTH], const char *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/**
 * Open a regular file for reading. Pipes, devices and folders are refused, so this never waits.
 *
 * @param[out] size   Bytes; written only on success.
 * @param[out] error  Written only on failure.
 * @return The open file, for the caller to fclose(); NULL on failure.
 */
FILE *file_open(const char *path, int64_t *size, char error[FILE_ERROR_LENGTH]);

#endif
