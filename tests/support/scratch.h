// SPDX-License-Identifier: Apache-2.0
// A folder for the files that a test makes.
#ifndef TESTS_SUPPORT_SCRATCH_H
#define TESTS_SUPPORT_SCRATCH_H

#include <stddef.h>
#include <stdint.h>

enum { SCRATCH_PATH_LENGTH = 512 };

typedef struct {
    char folder[SCRATCH_PATH_LENGTH / 2];
} scratch_t;

/** Make a new folder in build/, or in $TMPDIR (or /tmp) where there is no build/. The test fails when that fails. */
void scratch_open(scratch_t *scratch);

/** Delete the folder and the files in it. */
void scratch_close(const scratch_t *scratch);

/** The same two as set-up and tear-down of a cmocka test or group: *state is the scratch_t. */
int scratch_set_up(void **state);
int scratch_tear_down(void **state);

/** The path of a file in the folder. */
void scratch_path(const scratch_t *scratch, const char *name, char path[SCRATCH_PATH_LENGTH]);

/** Write a whole file. */
void scratch_write(const char *path, const void *bytes, size_t length);

/** @return A whole file, for the caller to free. */
uint8_t *scratch_read(const char *path, size_t *length);

#endif
