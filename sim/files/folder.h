// SPDX-License-Identifier: Apache-2.0
// A folder that a program writes its results into.
#ifndef SIM_FILES_FOLDER_H
#define SIM_FILES_FOLDER_H

#include "sim/files/file_io.h"

enum { FOLDER_PATH_LENGTH = 4096 };

/** Make the folder, with those above it that are missing too. @return false with the reason in error. */
bool folder_make(const char *folder, char error[FILE_ERROR_LENGTH]);

/** Open FOLDER/NAME for writing. @return NULL with the reason in error. */
FILE *folder_create_file(const char *folder, const char *name, char error[FILE_ERROR_LENGTH]);

/** Close a file. @return false with the reason in error when it could not be written whole. NULL is a success. */
bool folder_close_file(FILE *file, const char *name, char error[FILE_ERROR_LENGTH]);

#endif
